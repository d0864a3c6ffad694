// SPDX-License-Identifier: Apache-2.0
// Pictures with the engine's code in them, in the formats of cameras.
#include "tests/support/tagged.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

#include "sim/devices/sim_picture.h"

void tagged_paint(const image_t *image, const frame_tag_t *tag)
{
    const paint_tag_picture_t picture = {image->data, image->width, image->height, image->stride, (int)image->format};
    const paint_tag_t paint = {tag->capture_time_us, tag->frame_number, tag->viewer};
    assert_true(paint_tag(&picture, &paint));
}

void tagged_convert(const picture_t *to, const image_t *from)
{
    if (to->format != PICTURE_GRAY8) {
        sim_picture_from_xrgb(to, from);
        return;
    }
    for (int32_t y = 0; y < to->height; y++)
        for (int32_t x = 0; x < to->width; x++)
            to->data[0][(ptrdiff_t)y * to->stride[0] + x] = image_row(from, y)[4 * x + 1];
}

picture_t tagged_draw_bits(uint8_t *pixels, const uint8_t bits[TAGGED_BYTES])
{
    enum { SIDE = 4, COLUMNS = TAGGED_WIDTH / SIDE, AROUND = 100 };
    memset(pixels, AROUND, TAGGED_WIDTH * TAGGED_HEIGHT);
    for (int block = 0; block < FRAME_TAG_BLOCKS; block++) {
        const bool white = (bits[block / 8] << block % 8 & 0x80) != 0;
        uint8_t *corner = pixels + block / COLUMNS * SIDE * TAGGED_WIDTH + block % COLUMNS * SIDE;
        for (int y = 0; y < SIDE; y++)
            memset(corner + (ptrdiff_t)y * TAGGED_WIDTH, white ? 224 : 32, SIDE);
    }
    return sim_picture(PICTURE_GRAY8, TAGGED_WIDTH, TAGGED_HEIGHT, pixels);
}

void tagged_assert(const frame_tag_t *found, const frame_tag_t *expected)
{
    assert_int_equal(found->capture_time_us, expected->capture_time_us);
    assert_int_equal(found->frame_number, expected->frame_number);
    assert_int_equal(found->viewer, expected->viewer);
}

frame_tag_t tagged_random(rng_t *rng)
{
    return (frame_tag_t){(uint32_t)rng_next(rng), (uint32_t)rng_next(rng),
                         (uint8_t)rng_int(rng, 0, FRAME_TAG_VIEWERS - 1)};
}
