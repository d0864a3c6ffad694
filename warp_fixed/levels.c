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

/* Mean of the box of texels that is pixel (x, y) of the level, for one channel: at most 4096 * 255 < 2^20. */
static uint8_t box_mean(const image_t *picture, int32_t x, int32_t y, int log2_x, int log2_y, int channel)
{
    uint32_t sum = 0;
    for (int32_t v = y << log2_y; v < (y + 1) << log2_y; v++) {
        const uint8_t *row = image_row(picture, mirror_index(v, picture->height)) + channel;
        for (int32_t u = x << log2_x; u < (x + 1) << log2_x; u++)
            sum += row[mirror_index(u, picture->width) * (int32_t)picture->format];
    }
    const int log2 = log2_x + log2_y;
    return (uint8_t)((sum + (1u << log2 >> 1)) >> log2);
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
            for (int channel = 0; channel < (int)level.format; channel++)
                *row++ = box_mean(picture, x, y, SHIFT * level_x, SHIFT * level_y, channel);
    }
    levels->made[level_x][level_y] = true;
    return level;
}
