// SPDX-License-Identifier: Apache-2.0
// Whole frames: every pixel written and no other, border and lit pixels, agreement with point-by-point warping.
#include "warp_fixed/warp.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/oracle.h"

enum { GUARD = 64, GUARD_BYTE = 0xa5 };

static warp_t warp;
static const uint8_t border[3] = {10, 20, 30};

/* A panel with guard bytes before, after and between its rows. */
typedef struct {
    image_t image;
    uint8_t *memory;
    size_t size;
} guarded_t;

static guarded_t guarded(int32_t width, int32_t height, image_format_t format)
{
    guarded_t g;
    const int32_t stride = width * (int32_t)format + GUARD;
    g.size = (size_t)stride * (size_t)height + GUARD;
    g.memory = malloc(g.size);
    assert_non_null(g.memory);
    memset(g.memory, GUARD_BYTE, g.size);
    g.image = (image_t){g.memory + GUARD, width, height, stride, format};
    return g;
}

static void check_guards(const guarded_t *g)
{
    for (size_t i = 0; i < GUARD; i++)
        assert_int_equal(g->memory[i], GUARD_BYTE);
    for (int32_t y = 0; y < g->image.height; y++)
        for (int32_t i = 0; i < GUARD; i++)
            assert_int_equal(image_row(&g->image, y)[g->image.width * (int32_t)g->image.format + i], GUARD_BYTE);
}

/* A random homography between sizes that stress every path: tiny, odd, portrait, one pixel. */
static void random_frame(homography_t *h, rng_t *rng)
{
    const int32_t panel[2] = {(int32_t)rng_int(rng, 1, 90), (int32_t)rng_int(rng, 1, 70)};
    const int32_t picture[2] = {(int32_t)rng_int(rng, 1, 90), (int32_t)rng_int(rng, 1, 70)};
    const double q40 = 1099511627776.0, zoom = rng_double(rng, 0.05, 1) * (rng_int(rng, 0, 3) == 0 ? 60 : 3);
    const double turn = rng_double(rng, -3.2, 3.2), scale = picture[0] * zoom / panel[0];
    const double a = scale * cos(turn), b = scale * sin(turn);
    const double g = rng_double(rng, -0.9, 0.9) / panel[0], k = rng_double(rng, -0.9, 0.9) / panel[1];
    const double x = rng_double(rng, -0.5, 1.5) * picture[0], y = rng_double(rng, -0.5, 1.5) * picture[1];
    const double rows[3][3] = {{a, -b, x - a * panel[0] / 2 + b * panel[1] / 2},
                               {b, a, y - b * panel[0] / 2 - a * panel[1] / 2},
                               {g, k, 1 - g * panel[0] / 2 - k * panel[1] / 2}};
    int64_t rows_q40[3][3];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            rows_q40[r][c] = (int64_t)(rows[r][c] * q40);
    homography_from_indices(h, (const int64_t(*)[3])rows_q40, panel, picture);
}

static void check_frame(uint64_t seed, const warp_method_t *method, image_format_t format)
{
    rng_t rng = {seed};
    homography_t h;
    random_frame(&h, &rng);
    guarded_t panel = guarded(h.panel_width, h.panel_height, format);
    guarded_t picture = guarded(h.picture_width, h.picture_height, format);
    for (int32_t y = 0; y < h.picture_height; y++)
        for (int32_t i = 0; i < h.picture_width * (int32_t)format; i++)
            image_row(&picture.image, y)[i] = (uint8_t)(128 + rng_int(&rng, 0, 60)); /* never the border's colour */

    warp_report_t report;
    warp_init(&warp, *method, false, border);
    if (!warp_frame(&warp, &warp_kernels_scalar, &report, &h, &panel.image, &picture.image))
        fail_msg("seed %lu, %s: refused", (unsigned long)seed, method->name);
    check_guards(&panel);
    check_guards(&picture);

    int32_t lit = 0;
    const uint8_t border_bytes[4] = {border[2], border[1], border[0], 0};
    for (int32_t j = 0; j < h.panel_height; j++) {
        for (int32_t i = 0; i < h.panel_width; i++) {
            const uint8_t *pixel = image_row(&panel.image, j) + i * (int32_t)format;
            int32_t x, y;
            const bool is_lit = grid_point(&warp.plane[0].grid, i, j, &x, &y);
            const bool is_border = memcmp(pixel, border_bytes, format) == 0;
            lit += is_lit;
            if (is_border == is_lit)
                fail_msg("seed %lu, %s, pixel (%d, %d): lit is %d, border is %d", (unsigned long)seed, method->name, i,
                         j, is_lit, is_border);
        }
    }
    assert_int_equal(report.lit_pixels, lit);
    free(panel.memory);
    free(picture.memory);
}

