// SPDX-License-Identifier: Apache-2.0
// Low-pass filters for a step k: cut-off 1 / (2 k) cycles per pixel, designed in integers, so the same taps everywhere.
#ifndef WARP_FIXED_FIR_DESIGN_H
#define WARP_FIXED_FIR_DESIGN_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/kernels.h"
#include "warp_fixed/method.h"

enum { FIR_MAX_K_Q16 = 64 << 16 };

/**
 * Design the symmetric FIR filter of a step; with `splines` also turn what it makes into coefficients of the cubic
 * B-spline that goes through it. Weights are the exact ones to 2^-28, rounded to 2^-14; the middle one takes what
 * rounding leaves over.
 *
 * none    The picture itself; for splines only.
 * gauss   Sampled Gaussian, -3 dB at the cut-off: sigma = k sqrt(ln 2) / pi, cut at 4 sigma.
 * kaiser  sinc(n / k) / k under a Kaiser window of beta 5 and half length ceil(6 k); -6 dB at the cut-off.
 * butter  Zero phase, |H| = 1 / sqrt(1 + (2 k f)^8), order 4: the inverse DFT of |H| over 2048 points, cut at 8 k:
 *         a weight beyond is below 2 * 10^-3, from k = 2 on below 10^-4.
 * splines Besides: the spline sum_n c(n) B(t - n), B the cubic B-spline, goes through p when c is p filtered by the
 *         inverse of B's samples, 6 / (z + 4 + 1/z): c = sqrt(3) sum_m a^|m| p(n - m), a = sqrt(3) - 2, cut at 8:
 *         a^9 is 7 * 10^-6.
 *
 * @param[out] fir     All of it that its radius covers.
 * @param      k_q16   Q16, above 1 and up to FIR_MAX_K_Q16; of no meaning for WARP_FILTER_NONE.
 *
 * Once per change of k, which is every frame while the viewer walks; bounded. Million x86 instructions at k = 1, 2, 16
 * and 63: gauss 0.03, 0.03, 0.05, 0.11; kaiser 0.08, 0.12, 0.7, 2.7; butter 0.6, 0.7, 2.3, 7.5. Filtering a picture of
 * 1920 x 1080 takes more than a hundred times as many. Weights follow k without steps, for no k is
 * rounded; only Kaiser's length grows by whole pixels.
 */
void fir_design(fir_t *fir, warp_filter_t filter, int32_t k_q16, bool splines);

#endif
