// SPDX-License-Identifier: Apache-2.0
// How many samples a wall is judged by: enough for its panel, and a multiple of the original's size.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>

#include "sim/eval/mesh_psnr.h"
#include "sim/run/run_judge.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"

enum { WIDTH = 24, HEIGHT = 16 };

/* A picture of gray noise, XRGB8888 or GRAY8; the caller frees its data. */
static image_t noise(int32_t width, int32_t height, image_format_t format, uint64_t seed)
{
    const int32_t stride = width * (int32_t)format;
    const image_t image = {malloc((size_t)stride * (size_t)height), width, height, stride, format};
    rng_t rng = {.state = seed};
    assert_non_null(image.data);
    for (int32_t y = 0; y < height; y++)
        for (int32_t x = 0; x < width; x++) {
            const uint8_t level = (uint8_t)rng_int(&rng, 0, 255);
            for (int32_t b = 0; b < (int32_t)format; b++)
                image_row(&image, y)[x * (int32_t)format + b] = level;
        }
    return image;
}

static image_t gray_of(const image_t *colour)
{
    const image_t gray = {malloc((size_t)colour->width * (size_t)colour->height), colour->width, colour->height,
                          colour->width, IMAGE_GRAY8};
    assert_non_null(gray.data);
    for (int32_t y = 0; y < gray.height; y++)
        for (int32_t x = 0; x < gray.width; x++)
            image_row(&gray, y)[x] = image_row(colour, y)[4 * x];
    return gray;
}

static double psnr_at(const homography_t *fixed, const image_t *truth, const image_t *panel, int32_t factor)
{
    double_homography_t homography;
    double_homography_from_fixed(&homography, fixed);
    mesh_t mesh;
    char error[FILE_ERROR_LENGTH] = "";
    if (!mesh_sample(&mesh, &homography, truth, factor, error))
        fail_msg("%s", error);
    const double db = mesh_psnr_db(&mesh, panel);
    mesh_free(&mesh);
    return db;
}

typedef struct {
    int32_t width, height; /* panel */
    int32_t q;
    int32_t factor, original_factor; /* expected */
} case_t;

static void check_case(const case_t *c)
{
    /* a slanted map, so that every number of samples gives another PSNR */
    const double rows[9] = {0.8 * WIDTH / c->width, 0.03, 1.3, 0.02, 0.7 * HEIGHT / c->height, 1.1, 0.001, 0.002, 1};
    const homography_t homography = homography_of(rows, (homography_sizes_t){c->width, c->height, WIDTH, HEIGHT});
    image_t shown = noise(c->width, c->height, IMAGE_XRGB8888, 1);
    image_t picture = noise(WIDTH, HEIGHT, IMAGE_XRGB8888, 2);
    image_t original = noise(c->q * WIDTH, c->q * HEIGHT, IMAGE_GRAY8, 3);
    image_t panel = gray_of(&shown), truth = gray_of(&picture);
    const run_judge_t wall = {&homography, &shown, &picture, &original};
    run_psnr_t psnr = {.frame = 0};
    char error[FILE_ERROR_LENGTH] = "";
    if (!run_judge(&psnr, &wall, error))
        fail_msg("%s", error);
    const int32_t expected[2] = {c->factor, c->original_factor};
    const image_t *const truths[2] = {&truth, &original};
    for (int i = 0; i < 2; i++) {
        const double right = psnr_at(&homography, truths[i], &panel, expected[i]);
        const double got = psnr.db[i == 0 ? RUN_DB_PSNR : RUN_DB_ORIGINAL_PSNR];
        if (got < right || got > right)
            fail_msg("panel %d x %d, q %d, truth %d: %.9f dB, with %d samples %.9f dB", c->width, c->height, c->q, i,
                     got, expected[i], right);
    }
    free(shown.data);
    free(picture.data);
    free(original.data);
    free(panel.data);
    free(truth.data);
}

static void samples_grow_with_the_panel(void **state)
{
    (void)state;
    static const case_t cases[] = {
        {WIDTH / 2, HEIGHT / 2, 1, 4, 4},
        {WIDTH, HEIGHT, 1, 4, 4},
        {WIDTH, HEIGHT, 3, 4, 6},
        {WIDTH + 1, HEIGHT, 3, 8, 9},
        {WIDTH, HEIGHT + 1, 2, 8, 8},
        {2 * WIDTH, 2 * HEIGHT, 2, 8, 8},
        {3 * WIDTH - 1, 3 * HEIGHT - 1, 5, 8, 10},
        {3 * WIDTH, 2 * HEIGHT, 3, 16, 18},
        {WIDTH, 3 * HEIGHT, 2, 16, 16},
        {4 * WIDTH, 4 * HEIGHT, 1, 16, 16},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(&cases[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(samples_grow_with_the_panel)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
