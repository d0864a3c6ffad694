// SPDX-License-Identifier: Apache-2.0
// The built-in test picture: the same every time, means of its original, edges at every scale.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/leaves_picture.h"

typedef struct {
    image_t picture, original;
} leaves_t;

static leaves_t leaves_of(int32_t width, int32_t height, int32_t finer)
{
    leaves_t leaves;
    assert_true(leaves_picture(width, height, finer, &leaves.picture, &leaves.original));
    return leaves;
}

static void free_leaves(leaves_t *leaves)
{
    free(leaves->picture.data);
    free(leaves->original.data);
}

static void picture_is_the_means_of_its_original(void **state)
{
    (void)state;
    static const int32_t sizes[][3] = {{1, 1, 1}, {1, 1, 4}, {37, 21, 3}, {3, 200, 2}, {64, 36, 16}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int32_t finer = sizes[s][2], area = finer * finer;
        leaves_t leaves = leaves_of(sizes[s][0], sizes[s][1], finer),
                 again = leaves_of(sizes[s][0], sizes[s][1], finer);
        assert_int_equal(leaves.picture.width, sizes[s][0]);
        assert_int_equal(leaves.picture.height, sizes[s][1]);
        assert_int_equal(leaves.original.width, sizes[s][0] * finer);
        assert_int_equal(leaves.original.height, sizes[s][1] * finer);
        assert_memory_equal(leaves.original.data, again.original.data,
                            (size_t)(leaves.original.width * leaves.original.height));
        for (int32_t y = 0; y < sizes[s][1]; y++)
            for (int32_t x = 0; x < sizes[s][0]; x++) {
                int32_t sum = 0;
                for (int32_t j = 0; j < finer; j++)
                    for (int32_t i = 0; i < finer; i++)
                        sum += image_row(&leaves.original, y * finer + j)[x * finer + i];
                assert_int_equal(image_row(&leaves.picture, y)[x], (int32_t)floor((double)sum / area + 0.5));
            }
        free_leaves(&leaves);
        free_leaves(&again);
    }
}

/* Mean square difference of pixels so far apart. */
static double difference(const image_t *image, int32_t apart)
{
    double sum = 0.0;
    for (int32_t y = 0; y < image->height; y++)
        for (int32_t x = apart; x < image->width; x++) {
            const double d = image_row(image, y)[x] - image_row(image, y)[x - apart];
            sum += d * d;
        }
    return sum / ((double)image->height * (image->width - apart));
}

/* An amplitude spectrum of 1 / f^(1 + a / 2) has differences that grow as distance^a; white noise has a = 0, a smooth
 * picture a = 2. tests/images lie between 0.3 and 1.5. */
static void edges_at_every_scale(void **state)
{
    (void)state;
    leaves_t leaves = leaves_of(480, 270, 4);
    for (int32_t apart = 1; apart <= 32; apart *= 2) {
        const double growth = log2(difference(&leaves.picture, 2 * apart) / difference(&leaves.picture, apart));
        if (!(growth > 0.1 && growth < 1.3))
            fail_msg("differences %d px apart grow as distance^%.2f", apart, growth);
    }
    uint8_t least = 255, most = 0;
    for (int32_t p = 0; p < 480 * 270; p++) {
        least = leaves.picture.data[p] < least ? leaves.picture.data[p] : least;
        most = leaves.picture.data[p] > most ? leaves.picture.data[p] : most;
    }
    assert_true(least < 32 && most > 220);
    free_leaves(&leaves);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picture_is_the_means_of_its_original),
        cmocka_unit_test(edges_at_every_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
