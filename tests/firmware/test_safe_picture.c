// SPDX-License-Identifier: Apache-2.0
// The safe picture: the same greys on a panel of any format, every pixel of it and no other byte.
#include "firmware/safe_picture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/devices/sim_picture.h"

enum { WIDTH = 200, HEIGHT = 120, NODE = 23, GUARD = 64, MAX_BYTES = WIDTH * HEIGHT * 4, UNTOUCHED = 0xa5 };

static uint8_t drawn[MAX_BYTES + GUARD], reference[MAX_BYTES], shown[MAX_BYTES];

static picture_t draw_text(picture_format_t format, picture_matrix_t matrix, int32_t width, int32_t height,
                           const safe_picture_t *what)
{
    picture_t panel = sim_picture(format, width, height, drawn);
    panel.matrix = matrix;
    memset(drawn, UNTOUCHED, sizeof drawn);
    safe_picture_draw(&panel, what);
    for (size_t i = 0; i < GUARD; i++)
        assert_int_equal(drawn[sim_picture_bytes(&panel) + i], UNTOUCHED);
    return panel;
}

static picture_t draw(picture_format_t format, picture_matrix_t matrix, int32_t width, int32_t height)
{
    return draw_text(format, matrix, width, height, &(safe_picture_t){"front", NODE, "no pose"});
}

static void check_greys(picture_format_t format, picture_matrix_t matrix)
{
    const image_t image = {shown, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t panel = draw(format, matrix, WIDTH, HEIGHT);
    sim_picture_to_xrgb(&image, &panel);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        for (int c = 0; c < 3; c++)
            if (abs(shown[4 * i + c] - reference[4 * i]) > 1)
                fail_msg("%s: channel %d of pixel %d, %d is %d, expected %d", sim_picture_formats[format], c, i % WIDTH,
                         i / WIDTH, shown[4 * i + c], reference[4 * i]);
}

static void formats_show_the_same(void **state)
{
    (void)state;
    draw(PICTURE_XRGB8888, PICTURE_BT709, WIDTH, HEIGHT);
    memcpy(reference, drawn, sizeof reference);
    int levels[256] = {0};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int c = 1; c < 4; c++)
            assert_int_equal(reference[4 * i + c], reference[4 * i]);
        levels[reference[4 * i]]++;
    }
    assert_true(levels[24] > WIDTH * HEIGHT / 2 && levels[72] > 2 * WIDTH && levels[160] > 10);
    assert_int_equal(levels[24] + levels[72] + levels[160], WIDTH * HEIGHT);
    for (picture_matrix_t matrix = PICTURE_BT709; matrix <= PICTURE_BT601; matrix++) {
        check_greys(PICTURE_YUYV, matrix);
        check_greys(PICTURE_UYVY, matrix);
        check_greys(PICTURE_NV12, matrix);
    }
}

static void gray_panels_too(void **state)
{
    (void)state;
    draw(PICTURE_GRAY8, PICTURE_BT709, WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_int_equal(drawn[i], reference[4 * i]);
}

static void any_size(void **state)
{
    (void)state;
    char reason[600];
    memset(reason, 'm', sizeof reason);
    reason[sizeof reason - 1] = '\0';
    const safe_picture_t what = {"of-thirty-one-letters-is-a-name", 63, reason};
    for (int32_t width = 1; width < 90; width += width < 40 ? 1 : 7)
        for (int32_t height = 1; height < 60; height += height < 20 ? 1 : 7) {
            const picture_t panel = draw_text(PICTURE_XRGB8888, PICTURE_BT709, width, height, &what);
            for (size_t i = 0; i < sim_picture_bytes(&panel); i++)
                assert_true(drawn[i] == 24 || drawn[i] == 72 || drawn[i] == 160);
        }
}

static uint64_t hash_of(const picture_t *panel)
{
    uint64_t hash = 0xcbf29ce484222325U;
    for (size_t i = 0; i < sim_picture_bytes(panel); i++)
        hash = (hash ^ drawn[i]) * 0x100000001b3U;
    return hash;
}

/* Looked at once, and the same ever since. */
static void expect_look(int32_t width, int32_t height, const safe_picture_t *what, uint64_t expected)
{
    const picture_t panel = draw_text(PICTURE_GRAY8, PICTURE_BT709, width, height, what);
    const uint64_t found = hash_of(&panel);
    if (found != expected)
        fail_msg("%dx%d, %s: found %016llx, expected %016llx", width, height, what->reason, (unsigned long long)found,
                 (unsigned long long)expected);
}

static void it_looks_as_it_did(void **state)
{
    (void)state;
    expect_look(64, 48, &(safe_picture_t){"front", 7, "no pose"}, 0xbbba8d1d7d4395adU);
    expect_look(200, 120, &(safe_picture_t){"front", 12, "no video"}, 0x0df63a720a091095U);
    expect_look(200, 120, &(safe_picture_t){"rpi4", 0, "/etc/wallwarp/wallwarp.yaml:3: node: missing"},
                0xf6a28844c497c695U);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_show_the_same),
        cmocka_unit_test(gray_panels_too),
        cmocka_unit_test(any_size),
        cmocka_unit_test(it_looks_as_it_did),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
