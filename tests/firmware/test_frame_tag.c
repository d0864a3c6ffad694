// SPDX-License-Identifier: Apache-2.0
// The code in the picture: where its bits are, read back from every format and size, refused when any of it is wrong.
#include "firmware/frame_tag.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "firmware/can_protocol.h"
#include "sim/devices/test_pattern.h"
#include "sim/devices/sim_picture.h"
#include "tests/support/tagged.h"

static const frame_tag_t UNTOUCHED = {1, 2, 3};

static uint8_t *pixels, *captured; /* for the largest pictures */

static int set_up(void **state)
{
    (void)state;
    pixels = malloc((size_t)IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888);
    captured = malloc((size_t)IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888);
    return pixels == NULL || captured == NULL;
}

static int tear_down(void **state)
{
    (void)state;
    free(pixels);
    free(captured);
    return 0;
}

static image_t xrgb(int32_t width, int32_t height)
{
    return (image_t){pixels, width, height, 4 * width, IMAGE_XRGB8888};
}

static void every_format_and_size_is_read(void **state)
{
    (void)state;
    static const int32_t sizes[][2] = {{TAGGED_WIDTH, TAGGED_HEIGHT},
                                       {318, 240},
                                       {320, 52},
                                       {480, 270},
                                       {510, 290},
                                       {960, 540},
                                       {1280, 720},
                                       {1366, 768},
                                       {1920, 1080},
                                       {3840, 2160},
                                       {4096, 2160},
                                       {41, 1000}};
    rng_t rng = {1};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
        for (picture_format_t format = PICTURE_XRGB8888; format < PICTURE_FORMATS; format++) {
            const image_t image = xrgb(sizes[s][0], sizes[s][1]);
            const frame_tag_t painted = tagged_random(&rng);
            frame_tag_t found = UNTOUCHED;
            if (picture_is_yuv(format) && image.width % 2 != 0)
                continue;
            test_pattern_draw(&image, 7);
            tagged_paint(&image, &painted);
            const picture_t picture = sim_picture(format, image.width, image.height, captured);
            tagged_convert(&picture, &image);
            if (frame_tag_decode(&found, &picture) != FRAME_TAG_OK)
                fail_msg("%d x %d, format %d", (int)image.width, (int)image.height, (int)format);
            tagged_assert(&found, &painted);
        }
}

static void with_crc(uint8_t bits[TAGGED_BYTES])
{
    const unsigned long crc = crc32(0, bits + 2, 9);
    for (int i = 0; i < 4; i++)
        bits[11 + i] = (uint8_t)(crc >> (24 - 8 * i) & 0xFF);
}

static void bits_are_where_the_header_says(void **state)
{
    (void)state;
    static const uint8_t bits[] = {0xF3, 0x50, 0x12, 0x12, 0x34, 0x56, 0x78, 0x00,
                                   0x0F, 0x42, 0x40, 0xAA, 0x37, 0xA2, 0x80};
    static uint8_t drawn[TAGGED_WIDTH * TAGGED_HEIGHT];
    const frame_tag_t expected = {305419896, 1000000, 2};
    frame_tag_t found = UNTOUCHED;
    const picture_t picture = tagged_draw_bits(pixels, bits);
    assert_int_equal(frame_tag_decode(&found, &picture), FRAME_TAG_OK);
    tagged_assert(&found, &expected);

    memcpy(drawn, pixels, sizeof drawn);
    memset(pixels, 100, sizeof drawn);
    tagged_paint(&(image_t){pixels, TAGGED_WIDTH, TAGGED_HEIGHT, TAGGED_WIDTH, IMAGE_GRAY8}, &expected);
    assert_memory_equal(pixels, drawn, sizeof drawn);
}

