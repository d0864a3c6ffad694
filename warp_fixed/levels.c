// SPDX-License-Identifier: Apache-2.0
// The picture at 1/8 and 1/64 of its size along either axis, for footprints of more than 64 texels.
#include "warp_fixed/levels.h"

#include "warp_fixed/fixed.h"

enum { SHIFT = 3 };

static int32_t reduced(int32_t size, int level)
{
    return (size + (1 << (SHIFT * level)) - 1) >> (SHIFT * level);
}

/* Channels of a level at its largest. */
static ptrdiff_t largest(int level_x, int level_y)
{
    return (ptrdiff_t)IMAGE_XRGB8888 * reduced(IMAGE_MAX_WIDTH, level_x) * reduced(IMAGE_MAX_HEIGHT, level_y);
}

ptrdiff_t levels_offset(level_t level)
{
    ptrdiff_t offset = level.plane * largest(level.x, level.y) / 2;
    for (int lower = 1; lower < level.x * LEVELS + level.y; lower++)
        offset += largest(lower / LEVELS, lower % LEVELS);
    return offset;
}

/* Add texels [begin, end) of a row, mirrored beyond its end, to each channel's sum. */
static void add_texels(uint32_t sum[4], const uint8_t *row, const image_t *picture, int32_t begin, int32_t end)
{
    const int32_t channels = (int32_t)picture->format, within = end < picture->width ? end : picture->width;
    if (channels == 1) {
        for (int32_t u = begin; u < within; u++)
            sum[0] += row[u];
    } else if (channels == 2) {
        for (int32_t u = begin; u < within; u++)
            for (int c = 0; c < 2; c++)
                sum[c] += row[2 * u + c];
    } else {
        for (int32_t u = begin; u < within; u++)
            for (int c = 0; c < 4; c++)
                sum[c] += row[4 * u + c];
    }
    for (int32_t u = within; u < end; u++)
        for (int32_t c = 0; c < channels; c++)
            sum[c] += row[mirror_index(u, picture->width) * channels + c];
}

/* Mean of the box of texels that is pixel (x, y) of the level: sums are at most 4096 * 255 < 2^20. */
static void box_mean(uint8_t *mean, const image_t *picture, int32_t x, int32_t y, int log2_x, int log2_y)
{
    uint32_t sum[4] = {0, 0, 0, 0};
    for (int32_t v = y << log2_y; v < (y + 1) << log2_y; v++)
        add_texels(sum, image_row(picture, mirror_index(v, picture->height)), picture, x << log2_x, (x + 1) << log2_x);
    const int log2 = log2_x + log2_y;
    for (int c = 0; c < (int)picture->format; c++)
        mean[c] = (uint8_t)((sum[c] + (1u << log2 >> 1)) >> log2);
}

image_t levels_picture(levels_t *levels, const image_t *picture, level_t level)
{
    if (level.x == 0 && level.y == 0)
        return *picture;
    image_t made = {levels->pixels + levels_offset(level), reduced(picture->width, level.x),
                    reduced(picture->height, level.y), 0, picture->format};
    made.stride = made.width * (int32_t)made.format;
    return made;
}

void levels_make(levels_t *levels, const image_t *picture, level_t level, worker_t worker)
{
    if (level.x == 0 && level.y == 0)
        return;
    const image_t made = levels_picture(levels, picture, level);
    const share_t rows = share_of(worker, made.height);
    for (int32_t y = rows.begin; y < rows.end; y++) {
        uint8_t *row = image_row(&made, y);
        for (int32_t x = 0; x < made.width; x++)
            box_mean(row + x * (int32_t)made.format, picture, x, y, SHIFT * level.x, SHIFT * level.y);
    }
}
