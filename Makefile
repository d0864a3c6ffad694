# SPDX-License-Identifier: Apache-2.0
# wallwarp: `make help` lists the targets. Everything built lands in build/.

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SECONDARY:
.SUFFIXES:

# --- the board and its compiler ---------------------------------------------------------------------------------------

# The board to build for, one of board/*/: its board.mk names the devices to link with (HAL: sim or linux), the compiler's
# prefix (CROSS: none for this machine), and flags for its CPU.
BOARD := host
BOARDS := $(patsubst board/%/board.mk,%,$(wildcard board/*/board.mk))
CROSS :=
CPU   :=
$(if $(filter $(BOARD),$(BOARDS)),,$(error BOARD=$(BOARD): there is no board/$(BOARD)/board.mk; expected one of: $(BOARDS)))
include board/$(BOARD)/board.mk
$(if $(filter sim linux,$(HAL)),,$(error board/$(BOARD)/board.mk: HAL is "$(HAL)"; expected sim or linux))

# Debian's users do not have these; tools that make file systems and partitions are in them.
export PATH := $(PATH):/usr/sbin:/sbin

# What a variant build changes: make BUILD=build/clang-O0 CC=clang OPT=-O0
CC    := $(CROSS)gcc
CXX   := $(CROSS)g++
AR    := $(CROSS)ar
OPT   := -O3
BUILD := build/$(BOARD)
V     :=
Q     := $(if $(V),,@)
# What a make within a make is given: a job for each core, unless whoever started the first one said how many.
SUB    = --no-print-directory $(if $(filter -j%,$(MAKEFLAGS)),,-j$(shell nproc))

CFLAGS := -std=c11 $(OPT) -g -Wall -Wextra -Werror -Wpedantic -Wshadow -Wconversion -Wsign-conversion \
          -Wstrict-prototypes -Wmissing-prototypes -Wold-style-definition -Wcast-align -Wcast-qual -Wwrite-strings \
          -Wpointer-arith -Wvla -Wformat=2 -Wundef -Wswitch-enum -Wdouble-promotion -Wnull-dereference \
          -fno-common -fstrict-aliasing
CPPFLAGS := -I. -MMD -MP -D_GNU_SOURCE
LDLIBS   := -Wl,--as-needed -lcyaml -lyaml -lpng -lz -ljansson -lcbor -llo -lmbedcrypto -lm -lpthread

# Another machine's programs see its headers and libraries in place of this one's.
SYSROOT := $(if $(CROSS),build/sysroot)
MACHINE := $(CPU) $(SYSROOT:%=--sysroot=%) $(if $(findstring clang,$(CC)),$(CROSS:%-=--target=%))

# --- what is built of which files -------------------------------------------------------------------------------------

PROGRAMS := wallwarp wallwarp-pose $(if $(filter sim,$(HAL)),wallwarp-sim wallwarp-eval)
MAINS    := firmware/main.c sim/wallwarp_sim.c sim/wallwarp_eval.c sim/wallwarp_pose.c

WARP_C     := $(wildcard warp_fixed/*.c)
# Of no board's own, so that the simulator has them too; the rest are the devices of Linux boards.
HAL_C      := $(wildcard $(addprefix hal/linux/,clocks.c key_file.c random_linux.c update_words.c \
              workers_pthread.c))
GPIOD      := $(if $(shell grep -s gpiod_request_config $(SYSROOT)/usr/include/gpiod.h),2,1)
LINUX_C    := $(filter-out $(HAL_C) hal/linux/gpio_gpiod_v%.c,$(wildcard hal/linux/*.c)) \
              $(wildcard hal/linux/gpio_gpiod_v$(GPIOD).c)
LINUX_LIBS := -lgpiod -lmnl -ldrm
ifeq ($(HAL),linux)
LINUX_C    += $(wildcard hal/linux/*.cpp)
LINUX_LIBS += -lcamera -lcamera-base -lstdc++
endif
FIRMWARE_C := $(filter-out $(MAINS),$(wildcard firmware/*.c firmware/*/*.c))
SIM_C      := $(filter-out $(MAINS),$(wildcard sim/*.c sim/*/*.c))
# What is in tests/board/virtual runs on the virtual board: see test-board.
TESTS_C    := $(filter-out tests/board/virtual/%,$(wildcard tests/*/test_*.c tests/*/*/test_*.c))

