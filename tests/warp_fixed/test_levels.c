// SPDX-License-Identifier: Apache-2.0
// Halved levels of a picture: means of blocks, mirrored beyond the edge, shared by workers; frames that need several.
#include "warp_fixed/levels.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "tests/support/homography_of.h"
#include "tests/support/rng.h"
#include "warp_fixed/fixed.h"
#include "warp_fixed/warp.h"

static levels_t levels;
static uint8_t pixels[150 * 100 * 4];

static void levels_are_means(void **state)
{
    (void)state;
    rng_t rng = {3};
    for (size_t i = 0; i < sizeof(pixels); i++)
        pixels[i] = (uint8_t)rng_next(&rng);
    const image_t picture = {pixels, 150, 100, 150 * 4, IMAGE_XRGB8888};
    assert_ptr_equal(levels_picture(&levels, &picture, (level_t){0, 0, 0}).data, pixels);
    for (int lx = 0; lx < LEVELS; lx++) {
        for (int ly = lx == 0 ? 1 : 0; ly < LEVELS; ly++) {
            const image_t level = levels_picture(&levels, &picture, (level_t){lx, ly, 0});
            levels_make(&levels, &picture, (level_t){lx, ly, 0}, only_worker);
            const int32_t step_x = 1 << 3 * lx, step_y = 1 << 3 * ly;
            assert_int_equal(level.width, (150 + step_x - 1) / step_x);
            assert_int_equal(level.height, (100 + step_y - 1) / step_y);
            for (int32_t y = 0; y < level.height; y++) {
                for (int32_t x = 0; x < level.width * 4; x++) {
                    int32_t sum = 0;
                    for (int32_t v = 0; v < step_y; v++)
                        for (int32_t u = 0; u < step_x; u++)
                            sum += pixels[(mirror_index(y * step_y + v, 100) * 150 +
                                           mirror_index(x / 4 * step_x + u, 150)) *
                                              4 +
                                          x % 4];
                    assert_int_equal(image_row(&level, y)[x], (sum + step_x * step_y / 2) / (step_x * step_y));
                }
            }
        }
    }
}

/* Each worker writes its rows and no others, and together they make the level. */
static void workers_share_the_rows(void **state)
{
    (void)state;
    const image_t picture = {pixels, 150, 100, 150 * 4, IMAGE_XRGB8888};
    const level_t level = {1, 1, 0};
    static uint8_t whole[19 * 13 * 4];
    levels_make(&levels, &picture, level, only_worker);
    const image_t made = levels_picture(&levels, &picture, level);
    memcpy(whole, made.data, sizeof whole);
    for (int32_t count = 2; count <= WORKERS_MAX; count++) {
        for (int32_t index = count - 1; index >= 0; index--) {
            const share_t rows = share_of((worker_t){index, count}, 13);
            memset(made.data, 0xa5, sizeof whole);
            levels_make(&levels, &picture, level, (worker_t){index, count});
            for (int32_t k = 0; k < (int32_t)sizeof whole; k++) {
                const bool own = k / (19 * 4) >= rows.begin && k / (19 * 4) < rows.end;
                assert_int_equal(made.data[k], own ? whole[k] : 0xa5);
            }
        }
    }
}

static void the_largest_picture_fits(void **state)
{
    (void)state;
    const image_t largest = {NULL, IMAGE_MAX_WIDTH, IMAGE_MAX_HEIGHT, 0, IMAGE_XRGB8888};
    const uint8_t *end = levels.pixels;
    for (int lx = 0; lx < LEVELS; lx++) {
        for (int ly = lx == 0 ? 1 : 0; ly < LEVELS; ly++) {
            const image_t level = levels_picture(&levels, &largest, (level_t){lx, ly, 0});
            assert_ptr_equal(level.data, end); /* each right behind the last: none overlaps another */
            end = level.data + (ptrdiff_t)level.stride * level.height;
        }
    }
}

/* A ramp, and a frame whose footprints are 70 to 280 texels wide and 8 to 128 high: some blocks share no level. */
static void blocks_read_levels_of_their_own(void **state)
{
    (void)state;
    enum { SIZE = 64, WIDTH = 3000, HEIGHT = 2000 };
    static warp_t warp;
    static uint8_t ramp[WIDTH * HEIGHT], shown[SIZE * SIZE];
    static const uint8_t black[3] = {0, 0, 0};
    static const double rows[9] = {70, 0, 0, 0, 8, 0, 0, -0.75 / SIZE, 1};
    const image_t picture = {ramp, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8}, panel = {shown, SIZE, SIZE, SIZE, IMAGE_GRAY8};
    const homography_t homography = homography_of(rows, (homography_sizes_t){SIZE, SIZE, WIDTH, HEIGHT});
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        ramp[k] = (uint8_t)(20 + k % WIDTH * 100 / WIDTH + k / WIDTH * 100 / HEIGHT);
    for (int m = 0; m < WARP_METHODS; m++) {
        if (!warp_averages(warp_methods[m].resampler))
            continue;
        warp_init(&warp, warp_methods[m], false, black);
        assert_true(warp_frame(&warp, &warp_kernels_scalar, NULL, &homography, &panel, &picture));
        for (int32_t n = 0; n < SIZE * SIZE; n++) {
            int32_t x, y;
            if (!grid_point(&warp.plane[0].grid, n % SIZE, n / SIZE, &x, &y))
                continue;
            const double px = fmin(fmax(ldexp(x, -18), 0), WIDTH), py = fmin(fmax(ldexp(y, -18), 0), HEIGHT);
            const double expected = 20 + px * 100 / WIDTH + py * 100 / HEIGHT;
            if (fabs(shown[n] - expected) > 5) /* half a footprint of 280 at the edge, and the ramp's steps */
                fail_msg("%s, pixel (%d, %d): %d, expected %f", warp_methods[m].name, n % SIZE, n / SIZE, shown[n],
                         expected);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_are_means),
        cmocka_unit_test(workers_share_the_rows),
        cmocka_unit_test(the_largest_picture_fits),
        cmocka_unit_test(blocks_read_levels_of_their_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