static void other_versions_and_viewers_are_foreign(void **state)
{
    (void)state;
    static const struct {
        uint8_t head;
        frame_tag_status_t status;
    } heads[] = {{0x10, FRAME_TAG_OK},      {0x13, FRAME_TAG_OK},      {0x14, FRAME_TAG_FOREIGN},
                 {0x1F, FRAME_TAG_FOREIGN}, {0x00, FRAME_TAG_FOREIGN}, {0x20, FRAME_TAG_FOREIGN}};
    for (size_t h = 0; h < sizeof heads / sizeof heads[0]; h++) {
        uint8_t bits[TAGGED_BYTES] = {0xF3, 0x50, heads[h].head, 1, 2, 3, 4, 5, 6, 7, 8};
        with_crc(bits);
        const picture_t picture = tagged_draw_bits(pixels, bits);
        frame_tag_t found = UNTOUCHED;
        assert_int_equal(frame_tag_decode(&found, &picture), heads[h].status);
        if (heads[h].status != FRAME_TAG_OK)
            tagged_assert(&found, &UNTOUCHED);
    }
}

static void up_to_three_wrong_blocks_are_found_out(void **state)
{
    (void)state;
    uint8_t bits[TAGGED_BYTES] = {0xF3, 0x50, 0x10, 0xDE, 0xAD, 0xBE, 0xEF, 0, 1, 2, 3};
    with_crc(bits);
    for (int a = 0; a < FRAME_TAG_BLOCKS; a++)
        for (int b = a; b < FRAME_TAG_BLOCKS; b++)
            for (int c = b; c < FRAME_TAG_BLOCKS; c++) {
                uint8_t wrong[TAGGED_BYTES] = {0};
                wrong[a / 8] |= (uint8_t)(0x80 >> a % 8);
                wrong[b / 8] |= (uint8_t)(0x80 >> b % 8);
                wrong[c / 8] |= (uint8_t)(0x80 >> c % 8);
                for (int i = 0; i < TAGGED_BYTES; i++)
                    wrong[i] ^= bits[i];
                const picture_t picture = tagged_draw_bits(pixels, wrong);
                frame_tag_t found = UNTOUCHED;
                if (frame_tag_decode(&found, &picture) != (a < 16 ? FRAME_TAG_NONE : FRAME_TAG_DAMAGED))
                    fail_msg("blocks %d, %d, %d", a, b, c);
                tagged_assert(&found, &UNTOUCHED);
            }
}

/* Black of a primary colour, and white of the darkest gray that has enough contrast to it. */
static void luma_of_rgb_is_that_of_jpeg(void **state)
{
    (void)state;
    static const int luma[3] = {28, 149, 76}; /* of B, G, R; rounded down */
    for (int primary = 0; primary < 3; primary++)
        for (int missing = 0; missing < 2; missing++)
            for (picture_format_t format = PICTURE_XRGB8888; format <= PICTURE_BGR888; format++) {
                const image_t image = xrgb(TAGGED_WIDTH, TAGGED_HEIGHT);
                const frame_tag_t painted = {11, 12, 1};
                const int white = luma[primary] + FRAME_TAG_MIN_CONTRAST - missing;
                frame_tag_t found = UNTOUCHED;
                if (format == PICTURE_GRAY8)
                    continue;
                memset(pixels, 128, TAGGED_WIDTH * TAGGED_HEIGHT * 4);
                tagged_paint(&image, &painted);
                for (int n = 0; n < TAGGED_WIDTH * TAGGED_HEIGHT; n++)
                    for (int c = 0; c < 3; c++)
                        pixels[4 * n + c] = (uint8_t)(pixels[4 * n + c] >= 128 ? white : c == primary ? 255 : 0);
                const picture_t picture = sim_picture(format, TAGGED_WIDTH, TAGGED_HEIGHT, captured);
                tagged_convert(&picture, &image);
                assert_int_equal(frame_tag_decode(&found, &picture), missing ? FRAME_TAG_NONE : FRAME_TAG_OK);
                tagged_assert(&found, missing ? &UNTOUCHED : &painted);
            }
}