objects = $(patsubst %,$(BUILD)/obj/%.o,$(1))
TESTS   := $(patsubst tests/%.c,$(BUILD)/tests/%,$(TESTS_C))
SUPPORT_C := $(wildcard tests/support/*.c)
# Programs that the scripts among the tests run, and plugins for two of them.
HELPERS := $(BUILD)/tests/sim/bus/serve_bus $(BUILD)/tests/hal/linux/print_edid \
           $(addprefix $(BUILD)/tests/firmware/,print_frames print_reports agreement_hour) \
           $(BUILD)/tests/board/picture_tool $(BUILD)/count_plugin.so $(BUILD)/cache_plugin.so

# --- compile and link -------------------------------------------------------------------------------------------------

$(BUILD)/obj/hal/linux/%.o $(BUILD)/obj/tests/hal/linux/%.o $(BUILD)/obj/tests/board/virtual/%.o: \
    CPPFLAGS += -isystem $(SYSROOT)/usr/include/libdrm
$(BUILD)/obj/%.c.o: %.c | $(SYSROOT:%=%.made)
	@mkdir -p $(@D)
	$(if $(V),,@echo "  CC    $<")
	$(Q)$(CC) $(CPPFLAGS) $(CFLAGS) $(MACHINE) -c $< -o $@

# By gcc, whoever compiles C.
$(BUILD)/obj/%.cpp.o: %.cpp | $(SYSROOT:%=%.made)
	@mkdir -p $(@D)
	$(if $(V),,@echo "  CXX   $<")
	$(Q)$(CXX) $(CPPFLAGS) $(addprefix -isystem $(SYSROOT)/usr/include/,opencv4 libcamera) -std=c++17 $(OPT) -g \
	    -Wall -Wextra -Werror -Wpedantic -Wshadow -Wconversion -Wsign-conversion \
	    $(filter-out --target=%,$(MACHINE)) -c $< -o $@

# NEON's lanes wrap; SIMDe makes them of signed integers in C.
# gcc 12: SIMDe's loops end it with an internal error ("in compute_live_loop_exits") unless partial redundancies stay,
# and on AArch64 its first scheduler mixes pixels that follow one another until their vectors no longer fit registers.
$(BUILD)/obj/warp_fixed/%_neon.c.o: CFLAGS += -fwrapv $(if $(findstring gcc,$(CC)),-fno-tree-pre -fno-schedule-insns -fno-var-tracking)

$(BUILD)/obj/sim/run/page.S.o: sim/run/page.html sim/run/page.js
$(BUILD)/obj/sim/files/html_style.S.o: sim/files/html_style.css
$(BUILD)/obj/sim/study/study_files.S.o: sim/study/study_page.html $(wildcard tests/images/*.png)
$(BUILD)/obj/%.S.o: %.S
	@mkdir -p $(@D)
	$(if $(V),,@echo "  AS    $<")
	$(Q)$(CC) $(MACHINE) -I. -c $< -o $@

define archive
$(BUILD)/lib$(1).a: $(call objects,$(2))
	$(if $(V),,@echo "  AR    $$@")
	$(Q)rm -f $$@ && $$(AR) rcsP $$@ $$^
endef
$(eval $(call archive,warp,$(WARP_C)))
$(eval $(call archive,hal,$(HAL_C)))
$(eval $(call archive,linux,$(LINUX_C)))
$(eval $(call archive,firmware,$(FIRMWARE_C)))
$(eval $(call archive,sim,$(SIM_C) $(wildcard sim/*/*.S)))
$(eval $(call archive,support,$(SUPPORT_C)))

LIBS := $(BUILD)/libsim.a $(BUILD)/libfirmware.a $(BUILD)/libhal.a $(BUILD)/libwarp.a

define link
	@mkdir -p $(@D)
	$(if $(V),,@echo "  LINK  $@")
	$(Q)$(CC) $(CFLAGS) $(MACHINE) $(LDFLAGS) -o $@ $(filter %.o,$^) $(filter %support.a,$^) \
	    -Wl,--start-group $(LIBS) -Wl,--end-group $(LDLIBS) $(1)
endef

