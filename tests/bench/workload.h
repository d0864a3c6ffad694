// SPDX-License-Identifier: Apache-2.0
// What every benchmark works on: two poses, one painted picture, a filter of seven taps.
#ifndef TESTS_BENCH_WORKLOAD_H
#define TESTS_BENCH_WORKLOAD_H

#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/image.h"
#include "warp_fixed/prefilter.h"

enum { BENCH_WIDTH = 1920, BENCH_HEIGHT = 1080, BENCH_PIXELS = BENCH_WIDTH * BENCH_HEIGHT };

typedef struct {
    const char *name;
    double rows[3][3]; /**< from panel index to picture index, as OpenCV has it with WARP_INVERSE_MAP */
} bench_pose_t;

enum { BENCH_POSES = 2 };

/** Two homographies that others have been measured with: 49 % and 87 % of the panel are lit. */
extern const bench_pose_t bench_poses[BENCH_POSES];

typedef struct {
    const char *name;
    image_format_t format;
} bench_format_t;

enum { BENCH_FORMATS = 2 };

extern const bench_format_t bench_formats[BENCH_FORMATS];

/** Panel and picture are BENCH_WIDTH x BENCH_HEIGHT. */
homography_t bench_homography(const double rows[3][3]);

/** A picture or panel of that size in `bytes`, which hold BENCH_PIXELS pixels. */
image_t bench_image(uint8_t *bytes, image_format_t format);

/** Paint squares, ramps and noise; the same always. */
void bench_paint(const image_t *picture);

/** Standard deviation of the 7-tap Gaussian, pixels. */
double bench_seven_taps_sigma(void);

/**
 * Begin a frame of the prefilter with 7 taps, designed before and not in the next frame. Kaiser's filter is never as
 * short as that: it gets weights by hand, negative ones among them.
 *
 * @return false when this is not a filter of 7 taps.
 */
bool bench_seven_taps(prefilter_t *prefilter, warp_filter_t filter);

#endif
