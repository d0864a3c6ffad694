# SPDX-License-Identifier: Apache-2.0
# Benchmarks: time on this machine, instructions and cycles of ARM, cache lines; part of the Makefile.

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