# Programs and tests that drive Linux's devices have them in place of the simulator's.
OTHER_BOARD := $(BUILD)/tests/board/virtual/wallwarp_of_rpi4
ON_LINUX := $(if $(filter linux,$(HAL)),$(BUILD)/wallwarp) $(OTHER_BOARD) \
            $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/hal/linux/*.c tests/board/virtual/*.c))
$(ON_LINUX): $(BUILD)/liblinux.a
$(ON_LINUX): LIBS := $(BUILD)/liblinux.a $(filter-out %/libsim.a,$(LIBS))
$(ON_LINUX): LDLIBS += $(LINUX_LIBS)

# libgpiod 2, where there is only 1: declared, and faked by its test.
$(BUILD)/tests/hal/linux/test_gpio_gpiod_v2: $(call objects,hal/linux/gpio_gpiod_v2.c tests/hal/linux/fake_gpiod_v2.c)
$(call objects,hal/linux/gpio_gpiod_v2.c tests/hal/linux/fake_gpiod_v2.c): \
    CPPFLAGS += $(if $(filter 1,$(GPIOD)),-Itests/hal/linux/gpiod_v2)

# What any HAL must do, with the devices of the virtual board.
$(addprefix $(BUILD)/tests/board/virtual/check_,hal_can hal_gpio): $(BUILD)/tests/board/virtual/check_%: \
    $(BUILD)/obj/tests/hal/test_%.c.o

$(BUILD)/wallwarp: $(call objects,firmware/main.c board/$(BOARD)/board.c) $(LIBS)
	$(call link)
# The firmware of another board, which the virtual one must refuse.
$(OTHER_BOARD): $(call objects,firmware/main.c board/rpi4/board.c) $(LIBS)
	$(call link)
$(BUILD)/wallwarp-%: $(BUILD)/obj/sim/wallwarp_%.c.o $(LIBS)
	$(call link)
# A test's own hal_can_*() comes before the simulator's in the archives.
$(BUILD)/tests/%: $(BUILD)/obj/tests/%.c.o $(BUILD)/libsupport.a $(LIBS)
	$(call link,-lcmocka)

# The example for senders is built as its users build it, with every warning that they may have on.
$(BUILD)/tests/sim/pose/send_pose: sim/pose/examples/send_pose.c
	@mkdir -p $(@D)
	$(Q)$(CC) -std=c11 $(OPT) -Wall -Wextra -Werror -Wpedantic -o $@ $< -lm
$(BUILD)/tests/sim/pose/test_send_pose: $(BUILD)/tests/sim/pose/send_pose

# The kernel's part of a display, played.
$(addprefix $(BUILD)/tests/hal/linux/test_display_kms_,frames dark): $(call objects,tests/hal/linux/kms_kernel.c)
$(BUILD)/tests/hal/linux/test_display_kms_plane: $(call objects,tests/hal/linux/drm_card.c)

$(BUILD)/tests/firmware/test_frame_tag_jpeg: LDLIBS += -ljpeg

# --- for users --------------------------------------------------------------------------------------------------------

.PHONY: all programs
all: setup-$(if $(CROSS),board,demo) ## Build firmware and tools into build/host, or for another board: make BOARD=rpi4
	$(Q)$(MAKE) $(SUB) programs
programs: $(PROGRAMS:%=$(BUILD)/%) ## Build them, and install nothing

# Install what is missing, once: see board/setup.sh.
.PHONY: setup-demo setup-test setup-bench setup-board setup-flash setup-image
setup-demo setup-test setup-bench setup-board setup-flash setup-image:
	$(Q)board/setup.sh $(@:setup-%=%)

build/sysroot.made: board/sysroot.sh board/debian.sh
	$(if $(V),,@echo "  ROOT  build/sysroot")
	$(Q)board/sysroot.sh build/sysroot
	$(Q)touch $@

.PHONY: boards
boards: setup-board ## Build firmware and tools for every board, each into build/NAME
	$(Q)for board in $(BOARDS); do $(MAKE) $(SUB) BOARD=$$board programs || exit 1; done

.PHONY: demo
demo: setup-demo ## Run a room of three walls and a floor, and write the page build/demo/index.html
	$(Q)$(MAKE) $(SUB) programs
	$(Q)$(BUILD)/wallwarp-sim run sim/demo/room.yaml --video sim/demo/studio_960x540.png --poses sim/demo/walk.csv \
	    --original tests/images/studio_1920x1080.png --out build/demo

.PHONY: study
study: setup-demo ## Do the paper's experiments again, and write the page build/study/index.html
	$(Q)$(MAKE) $(SUB) programs
	$(Q)$(BUILD)/wallwarp-eval study --out build/study

# What a board needs is printed from its own tables by a program of this machine, whatever the board is built with.
HOST_CC := gcc
INFO     = build/info/$(BOARD)
.PHONY: info
info: $(INFO) ## Print what a board is made of, its wiring and its set-up: make BOARD=rpi4 info
	$(Q)$(INFO)
build/info/%: board/%/board.c board/%/info.c board/print_info.c board/board_info.c board/raspberry_pi.c \
    board/board_info.h hal/hal_board.h hal/hal_gpio.h
	$(Q)mkdir -p $(@D)
	$(Q)$(HOST_CC) -I. -std=c11 -Wall -Wextra -Werror -o $@ $(filter %.c,$^)

# --- tests ------------------------------------------------------------------------------------------------------------

include tests/golden/golden.mk

# Commands of the test run, one word list each.
emulated     = $(if $(findstring aarch64,$(1)),qemu-aarch64 )
golden_check = tests/golden/check.sh $(call emulated,$(1))build/variants/$(1)/golden_hashes
kernel_check = $(call emulated,$(1))build/variants/$(1)/check_kernels
# SIMDe is slow without optimisation.
levels       = scalar $(if $(filter %-O3,$(1)),neon)
# These need what makes images, and are of test-image.
IMAGE_TESTS  := $(addprefix tests/board/image/test_,boot_script.sh bundle.sh modules.sh pi_modules.sh sizes.sh update_agent.sh)
SCRIPTS      := $(filter-out tests/board/virtual/% $(IMAGE_TESTS),$(wildcard tests/*/test_*.sh tests/*/*/test_*.sh))
# The scripts alone: some judge what programs do in real time.
RUN_TESTS     = $(foreach t,$(TESTS),'$(t)') $(foreach v,$(KERNEL_VARIANTS),'$(call kernel_check,$(v))') \
                $(foreach v,$(GOLDEN_VARIANTS),$(foreach l,$(call levels,$(v)),'$(call golden_check,$(v)) $(l)')) \
                'tests/golden/check.sh $(X86)/golden_hashes neon' \
                $(foreach t,$(call x86_checks,$(X86)) $(call x86_checks,$(X86_AVX2)),'$(t)') \
                alone $(foreach s,$(SCRIPTS),'$(s) $(BUILD)')

