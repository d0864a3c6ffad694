// SPDX-License-Identifier: Apache-2.0
// How steady and how sharp a moving viewer sees a picture that should stand still.
#include "sim/study/flicker_measure.h"

#include <stdbool.h>
#include <stdlib.h>

static bool on_wall(const double_homography_t *h, double x, double y)
{
    double uv[2];
    return double_homography_panel_point(h, (const double[2]){x, y}, uv) && uv[0] >= 0.0 && uv[1] >= 0.0 &&
           uv[0] <= h->panel_width && uv[1] <= h->panel_height;
}

/* The lit rectangle is convex in the picture: a square whose corners it covers is covered. */
static bool square_is_covered(const double_homography_t *h, int32_t x, int32_t y, double margin)
{
    const double left = x - margin, right = x + 1 + margin, top = y - margin, bottom = y + 1 + margin;
    return left >= 0.0 && top >= 0.0 && right <= h->picture_width && bottom <= h->picture_height &&
           on_wall(h, left, top) && on_wall(h, right, top) && on_wall(h, left, bottom) && on_wall(h, right, bottom);
}

void flicker_mask(uint8_t *mask, const double_homography_t *homography, double margin)
{
    for (int32_t y = 0; y < homography->picture_height; y++)
        for (int32_t x = 0; x < homography->picture_width; x++)
            if (!square_is_covered(homography, x, y, margin))
                mask[(ptrdiff_t)y * homography->picture_width + x] = 0;
}

void flicker_add_change(flicker_sums_t *sums, const image_t *before, const image_t *after, const uint8_t *mask)
{
    for (int32_t y = 0; y < before->height; y++) {
        const uint8_t *a = image_row(before, y), *b = image_row(after, y);
        for (int32_t x = 0; x < before->width; x++) {
            if (mask[(ptrdiff_t)y * before->width + x] == 0)
                continue;
            sums->change += abs(b[x] - a[x]);
            sums->pixels++;
        }
    }
}

void flicker_add_sharpness(flicker_sums_t *sums, const image_t *seen, const image_t *ideal, const uint8_t *mask)
{
    const int32_t width = ideal->width;
    for (int32_t y = 0; y + 1 < ideal->height; y++) {
        const uint8_t *in = mask + (ptrdiff_t)y * width;
        const uint8_t *s = image_row(seen, y), *s_below = image_row(seen, y + 1);
        const uint8_t *i = image_row(ideal, y), *i_below = image_row(ideal, y + 1);
        for (int32_t x = 0; x + 1 < width; x++) {
            if (in[x] == 0 || in[x + 1] == 0 || in[x + width] == 0)
                continue;
            const int32_t across = i[x + 1] - i[x], down = i_below[x] - i[x];
            sums->seen += across * (s[x + 1] - s[x]) + down * (s_below[x] - s[x]);
            sums->ideal += across * across + down * down;
        }
    }
}

double flicker_level(const flicker_sums_t *sums)
{
    return (double)sums->change / (double)sums->pixels;
}

double flicker_sharpness(const flicker_sums_t *sums)
{
    return (double)sums->seen / (double)sums->ideal;
}
