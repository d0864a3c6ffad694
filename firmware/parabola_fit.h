// SPDX-License-Identifier: Apache-2.0
// A least-squares parabola through noisy vectors at irregular times, as far as it is more than noise.
//
// The parabola is a sum of polynomials of order 0, 1, 2 that are orthogonal over the given times, so that each
// coefficient has its own known share of the noise. A coefficient A of size |A|^2 against the noise's expected n^2 is
// made smaller by the factor max(0, 1 - k n^2 / |A|^2) (James and Stein 1961, positive part), with k = 4 for the
// velocity and 9 for the acceleration: at rest both vanish and the mean remains, in motion neither is touched.
#ifndef FIRMWARE_PARABOLA_FIT_H
#define FIRMWARE_PARABOLA_FIT_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/fixed.h"

/** Sums over the vectors; all 0 at first. The caller chooses what is time 0: about the middle keeps most digits. */
typedef struct {
    int32_t count;
    int64_t time[3]; /**< of the powers 1 to 3 of time; the fourth: */
    int128_t time_4;
    int64_t value[3], time_value[3];
    int128_t time_2_value[3], value_2;
} parabola_sums_t;

/** Add a vector. At most 2^10 of them, each at another time; |time_us| <= 2^17, |each value| <= 2^34. */
void parabola_add(parabola_sums_t *sums, int32_t time_us, const int64_t value[3]);

/** How far and how well to know. */
typedef struct {
    int32_t time_us;     /**< what is asked for; |time_us| < 2^20 */
    int32_t farthest_us; /**< coefficients must be good enough for this time, whatever is asked for */
    int64_t noise;       /**< expected standard deviation of each component; the vectors' own is mixed with it */
} parabola_ask_t;

/**
 * The parabola's vector at a time.
 *
 * The noise is estimated from what the parabola leaves over, with `noise` as if three more vectors had shown it. A
 * velocity that would multiply the noise by more than 4 at farthest_us is left out, an acceleration by more than 8.
 *
 * @param[out] value  Written only when true is returned.
 * @return false when the vectors are too few or too near in time for a velocity.
 */
bool parabola_at(const parabola_sums_t *sums, const parabola_ask_t *ask, int64_t value[3]);

#endif