static void bad_pictures_have_none(void **state)
{
    (void)state;
    frame_tag_layout_t layout = {1, 2, 3, 4};
    frame_tag_t found = UNTOUCHED;
    picture_t picture = sim_picture(PICTURE_XRGB8888, TAGGED_WIDTH, TAGGED_HEIGHT, pixels);
    tagged_paint(&(image_t){pixels, TAGGED_WIDTH, TAGGED_HEIGHT, 4 * TAGGED_WIDTH, IMAGE_XRGB8888}, &UNTOUCHED);
    picture.height = 43;
    assert_int_equal(frame_tag_decode(&found, &picture), FRAME_TAG_NONE);
    assert_false(frame_tag_layout(&layout, TAGGED_WIDTH, 43));
    assert_false(frame_tag_layout(&layout, 3, IMAGE_MAX_HEIGHT));
    assert_int_equal(layout.side_px, 1);
    assert_int_equal(layout.hidden_px, 4);
    picture.height = 0;
    assert_int_equal(frame_tag_decode(&found, &picture), FRAME_TAG_NONE);
    picture.height = TAGGED_HEIGHT;
    picture.format = PICTURE_FORMATS;
    assert_int_equal(frame_tag_decode(&found, &picture), FRAME_TAG_NONE);
    tagged_paint(&(image_t){pixels, TAGGED_WIDTH, TAGGED_HEIGHT, TAGGED_WIDTH, IMAGE_GRAY8}, &UNTOUCHED);
    picture = sim_picture(PICTURE_NV12, TAGGED_WIDTH, TAGGED_HEIGHT - 1, pixels); /* an odd height */
    assert_int_equal(frame_tag_decode(&found, &picture), FRAME_TAG_NONE);
    tagged_assert(&found, &UNTOUCHED);
}

static void layouts_are_those_of_the_header(void **state)
{
    (void)state;
    static const int32_t cases[][6] = {
        {4096, 2160, 8, 120, 1, 10}, {960, 540, 8, 120, 1, 10}, {959, 540, 8, 119, 2, 18}, {480, 270, 8, 60, 2, 18},
        {320, 52, 8, 40, 3, 26},     {319, 52, 4, 79, 2, 10},   {96, 44, 4, 24, 5, 22},    {4, 964, 4, 1, 120, 482}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        frame_tag_layout_t layout;
        assert_true(frame_tag_layout(&layout, cases[c][0], cases[c][1]));
        assert_int_equal(layout.side_px, cases[c][2]);
        assert_int_equal(layout.columns, cases[c][3]);
        assert_int_equal(layout.rows, cases[c][4]);
        assert_int_equal(layout.hidden_px, cases[c][5]);
    }
}

static void poses_are_told_by_viewer_and_time(void **state)
{
    (void)state;
    const frame_tag_t tag = {.capture_time_us = 1234500, .viewer = 1};
    assert_true(frame_tag_is_of(&tag, 1, 1234500, CAN_POSE_FD_WRAP_US));
    assert_true(frame_tag_is_of(&tag, 1, 1234500 + 3 * CAN_POSE_FD_WRAP_US, CAN_POSE_FD_WRAP_US));
    assert_true(frame_tag_is_of(&tag, 1, 1234500 + 3 * CAN_POSE_SET_WRAP_US, CAN_POSE_SET_WRAP_US));
    assert_false(frame_tag_is_of(&tag, 1, 1234500 + 3 * CAN_POSE_SET_WRAP_US, CAN_POSE_FD_WRAP_US));
    assert_false(frame_tag_is_of(&tag, 1, 1234501, CAN_POSE_FD_WRAP_US));
    assert_false(frame_tag_is_of(&tag, 0, 1234500, CAN_POSE_FD_WRAP_US));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_and_size_is_read),
        cmocka_unit_test(bits_are_where_the_header_says),
        cmocka_unit_test(other_versions_and_viewers_are_foreign),
        cmocka_unit_test(up_to_three_wrong_blocks_are_found_out),
        cmocka_unit_test(luma_of_rgb_is_that_of_jpeg),
        cmocka_unit_test(bad_pictures_have_none),
        cmocka_unit_test(layouts_are_those_of_the_header),
        cmocka_unit_test(poses_are_told_by_viewer_and_time),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
