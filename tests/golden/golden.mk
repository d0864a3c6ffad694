# SPDX-License-Identifier: Apache-2.0
# Programs that check that other compilers, optimisations and CPUs make the same bytes; part of the Makefile.

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
