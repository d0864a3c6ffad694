# SPDX-License-Identifier: Apache-2.0
# The virtual board: its kernel and first file system, what runs on it, and its tests; part of the Makefile.

build/board-kernel.made: tests/board/virtual/kernel.sh
	$(if $(V),,@echo "  KERNEL build/board-kernel")
	$(Q)tests/board/virtual/kernel.sh build/board-kernel
	$(Q)touch $@
build/board-kernel/initramfs.gz: tests/board/virtual/initramfs.sh tests/board/virtual/init.sh board/initramfs.sh build/board-kernel.made \
    build/sysroot.made
	$(Q)tests/board/virtual/initramfs.sh build/sysroot build/board-kernel

# Programs that its tests run on it, check_*.c and probe_*.c; other files there are parts of theirs.
VIRTUAL_PROGRAMS := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/board/virtual/check_*.c tests/board/virtual/probe_*.c) \
                        tests/board/virtual/usb_camera.c)

# What these are given to preload.
HEAP_COUNTER     := $(BUILD)/tests/board/virtual/count_heap.so
$(HEAP_COUNTER): $(call objects,tests/board/virtual/count_heap.c)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(MACHINE) -shared -o $@ $^
$(call objects,tests/board/virtual/count_heap.c): CFLAGS += -fPIC

VIRTUAL_TESTS    := $(wildcard tests/board/virtual/test_*.sh)

.PHONY: test-board virtual-programs
test-board: setup-test setup-board ## Boot a virtual arm64 board and run the firmware in it; the last line says how many tests passed
	$(Q)$(MAKE) $(SUB) build/sysroot.made build/board-kernel.made programs \
	    $(addprefix build/host/tests/,hal/linux/print_edid board/picture_tool board/wire_tool)
	$(Q)$(MAKE) $(SUB) BOARD=qemu-virt virtual-programs
	$(Q)tests/board/virtual/run.sh build/test-board build/qemu-virt $(VIRTUAL_TESTS)
virtual-programs: programs $(VIRTUAL_PROGRAMS) $(OTHER_BOARD) $(HEAP_COUNTER) build/board-kernel/initramfs.gz
