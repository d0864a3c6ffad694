// SPDX-License-Identifier: Apache-2.0
// The viewer's view of hand-made walls, and of a room that was corrected for it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>

#include "sim/eval/viewer_picture.h"
#include "tests/support/homography_of.h"
#include "warp_fixed/warp.h"

static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static image_t gray(uint8_t *data, int32_t width, int32_t height)
{
    return (image_t){.data = data, .width = width, .height = height, .stride = width, .format = IMAGE_GRAY8};
}

/* A wall of `panel` pixels seen in a picture of 4 x 1 pixels. */
static viewer_wall_t wall_of(const double rows[9], int32_t panel_width, image_t shown)
{
    const homography_t fixed = homography_of(rows, (homography_sizes_t){panel_width, 1, 4, 1});
    viewer_wall_t wall = {.shown = shown};
    double_homography_from_fixed(&wall.homography, &fixed);
    return wall;
}

static void view_is(const viewer_wall_t *walls, int32_t count, int32_t samples, const uint8_t expected[4])
{
    uint8_t seen[6] = {77, 77, 77, 77, 77, 77};
    const image_t out = gray(seen + 1, 4, 1);
    viewer_picture(&out, walls, count, samples);
    assert_memory_equal(seen + 1, expected, 4);
    assert_int_equal(seen[0], 77);
    assert_int_equal(seen[5], 77);
}

static void no_wall_is_background(void **state)
{
    (void)state;
    view_is(NULL, 0, 3, (const uint8_t[4]){24, 24, 24, 24});
}

static void wall_that_fills_the_view_shows_its_panel(void **state)
{
    (void)state;
    uint8_t shown[4] = {1, 2, 3, 200};
    const viewer_wall_t wall = wall_of(identity, 4, gray(shown, 4, 1));
    for (int32_t samples = 1; samples <= VIEWER_MAX_SAMPLES; samples++)
        view_is(&wall, 1, samples, shown);
}

static void colours_keep_their_places(void **state)
{
    (void)state;
    uint8_t shown[16] = {1, 2, 3, 0, 10, 20, 30, 0, 0, 128, 255, 0, 99, 98, 97, 0}, seen[16];
    const image_t panel = {.data = shown, .width = 4, .height = 1, .stride = 16, .format = IMAGE_XRGB8888};
    const image_t out = {.data = seen, .width = 4, .height = 1, .stride = 16, .format = IMAGE_XRGB8888};
    const viewer_wall_t wall = wall_of(identity, 4, panel);
    viewer_picture(&out, &wall, 1, 2);
    assert_memory_equal(seen, shown, 16);
}

static void smaller_wall_leaves_background(void **state)
{
    (void)state;
    const double middle[9] = {0.5, 0, 0.75, 0, 1, 0, 0, 0, 1}; /* from 0.75 to 2.75 of 4 */
    uint8_t shown[4] = {100, 100, 200, 200};
    const viewer_wall_t wall = wall_of(middle, 4, gray(shown, 4, 1));
    view_is(&wall, 1, 1, (const uint8_t[4]){24, 100, 200, 24});
    /* looks at 1/8, 3/8, 5/8, 7/8 of a pixel */
    view_is(&wall, 1, 4, (const uint8_t[4]){(3 * 24 + 100) / 4, 125, (3 * 200 + 24) / 4, 24});
}

static void means_are_rounded_half_up(void **state)
{
    (void)state;
    uint8_t shown[8] = {10, 11, 10, 13, 255, 254, 0, 1};
    const viewer_wall_t wall = wall_of((const double[9]){0.5, 0, 0, 0, 1, 0, 0, 0, 1}, 8, gray(shown, 8, 1));
    view_is(&wall, 1, 2, (const uint8_t[4]){11, 12, 255, 1});
}

