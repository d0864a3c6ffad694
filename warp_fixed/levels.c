// SPDX-License-Identifier: Apache-2.0
// The picture at 1/8 and 1/64 of its size along either axis, for footprints of more than 64 texels.
#include "warp_fixed/levels.h"

#include "warp_fixed/fixed.h"

enum { SHIFT = 3 };

static int32_t reduced(int32_t size, int level)
{
    return (size + (1 << (SHIFT * level)) - 1) >> (SHIFT * level);
}

ptrdiff_t levels_offset(int level_x, int level_y)
{
    ptrdiff_t offset = 0;
    for (int level = 1; level < level_x * LEVELS + level_y; level++)
        offset += (ptrdiff_t)IMAGE_XRGB8888 * reduced(IMAGE_MAX_WIDTH, level / LEVELS) *
                  reduced(IMAGE_MAX_HEIGHT, level % LEVELS);
    return offset;
}

void levels_begin(levels_t *levels)
{
    for (int level_x = 0; level_x < LEVELS; level_x++)
        for (int level_y = 0; level_y < LEVELS; level_y++)
            levels->made[level_x][level_y] = false;
}

/* Add texels [begin, end) of a row, mirrored beyond its end, to each channel's sum. */
static void add_texels(uint32_t sum[4], const uint8_t *row, const image_t *picture, int32_t begin, int32_t end)
{
    const int32_t channels = (int32_t)picture->format, within = end < picture->width ? end : picture->width;
    if (channels == 1) {
        for (int32_t u = begin; u < within; u++)
            sum[0] += row[u];
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

image_t levels_picture(levels_t *levels, const image_t *picture, int level_x, int level_y)
{
    if (level_x == 0 && level_y == 0)
        return *picture;
    image_t level = {levels->pixels + levels_offset(level_x, level_y), reduced(picture->width, level_x),
                     reduced(picture->height, level_y), 0, picture->format};
    level.stride = level.width * (int32_t)level.format;
    if (levels->made[level_x][level_y])
        return level;
    for (int32_t y = 0; y < level.height; y++) {
        uint8_t *row = image_row(&level, y);
        for (int32_t x = 0; x < level.width; x++)
            box_mean(row + x * (int32_t)level.format, picture, x, y, SHIFT * level_x, SHIFT * level_y);
    }
    levels->made[level_x][level_y] = true;
    return level;
}
