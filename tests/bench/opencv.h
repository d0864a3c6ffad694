// SPDX-License-Identifier: Apache-2.0
// What the benchmark asks of OpenCV, as C: Debian's OpenCV 4 has no header that a C compiler reads.
#ifndef TESTS_BENCH_OPENCV_H
#define TESTS_BENCH_OPENCV_H

#include "warp_fixed/image.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { OPENCV_NEAREST, OPENCV_LINEAR, OPENCV_CUBIC, OPENCV_GAUSSIAN_BLUR } opencv_work_t;

/** @return "4.6.0" or what the library at hand says. */
const char *opencv_version(void);

/** How many threads its loops run on from now on. */
void opencv_set_threads(int threads);

/**
 * cv::warpPerspective() with WARP_INVERSE_MAP, black outside of the picture.
 *
 * @param interpolation  One of the first three.
 * @param rows           From panel index to picture index.
 * @param panel          Destination, of the picture's format; must not overlap it.
 */
void opencv_warp_perspective(opencv_work_t interpolation, const double rows[3][3], const image_t *panel,
                             const image_t *picture);

/** cv::GaussianBlur() of 7 x 7 taps with half-sample mirror borders. @param sigma  Of both axes, pixels. */
void opencv_gaussian_blur(double sigma, const image_t *blurred, const image_t *picture);

#ifdef __cplusplus
}
#endif

#endif
