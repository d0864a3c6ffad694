// SPDX-License-Identifier: Apache-2.0
// Low-pass filters for a step k: cut-off 1 / (2 k) cycles per pixel, designed in integers, so the same taps everywhere.
#ifndef WARP_FIXED_FIR_DESIGN_H
#define WARP_FIXED_FIR_DESIGN_H

#include <stdint.h>

#include "warp_fixed/kernels.h"
#include "warp_fixed/method.h"

enum { FIR_MAX_K_Q16 = 64 << 16 };

/**
 * Design the symmetric FIR filter of a step. Weights are the exact ones to 2^-28, rounded so that both sums of fixed.h
 * are exact; the middle weight takes what rounding leaves over.
 *
 * gauss   Sampled Gaussian, -3 dB at the cut-off: sigma = k sqrt(ln 2) / pi, cut at 4 sigma.
 * kaiser  sinc(n / k) / k under a Kaiser window of beta 5 and half length ceil(6 k); -6 dB at the cut-off.
 * butter  Zero phase, |H| = 1 / sqrt(1 + (2 k f)^8), order 4: the inverse DFT of |H| over 2048 points, cut at 8 k:
 *         a weight beyond is below 2 * 10^-3, from k = 2 on below 10^-4.
 *
 * @param[out] fir     All of it that its radius covers.
 * @param      filter  Not WARP_FILTER_NONE.
 * @param      k_q16   Q16, above 1 and up to FIR_MAX_K_Q16.
 *
 * Once per change of k, which is every frame while the viewer walks; bounded. Million x86 instructions at k = 1, 2, 16
 * and 63: gauss 0.03, 0.03, 0.05, 0.11; kaiser 0.08, 0.12, 0.7, 2.7; butter 0.6, 0.7, 2.3, 7.5. Filtering a picture of
 * 1920 x 1080 takes more than a hundred times as many. Weights follow k without steps, for no k is
 * rounded; only Kaiser's length grows by whole pixels.
 */
void fir_design(fir_t *fir, warp_filter_t filter, int32_t k_q16);

#endif