static void frames_are_whole_and_nothing_else(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 800; seed++)
        check_frame(seed, &warp_methods[seed % WARP_METHODS], seed % 3 == 0 ? IMAGE_GRAY8 : IMAGE_XRGB8888);
}

/* At 1:1 every method passes the picture unchanged. */
static void identity_is_unchanged(void **state)
{
    (void)state;
    const int64_t one = (int64_t)1 << 40;
    const int64_t rows[3][3] = {{one, 0, 0}, {0, one, 0}, {0, 0, one}};
    const int32_t size[2] = {123, 67};
    homography_t h;
    homography_from_indices(&h, rows, size, size);
    guarded_t panel = guarded(size[0], size[1], IMAGE_XRGB8888), picture = guarded(size[0], size[1], IMAGE_XRGB8888);
    rng_t rng = {5};
    for (int32_t y = 0; y < size[1]; y++)
        for (int32_t i = 0; i < size[0] * 4; i++)
            image_row(&picture.image, y)[i] = (uint8_t)rng_next(&rng);
    for (int m = 0; m < WARP_METHODS; m++) {
        warp_report_t report;
        warp_init(&warp, warp_methods[m], false, border);
        assert_true(warp_frame(&warp, &warp_kernels_scalar, &report, &h, &panel.image, &picture.image));
        assert_memory_equal(panel.memory, picture.memory, panel.size);
        assert_int_equal(report.k_in_q16, 1 << 16);
        assert_int_equal(report.k_all_q16, 1 << 16);
    }
    free(panel.memory);
    free(picture.memory);
}

/* Step k is worked out for methods that need it, and for whoever asks. */
static void steps_are_known_to_who_asks(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 100; seed++) {
        const warp_method_t *method = &warp_methods[seed % WARP_METHODS];
        const bool needed = method->filter != WARP_FILTER_NONE || warp_splines(method->resampler) ||
                            method->resampler == WARP_LS || method->resampler == WARP_AUTO;
        rng_t rng = {seed};
        homography_t h;
        random_frame(&h, &rng);
        const footprint_step_t step = footprint_step(&h);
        guarded_t images[2] = {guarded(h.panel_width, h.panel_height, IMAGE_GRAY8),
                               guarded(h.picture_width, h.picture_height, IMAGE_GRAY8)};
        const picture_t panel = picture_from_image(&images[0].image), picture = picture_from_image(&images[1].image);
        warp_report_t report = {.k_in_q16 = 1, .k_all_q16 = 1};
        warp_init(&warp, *method, false, border);
        warp_report_step(&warp, &report);
        assert_int_equal(report.k_in_q16, 0);
        assert_int_equal(report.k_all_q16, 0);
        assert_true(warp_plan(&warp, &warp_kernels_scalar, &report, &h, &panel, &picture));
        if (report.k_in_q16 != (needed ? step.in_q16 : 0) || report.k_all_q16 != (needed ? step.all_q16 : 0))
            fail_msg("seed %lu, %s: planned for steps %d and %d", (unsigned long)seed, method->name, report.k_in_q16,
                     report.k_all_q16);
        warp_report_step(&warp, &report);
        if (report.k_in_q16 != step.in_q16 || report.k_all_q16 != step.all_q16)
            fail_msg("seed %lu, %s: steps %d and %d are reported, not %d and %d", (unsigned long)seed, method->name,
                     report.k_in_q16, report.k_all_q16, step.in_q16, step.all_q16);
        free(images[0].memory);
        free(images[1].memory);
    }
}

