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

# The same bytes from other compilers, optimisations and CPUs: each variant builds warp_fixed and golden_hashes anew.
GOLDEN          := $(BUILD)/golden_hashes
GOLDEN_VARIANTS := gcc-O0 gcc-O3 clang-O0 clang-O3 aarch64-linux-gnu-gcc-O0 aarch64-linux-gnu-gcc-O3
$(GOLDEN): $(call objects,tests/golden/golden_hashes.c) $(BUILD)/libwarp.a
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^

# The checker of vector code, in the optimised ones of these variants.
CHECK_KERNELS   := $(BUILD)/check_kernels
KERNEL_VARIANTS := $(filter %-O3,$(GOLDEN_VARIANTS))
$(CHECK_KERNELS): $(call objects,$(wildcard tests/kernels/*.c)) $(BUILD)/libwarp.a
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm

.PHONY: golden $(GOLDEN_VARIANTS:%=golden-%)
golden: $(GOLDEN_VARIANTS:%=golden-%) ## Build what checks that other compilers and CPUs make the same bytes
$(GOLDEN_VARIANTS:%=golden-%): golden-%:
	$(Q)variant=$* && $(MAKE) $(SUB) BUILD=build/variants/$* CC=$${variant%-O?} OPT=-$${variant##*-} \
	    LDFLAGS=-static build/variants/$*/golden_hashes $(if $(filter $*,$(KERNEL_VARIANTS)),build/variants/$*/check_kernels)

# Vector code has forms of its own for AVX2 and AVX-512: built for this CPU, as the benchmark is, and without AVX-512.
# A CPU without either is given SSE2 again.
X86          := build/variants/x86
X86_OPT      := -O3 -march=native
X86_AVX2     := $(X86)-avx2
X86_AVX2_OPT := $(X86_OPT) -mno-avx512f
x86_checks    = $(addprefix $(1)/,check_kernels tests/warp_fixed/test_neon tests/warp_fixed/test_neon_products)
.PHONY: golden-x86 golden-x86-avx2
golden: golden-x86 golden-x86-avx2
golden-x86:
	$(Q)$(MAKE) $(SUB) BUILD=$(X86) OPT='$(X86_OPT)' LIBS=$(X86)/libwarp.a \
	    $(X86)/golden_hashes $(call x86_checks,$(X86))
golden-x86-avx2:
	$(Q)$(MAKE) $(SUB) BUILD=$(X86_AVX2) OPT='$(X86_AVX2_OPT)' LIBS=$(X86_AVX2)/libwarp.a \
	    $(call x86_checks,$(X86_AVX2))

# Commands of the test run, one word list each.
emulated     = $(if $(findstring aarch64,$(1)),qemu-aarch64 )
golden_check = tests/golden/check.sh $(call emulated,$(1))build/variants/$(1)/golden_hashes
kernel_check = $(call emulated,$(1))build/variants/$(1)/check_kernels
# SIMDe is slow without optimisation.
levels       = scalar $(if $(filter %-O3,$(1)),neon)
# These need what makes images, and are of test-image.
IMAGE_TESTS  := $(addprefix tests/board/image/test_,boot_script.sh bundle.sh modules.sh pi_modules.sh update_agent.sh)
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

# --- the virtual board ------------------------------------------------------------------------------------------------

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

include board/image/image.mk

# --- benchmarks -------------------------------------------------------------------------------------------------------

$(BUILD)/count_plugin.so: $(call objects,tests/bench/count_plugin.c)
$(BUILD)/cache_plugin.so: $(call objects,tests/bench/cache_plugin.c tests/bench/cache_model.c)
$(BUILD)/%_plugin.so: $(call objects,tests/bench/qemu_plugin_version.c)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -shared -o $@ $^
$(call objects,$(addprefix tests/bench/,count_plugin.c cache_plugin.c cache_model.c qemu_plugin_version.c)): \
    CFLAGS += -fPIC -fvisibility=hidden
# Tests of parts that no library holds.
$(addprefix $(BUILD)/tests/bench/test_,cache_model x86_row): $(BUILD)/tests/bench/test_%: $(BUILD)/obj/tests/bench/%.c.o
$(BUILD)/bench_arm $(BUILD)/bench_cache: $(BUILD)/%: $(BUILD)/obj/tests/bench/%.c.o \
    $(call objects,tests/bench/markers.c tests/bench/workload.c) $(BUILD)/libwarp.a
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm

# OpenCV picks the best instructions of the CPU when it runs; ours are told of them here. Only the CSV goes to stdout.
ROUNDS := 15
.PHONY: bench
bench: setup-bench ## Time each pixel on this machine beside OpenCV and memcpy as CSV, and draw build/bench/bench.svg
	$(Q)$(MAKE) $(SUB) BUILD=$(X86) OPT='$(X86_OPT)' $(X86)/bench_x86 >&2
	$(Q)mkdir -p build/bench
	$(Q)$(X86)/bench_x86 $(ROUNDS) build/bench
$(BUILD)/bench_x86: $(call objects,$(wildcard tests/bench/*_x86.c tests/bench/x86_*.c) tests/bench/workload.c \
    tests/bench/opencv.cpp sim/files/gnuplot.c sim/files/file_io.c firmware/warp_steps.c hal/linux/workers_pthread.c) \
    $(BUILD)/libwarp.a
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lopencv_imgproc -lopencv_core -lstdc++ -lm -lpthread
# Everything but the CSV goes to stderr. BASELINE=new makes these counts the ones that later runs are held to.
ARM      := build/variants/aarch64-linux-gnu-gcc-O3
KERNELS  := neon
BASELINE := tests/bench/baseline.csv
.PHONY: bench-arm
bench-arm: setup-bench ## Count the instructions and A72 cycles of each pixel as CSV; fail if more than the baseline
	$(Q)$(MAKE) $(SUB) $(BUILD)/count_plugin.so >&2
	$(Q)$(MAKE) $(SUB) BUILD=$(ARM) CC=aarch64-linux-gnu-gcc OPT=-O3 LDFLAGS=-static $(ARM)/bench_arm >&2
	$(Q)tests/bench/test_count_plugin.sh $(BUILD) >&2
	$(Q)tests/bench/check_a72_cycles.sh $(BUILD) >&2
	$(Q)tests/bench/bench_arm.sh $(BUILD)/count_plugin.so $(ARM)/bench_arm build/bench/arm $(KERNELS) $(BASELINE)

# FORM=csv for all figures, FORM=readme to put the table into README.md.
FORM := table
.PHONY: budget
budget: ## Print which method holds 60 Hz on which board, with how many cores and what headroom
	$(Q)board/budget.sh $(FORM)

.PHONY: bench-cache
bench-cache: setup-test ## Count the cache lines that an A72 fetches per pixel as CSV: turned frames, tiles of many sizes
	$(Q)$(MAKE) $(SUB) $(BUILD)/cache_plugin.so >&2
	$(Q)$(MAKE) $(SUB) BUILD=$(ARM) CC=aarch64-linux-gnu-gcc OPT=-O3 LDFLAGS=-static $(ARM)/bench_cache >&2
	$(Q)tests/bench/bench_cache.sh $(BUILD)/cache_plugin.so $(ARM)/bench_cache build/bench/cache

# --- fuzzing ----------------------------------------------------------------------------------------------------------

FUZZ_C  := $(wildcard tests/fuzz/fuzz_*.c)
FUZZERS := $(FUZZ_C:%.c=$(BUILD)/%)
SECONDS := 20
$(BUILD)/tests/fuzz/%: $(BUILD)/obj/tests/fuzz/%.c.o $(call objects,$(filter-out $(FUZZ_C),$(wildcard tests/fuzz/*.c))) \
    $(BUILD)/libsupport.a $(LIBS)
	$(call link)

.PHONY: fuzz run-fuzz
fuzz: setup-test ## Search for inputs that break the readers and the warp, SECONDS=20 for each target
	$(Q)$(MAKE) $(SUB) BUILD=build/fuzz CC=clang OPT='-O2 -fsanitize=fuzzer,address,undefined \
	    -fno-sanitize-recover=all -fno-omit-frame-pointer' run-fuzz
run-fuzz: $(FUZZERS)
	$(Q)tests/fuzz/run.sh $(BUILD) $(SECONDS)

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
