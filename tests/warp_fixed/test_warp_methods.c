// SPDX-License-Identifier: Apache-2.0
// Tests of a warp that is ready for several methods: each frame is, byte for byte, that of a warp for its method alone.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/homography_of.h"
#include "tests/support/rng.h"
#include "warp_fixed/warp.h"

enum { WIDTH = 64, HEIGHT = 40, FRAMES = 40, MOST = 5 };

static const uint8_t border[3] = {1, 2, 3};

static warp_t warp, alone;
static uint8_t pixels[WIDTH * HEIGHT * 4], shown[WIDTH * HEIGHT * 4], expected[WIDTH * HEIGHT * 4];
static ls_weights_t weights;

static image_t image(uint8_t *bytes)
{
    return (image_t){bytes, WIDTH, HEIGHT, 4 * WIDTH, IMAGE_XRGB8888};
}

/* Minified and from the side, or magnified (k < 1). */
static homography_t view(rng_t *rng)
{
    const double scale = rng_int(rng, 0, 1) == 0 ? 2.2 : 0.6;
    const double rows[9] = {scale, 0.1, -10, -0.1, scale, -5, 0.003, 0.0002, 1};
    return homography_of(rows, (homography_sizes_t){WIDTH, HEIGHT, WIDTH, HEIGHT});
}

static void assert_same_frames(uint64_t seed, const char *const names[MOST])
{
    rng_t rng = {seed};
    const warp_method_t *method[MOST];
    int count = 0;
    for (; count < MOST && names[count] != NULL; count++)
        method[count] = warp_method_from_name(names[count]);
    warp_init(&warp, *method[0], false, border);
    warp_set_ls_weights(&warp, &weights);
    for (int i = 1; i < count; i++)
        assert_true(warp_add_method(&warp, *method[i]));
    const image_t picture = image(pixels), panel = image(shown), other = image(expected);
    for (int n = 0; n < FRAMES; n++) {
        const warp_method_t *used = method[n == 0 ? 0 : rng_int(&rng, 0, count - 1)];
        const homography_t homography = view(&rng);
        for (size_t i = 0; i < sizeof pixels; i++)
            pixels[i] = (uint8_t)rng_next(&rng);
        warp_use_method(&warp, *used);
        warp_init(&alone, *used, false, border);
        warp_set_ls_weights(&alone, &weights);
        assert_true(warp_frame(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &picture));
        assert_true(warp_frame(&alone, &warp_kernels_scalar, NULL, &homography, &other, &picture));
        if (memcmp(shown, expected, sizeof shown) != 0)
            fail_msg("seed %d frame %d: %s, beside %s, differs", (int)seed, n, used->name, names[0]);
    }
}

static void test_methods_side_by_side(void **state)
{
    (void)state;
    static const char *const sets[][MOST] = {
        {"mean+spline", "mean+cubic", "area", "none+linear", "none+nearest"},
        {"auto", "mean+cubic", "area", "none+linear", "none+nearest"},
        {"ls", "mean+cubic", "area", "none+linear", "none+nearest"},
        {"gauss+cubic", "area", "none+linear", "none+nearest"},
        {"butter+spline", "area", "none+linear", "none+nearest"},
        {"kaiser+nearest", "gauss+nearest", "area", "none+linear", "none+nearest"},
        {"none+spline", "none+cubic", "none+linear", "none+nearest"},
    };
    for (int i = 0; i < HEIGHT; i++)
        weights.y[i] = (uint16_t)(i % 3 == 0 ? LS_WEIGHT_ONE : LS_WEIGHT_ONE / 2);
    for (int i = 0; i < WIDTH; i++)
        weights.x[i] = LS_WEIGHT_ONE;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        assert_same_frames(i + 1, sets[i]);
}

static void test_what_does_not_fit_is_refused(void **state)
{
    (void)state;
    const warp_method_t *ls = warp_method_from_name("ls"), *spline = warp_method_from_name("mean+spline");
    warp_init(&warp, *ls, false, border);
    assert_true(warp_has_method(&warp, *ls));
    assert_false(warp_has_method(&warp, *spline));
    assert_false(warp_has_method(&warp, *warp_method_from_name("none+linear")));
    assert_true(warp_has_method(&warp, *warp_method_from_name("none+nearest")));
    assert_false(warp_add_method(&warp, *spline));
    assert_false(warp_add_method(&warp, *warp_method_from_name("gauss+nearest")));
    assert_false(warp_add_method(&warp, *warp_method_from_name("auto")));
    assert_true(warp_add_method(&warp, *ls));
    warp_init(&warp, *spline, false, border);
    assert_false(warp_add_method(&warp, *ls));
    assert_true(warp_add_method(&warp, *warp_method_from_name("auto"))); /* mean+cubic besides */
    assert_true(warp_add_method(&warp, *warp_method_from_name("area")));
    assert_false(warp_add_method(&warp, *warp_method_from_name("gauss+linear"))); /* two, and there is one */
    assert_int_equal(warp.tables, 3);
    assert_true(warp_has_method(&warp, *spline));
    assert_true(warp_has_method(&warp, *warp_method_from_name("auto")));
    assert_true(warp_has_method(&warp, *warp_method_from_name("gauss+nearest")));
    assert_false(warp_has_method(&warp, *ls));
    assert_false(warp_has_method(&warp, *warp_method_from_name("gauss+linear")));
    assert_false(warp_has_method(&warp, *warp_method_from_name("none+linear")));
    assert_true(warp_add_method(&warp, *warp_method_from_name("none+linear")));
    assert_true(warp_add_method(&warp, *warp_method_from_name("mean+cubic")));
    assert_false(warp_add_method(&warp, *warp_method_from_name("none+cubic")));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_methods_side_by_side),
        cmocka_unit_test(test_what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
