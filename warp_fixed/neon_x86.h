// SPDX-License-Identifier: Apache-2.0
// NEON intrinsics for which SIMDe 0.7.4 and gcc 12 make long code on x86, in SSE2: to be included by neon.h alone.
//
// gcc widens eight bytes in two halves, and moves vectors of 64 bits through memory or other registers to make 128 of
// them. What each function returns is what Arm's manual says, for all values; names with x86_ are not Arm's.
#ifndef WARP_FIXED_NEON_X86_H
#define WARP_FIXED_NEON_X86_H

#include "warp_fixed/neon_x86_halves.h"
#include "warp_fixed/neon_x86_narrow.h"
#include "warp_fixed/neon_x86_products.h"

#endif