static void rows_keep_their_places(void **state)
{
    (void)state;
    uint8_t shown[4] = {10, 20, 30, 40}, seen[4], upper[2];
    const homography_t fixed = homography_of(identity, (homography_sizes_t){1, 4, 1, 4});
    viewer_wall_t wall = {.shown = gray(shown, 1, 4)};
    double_homography_from_fixed(&wall.homography, &fixed);
    const image_t out = gray(seen, 1, 4), half = gray(upper, 1, 2);
    viewer_picture(&out, &wall, 1, 3);
    assert_memory_equal(seen, shown, 4);
    viewer_picture(&half, &wall, 1, 3); /* looks at 1/3, 1, 5/3, 7/3, 3, 11/3 */
    assert_int_equal(upper[0], (10 + 20 + 20 + 1) / 3);
    assert_int_equal(upper[1], (30 + 40 + 40 + 1) / 3);
}

static void picture_is_stretched_over_the_panel(void **state)
{
    (void)state;
    uint8_t shown[2] = {50, 60};
    const viewer_wall_t wall = wall_of((const double[9]){0.01, 0, 0, 0, 1, 0, 0, 0, 1}, 400, gray(shown, 2, 1));
    view_is(&wall, 1, 2, (const uint8_t[4]){50, 50, 60, 60});
}

static void smaller_view_sees_as_much(void **state)
{
    (void)state;
    uint8_t shown[4] = {10, 20, 30, 40}, seen[2];
    const viewer_wall_t wall = wall_of(identity, 4, gray(shown, 4, 1));
    const image_t out = gray(seen, 2, 1);
    viewer_picture(&out, &wall, 1, 2);
    assert_int_equal(seen[0], 15);
    assert_int_equal(seen[1], 35);
}

static void nearer_wall_hides_the_farther(void **state)
{
    (void)state;
    const double twice_as_far[9] = {2, 0, 0, 0, 2, 0, 0, 0, 2};
    const double turned[9] = {1, 0, 0, 0, 1, 0, 0.25, 0, 1}; /* its depth grows from 1 to 2 towards the right */
    uint8_t a[4] = {1, 1, 1, 1}, b[4] = {2, 2, 2, 2};
    viewer_wall_t walls[2] = {wall_of(identity, 4, gray(a, 4, 1)), wall_of(twice_as_far, 4, gray(b, 4, 1))};
    view_is(walls, 2, 2, (const uint8_t[4]){1, 1, 1, 1});
    const viewer_wall_t swapped[2] = {walls[1], walls[0]};
    view_is(swapped, 2, 2, (const uint8_t[4]){1, 1, 1, 1});
    /* At picture point x, walls of constant depth 4/3 and of depth 1 / (1 - x/4) (four times as wide) cross at 1. */
    const double four_thirds[9] = {4.0 / 3, 0, 0, 0, 4.0 / 3, 0, 0, 0, 4.0 / 3};
    walls[0] = wall_of(turned, 16, gray(a, 4, 1));
    walls[1] = wall_of(four_thirds, 4, gray(b, 4, 1));
    view_is(walls, 2, 1, (const uint8_t[4]){1, 2, 2, 2});
}

static void wall_behind_or_edge_on_is_not_seen(void **state)
{
    (void)state;
    uint8_t shown[4] = {1, 2, 3, 4};
    const image_t panel = gray(shown, 4, 1);
    const viewer_wall_t walls[2] = {wall_of((const double[9]){-1, 0, 0, 0, -1, 0, 0, 0, -1}, 4, panel),
                                    wall_of((const double[9]){1, 0, 0, 2, 0, 0, 0, 0, 1}, 4, panel)};
    view_is(walls, 2, 2, (const uint8_t[4]){24, 24, 24, 24});
    /* Half of it is behind: depth 1 - u/2. Only u < 2 is seen, u = x / (1 + x/2). */
    const viewer_wall_t half = wall_of((const double[9]){1, 0, 0, 0, 1, 0, -0.5, 0, 1}, 4, panel);
    view_is(&half, 1, 1, (const uint8_t[4]){1, 1, 2, 2});
}

