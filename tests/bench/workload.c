// SPDX-License-Identifier: Apache-2.0
// What every benchmark works on: two poses, one painted picture, a filter of seven taps.
#include "tests/bench/workload.h"

#include <math.h>
#include <string.h>

#include "tests/support/rng.h"

enum { SEVEN_TAPS_RADIUS = 3, SEVEN_TAPS_K = 3 };

const bench_pose_t bench_poses[BENCH_POSES] = {
    {"strong",
     {{3.7348841250231346, 0.6585608410613063, -1563.3322761774},
      {0.045488238090270985, 2.3351236094295453, -73.443630957592021},
      {0.00082195784183178625, 0.00014493334451484484, 1}}},
    {"mild",
     {{1.184834322588556, -0.0093641519771932857, -53.656841584462413},
      {-0.0055509479337247343, 1.0899434500322718, 0.2924260259089646},
      {0.000068934240459625438, -0.000040289870583368484, 1}}},
};

const bench_format_t bench_formats[BENCH_FORMATS] = {{"gray", IMAGE_GRAY8}, {"xrgb", IMAGE_XRGB8888}};

homography_t bench_homography(const double rows[3][3])
{
    const int32_t size[2] = {BENCH_WIDTH, BENCH_HEIGHT};
    int64_t rows_q40[3][3];
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            rows_q40[r][k] = llround(ldexp(rows[r][k], 40));
    homography_t homography;
    homography_from_indices(&homography, (const int64_t(*)[3])rows_q40, size, size);
    return homography;
}

image_t bench_image(uint8_t *bytes, image_format_t format)
{
    return (image_t){bytes, BENCH_WIDTH, BENCH_HEIGHT, BENCH_WIDTH * (int32_t)format, format};
}

void bench_paint(const image_t *picture)
{
    rng_t rng = {1};
    for (int32_t y = 0; y < picture->height; y++) {
        uint8_t *row = image_row(picture, y);
        for (int32_t x = 0; x < picture->width * (int32_t)picture->format; x++) {
            const int32_t square = (x / 64 + y / 16) % 3;
            const int64_t noise = rng_int(&rng, 0, 255);
            row[x] = (uint8_t)(square == 0 ? noise : square == 1 ? (x + 3 * y) % 256 : 255 * ((x + y) & 1));
        }
    }
}

double bench_seven_taps_sigma(void)
{
    return SEVEN_TAPS_K * sqrt(log(2)) / acos(-1);
}

/* The filter is given as the one of the last k, so that none is designed. */
bool bench_seven_taps(prefilter_t *prefilter, warp_filter_t filter)
{
    const int32_t k_q16 = SEVEN_TAPS_K << 16;
    fir_t *fir = &prefilter->design[0].fir;
    prefilter->design[0].kind = (prefilter_kind_t){filter, k_q16, false};
    fir_design(fir, WARP_FILTER_GAUSS, k_q16, false);
    if (fir->radius != SEVEN_TAPS_RADIUS)
        return false;
    if (filter == WARP_FILTER_KAISER) {
        const int16_t weight[] = {6398, 4608, 768, -383};
        memcpy(fir->weight, weight, sizeof weight);
    }
    return prefilter_begin(prefilter, filter, k_q16, false) &&
           prefilter_begin_chroma(prefilter, filter, (chroma_step_t){k_q16, k_q16}, false);
}
