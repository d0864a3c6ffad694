# SPDX-License-Identifier: Apache-2.0
# Searches for inputs that break the readers and the warp; part of the Makefile.

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
