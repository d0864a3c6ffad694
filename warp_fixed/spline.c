// SPDX-License-Identifier: Apache-2.0
// The picture as coefficients of the cubic B-spline that goes through its pixels.
#include "warp_fixed/spline.h"

#include "warp_fixed/fixed.h"

/*
 * sqrt(3) a^n * 2^14, rounded so that both passes' sums are 2^14; absolute values sum to 3 * 2^14. First pass: bytes to
 * 64 per grey level, less 64 * 128: +-3 * 128 * 64 = 24576 fits int16. Second pass: |sum| <= 3 * 2^14 * 24576 < 2^31,
 * and 16 bits less leave 16 per grey level.
 */
static const fir_t to_coefficients = {
    .radius = 8,
    .first_shift = 8,
    .offset = 64 * SPLINE_MIDDLE,
    .first = {28378, -7604, 2037, -546, 146, -39, 11, -3, 1},
    .second = {28378, -7604, 2037, -546, 146, -39, 11, -3, 1},
};

void spline_begin(spline_t *spline)
{
    for (int level_x = 0; level_x < LEVELS; level_x++)
        for (int level_y = 0; level_y < LEVELS; level_y++)
            spline->made[level_x][level_y] = false;
}

coefficients_t spline_coefficients(spline_t *spline, const warp_kernels_t *kernels, const image_t *picture, int level_x,
                                   int level_y)
{
    const ptrdiff_t whole = (ptrdiff_t)IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888;
    const ptrdiff_t offset = level_x == 0 && level_y == 0 ? 0 : whole + levels_offset(level_x, level_y);
    const int32_t channels = (int32_t)picture->format, count = picture->width * channels;
    const coefficients_t made = {spline->coefficients + offset, picture->width, picture->height, channels};
    if (spline->made[level_x][level_y])
        return made;
    for (int32_t y = 0; y < picture->height; y++) {
        const int16_t *sums = prefilter_sums(&spline->sums, kernels, &to_coefficients, picture, y);
        kernels->spline_row(made.data + (ptrdiff_t)y * count, sums, &to_coefficients, count, channels);
    }
    spline->made[level_x][level_y] = true;
    return made;
}
