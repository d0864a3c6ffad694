// SPDX-License-Identifier: Apache-2.0
// A built-in test picture: discs of all sizes, each before the ones drawn earlier, like fallen leaves.
#include "sim/eval/leaves_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/files/gray_image.h"
#include "sim/rng.h"

/* Radii in pixels of the picture; how often the leaves would cover it, laid side by side. */
static const double least_radius = 0.5;
static const double layers = 6.0;
enum { DARKEST = 16, BRIGHTEST = 235 };

/* The pixel centres between two points of an axis of n pixels: [*begin, *end). */
static void between(double low, double high, int32_t n, int32_t *begin, int32_t *end)
{
    *begin = (int32_t)fmin(fmax(ceil(low - 0.5), 0.0), n);
    *end = (int32_t)fmin(fmax(ceil(high - 0.5), *begin), n);
}

static void draw_leaf(const image_t *image, double x, double y, double radius, uint8_t gray)
{
    int32_t top, bottom;
    between(y - radius, y + radius, image->height, &top, &bottom);
    for (int32_t row = top; row < bottom; row++) {
        const double away = row + 0.5 - y;
        const double half = sqrt(fmax(radius * radius - away * away, 0.0));
        int32_t begin, end;
        between(x - half, x + half, image->width, &begin, &end);
        memset(image_row(image, row) + begin, gray, (size_t)(end - begin));
    }
}

static void draw_leaves(const image_t *original, double finer)
{
    const double least = least_radius * finer, most = 0.5 * fmax(original->width, original->height) + least;
    const double shape = 1.0 - pow(least / most, 1.5);
    const double mean_area = acos(-1.0) * 3.0 * least * least * (sqrt(most / least) - 1.0) / shape;
    const double count = layers * original->width * original->height / mean_area + 100.0;
    rng_t rng = {1};
    for (double n = 0.0; n < count; n += 1.0) {
        const double radius = least / pow(1.0 - rng_unit(&rng) * shape, 2.0 / 3.0);
        const double x = rng_unit(&rng) * original->width, y = rng_unit(&rng) * original->height;
        const double gray = DARKEST + rng_unit(&rng) * (BRIGHTEST - DARKEST);
        draw_leaf(original, x, y, radius, (uint8_t)gray);
    }
}

bool leaves_picture(int32_t width, int32_t height, int32_t finer, image_t *picture, image_t *original)
{
    image_t fine, coarse;
    if (!gray_image(&fine, width * finer, height * finer) || !gray_image(&coarse, width, height)) {
        free(fine.data);
        return false;
    }
    memset(fine.data, (DARKEST + BRIGHTEST) / 2, (size_t)fine.width * (size_t)fine.height);
    draw_leaves(&fine, finer);
    gray_image_means(&coarse, &fine, finer);
    *picture = coarse;
    *original = fine;
    return true;
}