/* Footprints of hundreds of pixels: the mean of the picture, at a bounded cost, through the halved levels. */
static void huge_footprints_see_the_mean(void **state)
{
    (void)state;
    const int32_t panel_size[2] = {4, 3}, picture_size[2] = {3000, 2000};
    const int64_t rows[3][3] = {{(int64_t)750 << 40, 0, (int64_t)375 << 40},
                                {0, (int64_t)666 << 40, (int64_t)333 << 40},
                                {0, 0, (int64_t)1 << 40}};
    homography_t h;
    homography_from_indices(&h, rows, panel_size, picture_size);
    guarded_t panel = guarded(4, 3, IMAGE_GRAY8), picture = guarded(3000, 2000, IMAGE_GRAY8);
    rng_t rng = {9};
    for (int32_t y = 0; y < 2000; y++)
        for (int32_t x = 0; x < 3000; x++)
            image_row(&picture.image, y)[x] = (uint8_t)(rng_int(&rng, 0, 255) / 2 + x / 750 * 20);
    for (int m = 0; m < WARP_METHODS; m++) {
        if (!warp_averages(warp_methods[m].resampler))
            continue;
        warp_init(&warp, warp_methods[m], false, border);
        assert_true(warp_frame(&warp, &warp_kernels_scalar, NULL, &h, &panel.image, &picture.image));
        for (int32_t i = 0; i < 12; i++)
            assert_in_range(image_row(&panel.image, i / 4)[i % 4], 63 + i % 4 * 20 - 2, 63 + i % 4 * 20 + 2);
    }
    free(panel.memory);
    free(picture.memory);
}

/* A viewer who looks away: no method touches the picture, so that a frame without a single kernel is made. */
static void unlit_frames_leave_the_picture_alone(void **state)
{
    (void)state;
    static const warp_kernels_t none = {0};
    const int64_t one = (int64_t)1 << 40;
    const int64_t rows[3][3] = {{3 * one, 0, 900 * one}, {0, 3 * one, 0}, {0, 0, one}};
    const int32_t size[2] = {31, 17};
    homography_t h;
    homography_from_indices(&h, rows, size, size);
    guarded_t panel = guarded(31, 17, IMAGE_GRAY8), picture = guarded(31, 17, IMAGE_GRAY8);
    for (int m = 0; m < 2 * WARP_METHODS; m++) {
        warp_report_t report;
        warp_init(&warp, warp_methods[m / 2], m % 2 == 1, border);
        assert_true(warp_frame(&warp, &none, &report, &h, &panel.image, &picture.image));
        assert_int_equal(report.lit_pixels, 0);
        assert_int_equal(report.k_all_q16, 3 << 16);
        for (int32_t k = 0; k < 31 * 17; k++)
            assert_int_equal(image_row(&panel.image, k / 31)[k % 31], border[2]);
    }
    check_guards(&panel);
    free(panel.memory);
    free(picture.memory);
}

static void wrong_images_are_refused(void **state)
{
    (void)state;
    const int64_t one = (int64_t)1 << 40;
    const int64_t rows[3][3] = {{one, 0, 0}, {0, one, 0}, {0, 0, one}};
    const int32_t size[2] = {16, 16};
    homography_t h;
    homography_from_indices(&h, rows, size, size);
    guarded_t panel = guarded(16, 16, IMAGE_GRAY8), picture = guarded(16, 16, IMAGE_GRAY8);
    guarded_t other = guarded(15, 16, IMAGE_GRAY8), color = guarded(16, 16, IMAGE_XRGB8888);
    warp_init(&warp, *warp_method_default(), false, border);
    assert_false(warp_frame(&warp, &warp_kernels_scalar, NULL, &h, &panel.image, &other.image));
    assert_false(warp_frame(&warp, &warp_kernels_scalar, NULL, &h, &other.image, &picture.image));
    assert_false(warp_frame(&warp, &warp_kernels_scalar, NULL, &h, &panel.image, &color.image));
    for (size_t i = 0; i < panel.size; i++)
        assert_int_equal(panel.memory[i], GUARD_BYTE);
    free(panel.memory);
    free(picture.memory);
    free(other.memory);
    free(color.memory);
}

static void methods_are_found_by_name(void **state)
{
    (void)state;
    for (int m = 0; m < WARP_METHODS; m++)
        assert_ptr_equal(warp_method_from_name(warp_methods[m].name), &warp_methods[m]);
    assert_null(warp_method_from_name("mean"));
    assert_null(warp_method_from_name(""));
    assert_null(warp_method_from_name("mean+cubic "));
    assert_string_equal(warp_method_default()->name, "mean+cubic");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_whole_and_nothing_else), cmocka_unit_test(identity_is_unchanged),
        cmocka_unit_test(huge_footprints_see_the_mean),      cmocka_unit_test(wrong_images_are_refused),
        cmocka_unit_test(methods_are_found_by_name),         cmocka_unit_test(unlit_frames_leave_the_picture_alone),
        cmocka_unit_test(steps_are_known_to_who_asks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