.PHONY: test test-programs
test: setup-test ## Run every test but those on the virtual board; the last line says how many passed and failed
	$(Q)$(MAKE) $(SUB) test-programs
	$(Q)tests/run.sh build/test-logs $(RUN_TESTS)
test-programs: programs golden $(TESTS) $(HELPERS)

# Sanitizers have a heap of their own, and lock no memory.
NOT_SANITIZED := %_no_heap.c %/test_realtime_linux.c
.PHONY: sanitize
sanitize: setup-test ## Run the unit tests again with the address and undefined-behaviour sanitizers
	$(Q)$(MAKE) $(SUB) BUILD=build/sanitize OPT='-O1 -fsanitize=address,undefined \
	    -fno-sanitize-recover=all -fno-omit-frame-pointer' \
	    TESTS_C='$(filter-out $(NOT_SANITIZED),$(TESTS_C))' run-unit-tests
.PHONY: run-unit-tests
run-unit-tests: $(TESTS) $(CHECK_KERNELS)
	$(Q)tests/run.sh $(BUILD)/test-logs $(foreach t,$(TESTS) $(CHECK_KERNELS),'$(t)')

.PHONY: sanitize-threads
sanitize-threads: setup-test ## Run the workers' test with the thread sanitizer
	$(Q)$(MAKE) $(SUB) BUILD=build/sanitize-threads OPT='-O1 -fsanitize=thread' \
	    TESTS_C=tests/hal/linux/test_workers_pthread.c CHECK_KERNELS= run-unit-tests

.PHONY: freestanding
freestanding: setup-test ## Compile warp_fixed for aarch64 without any library, and look for float and foreign symbols
	$(Q)tests/warp_fixed/test_freestanding.sh $(BUILD)

# --- parts of their own -----------------------------------------------------------------------------------------------

include tests/board/virtual/virtual.mk
include board/image/image.mk
include tests/bench/bench.mk
include tests/fuzz/fuzz.mk

# --- the rest ---------------------------------------------------------------------------------------------------------

.PHONY: size
size: setup-demo ## Print the sizes of code, static memory, and the worst stack of every function
	$(Q)$(MAKE) $(SUB) BUILD=build/size OPT='-O3 -fstack-usage' build/size/wallwarp
	$(Q)board/size.sh build/size

.PHONY: clean
clean: ## Delete build/
	rm -rf build

.PHONY: help
help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  %-16s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

-include $(shell find $(BUILD)/obj -name '*.d' 2>/dev/null)