/* A keystoned wall, seen obliquely. */
static homography_t oblique_view(int32_t panel_width, int32_t panel_height, const camera_t *camera)
{
    const wall_corners_t corners = {
        .panel_width = panel_width,
        .panel_height = panel_height,
        .corner_um = {{-2000000, -1200000, 0}, {2100000, -1100000, 0}, {2000000, 1150000, 0}, {-1900000, 1200000, 0}},
        .corner_known = {true, true, true, true},
    };
    /* The eye is 30 degrees off the wall's normal and looks at its middle, rolled a little. */
    const pose_t pose = {.eye_nm = {1250000000, 100000000, -2165000000},
                         .quaternion_q30 = {1037000000, 10000000, -277900000, 40000000}};
    wall_t wall;
    homography_t homography;
    assert_int_equal(wall_from_corners(&wall, &corners), WALL_OK);
    assert_true(homography_from_pose(&homography, camera, &wall, &pose));
    return homography;
}

static void corrected_wall_looks_like_the_picture(void **state)
{
    (void)state;
    enum { WIDTH = 160, HEIGHT = 90 };
    static uint8_t pixels[WIDTH * HEIGHT], lit[2 * WIDTH * 2 * HEIGHT], seen[WIDTH * HEIGHT];
    const camera_t camera = {.width = WIDTH,
                             .height = HEIGHT,
                             .focal_upx = {100000000, 100000000},
                             .principal_upx = {WIDTH * 500000, HEIGHT * 500000}};
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x < WIDTH; x++)
            pixels[y * WIDTH + x] = (uint8_t)(40 + x + y / 2);
    const image_t picture = gray(pixels, WIDTH, HEIGHT), panel = gray(lit, 2 * WIDTH, 2 * HEIGHT);
    const image_t out = gray(seen, WIDTH, HEIGHT);
    const homography_t homography = oblique_view(panel.width, panel.height, &camera);
    warp_t *warp = malloc(sizeof *warp);
    assert_non_null(warp);
    warp_init(warp, *warp_method_default(), false, (const uint8_t[3]){0, 0, 0});
    assert_true(warp_frame(warp, &warp_kernels_scalar, NULL, &homography, &panel, &picture));
    free(warp);

    viewer_wall_t wall = {.shown = panel};
    double_homography_from_fixed(&wall.homography, &homography);
    viewer_picture(&out, &wall, 1, 4);
    int32_t on_wall = 0;
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x < WIDTH; x++) {
            const int32_t at = y * WIDTH + x, neighbours[5] = {0, -1, 1, -WIDTH, WIDTH};
            bool inner = x > 0 && x < WIDTH - 1 && y > 0 && y < HEIGHT - 1;
            for (int n = 0; inner && n < 5; n++)
                inner = seen[at + neighbours[n]] != VIEWER_BACKGROUND;
            if (!inner || seen[at] < 38) /* less: part of it is beside the wall */
                continue;
            on_wall++;
            if (abs(seen[at] - pixels[at]) > 1)
                fail_msg("pixel %d, %d: seen %d, expected %d", x, y, seen[at], pixels[at]);
        }
    assert_in_range(on_wall, WIDTH * HEIGHT / 2, WIDTH * HEIGHT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_wall_is_background),
        cmocka_unit_test(wall_that_fills_the_view_shows_its_panel),
        cmocka_unit_test(colours_keep_their_places),
        cmocka_unit_test(smaller_wall_leaves_background),
        cmocka_unit_test(means_are_rounded_half_up),
        cmocka_unit_test(rows_keep_their_places),
        cmocka_unit_test(picture_is_stretched_over_the_panel),
        cmocka_unit_test(smaller_view_sees_as_much),
        cmocka_unit_test(nearer_wall_hides_the_farther),
        cmocka_unit_test(wall_behind_or_edge_on_is_not_seen),
        cmocka_unit_test(corrected_wall_looks_like_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
