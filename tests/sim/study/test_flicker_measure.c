// SPDX-License-Identifier: Apache-2.0
// The measures of flicker and sharpness on pictures whose figures are known.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "sim/study/flicker_measure.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"

enum { WIDTH = 96, HEIGHT = 64, PIXELS = WIDTH * HEIGHT, SEED = 11 };

typedef struct {
    uint8_t ideal[PIXELS], seen[PIXELS], mask[PIXELS];
} pictures_t;

static image_t image_of(uint8_t *data)
{
    return (image_t){.data = data, .width = WIDTH, .height = HEIGHT, .stride = WIDTH, .format = IMAGE_GRAY8};
}

/* A random picture that stays clear of black and white. */
static void setup_pictures(pictures_t *pictures)
{
    rng_t rng = {SEED};
    for (int n = 0; n < PIXELS; n++)
        pictures->ideal[n] = (uint8_t)rng_int(&rng, 60, 190);
    memcpy(pictures->seen, pictures->ideal, PIXELS);
    memset(pictures->mask, 1, PIXELS);
}

static double sharpness_of(pictures_t *pictures)
{
    flicker_sums_t sums = {0};
    const image_t seen = image_of(pictures->seen), ideal = image_of(pictures->ideal);
    flicker_add_sharpness(&sums, &seen, &ideal, pictures->mask);
    return flicker_sharpness(&sums);
}

static double change_of(pictures_t *pictures)
{
    flicker_sums_t sums = {0};
    const image_t seen = image_of(pictures->seen), ideal = image_of(pictures->ideal);
    flicker_add_change(&sums, &ideal, &seen, pictures->mask);
    return flicker_level(&sums);
}

static void still_picture_does_not_flicker(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    assert_true(change_of(&pictures) == 0.0);
}

static void alternating_picture_flickers_by_its_step(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    for (int n = 0; n < PIXELS; n++)
        pictures.seen[n] = (uint8_t)(pictures.ideal[n] + (n % 2 == 0 ? 6 : -2));
    assert_true(change_of(&pictures) == 4.0);
    /* only the upper half counts, and of it only even pixels */
    for (int n = 0; n < PIXELS; n++)
        pictures.mask[n] = n < PIXELS / 2 && n % 2 == 0;
    assert_true(change_of(&pictures) == 6.0);
}

static void nothing_added_is_no_number(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    memset(pictures.mask, 0, PIXELS);
    assert_true(isnan(change_of(&pictures)));
    assert_true(isnan(sharpness_of(&pictures)));
}

static void ideal_picture_is_sharp(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    assert_true(sharpness_of(&pictures) == 1.0);
}

static void contrast_scales_sharpness(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    for (int n = 0; n < PIXELS; n++) {
        pictures.ideal[n] &= 0xFE;
        pictures.seen[n] = (uint8_t)(pictures.ideal[n] / 2 + 50);
    }
    assert_true(sharpness_of(&pictures) == 0.5);
}

static void blur_lowers_sharpness(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    for (int n = 0; n + 1 < PIXELS; n++)
        pictures.seen[n] = (uint8_t)((pictures.ideal[n] + pictures.ideal[n + 1]) / 2);
    /* white noise: the mean with a neighbour keeps 1/2 of the gradient down, and 1/4 of that across, of each a half */
    assert_true(fabs(sharpness_of(&pictures) - 0.375) < 0.03);
}

static void noise_is_not_sharp(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    rng_t rng = {SEED + 1};
    for (int n = 0; n < PIXELS; n++)
        pictures.seen[n] = (uint8_t)(pictures.ideal[n] + rng_int(&rng, -40, 40));
    assert_true(fabs(sharpness_of(&pictures) - 1.0) < 0.03);
}

/* Every second column shown twice: as much gradient as ever, but a part of it in the wrong place. */
static void aliases_are_not_sharp(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    for (int n = 0; n < PIXELS; n += 2)
        pictures.seen[n + 1] = pictures.ideal[n];
    assert_true(sharpness_of(&pictures) < 0.7);
}

static void gradients_need_both_neighbours(void **state)
{
    (void)state;
    pictures_t pictures;
    setup_pictures(&pictures);
    for (int y = 0; y < HEIGHT; y++) /* columns spoilt and left out */
        for (int x = 40; x < 50; x++) {
            pictures.seen[y * WIDTH + x] = 0;
            pictures.mask[y * WIDTH + x] = 0;
        }
    assert_true(sharpness_of(&pictures) == 1.0);
}

static void mask_is_what_the_wall_covers(void **state)
{
    (void)state;
    enum { SIZE = 20 };
    /* a wall from (5, 4) to (15, 12) in a picture of 20 x 20 */
    const homography_t fixed =
        homography_of((const double[9]){1, 0, 5, 0, 1, 4, 0, 0, 1}, (homography_sizes_t){10, 8, SIZE, SIZE});
    double_homography_t homography;
    double_homography_from_fixed(&homography, &fixed);
    uint8_t mask[SIZE * SIZE];
    memset(mask, 1, sizeof mask);
    mask[8 * SIZE + 9] = 0; /* stays out */
    flicker_mask(mask, &homography, 1.5);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const int expected = x >= 7 && x <= 12 && y >= 6 && y <= 9 && !(x == 9 && y == 8);
            if (mask[y * SIZE + x] != expected)
                fail_msg("pixel %d, %d: mask %d, expected %d", x, y, mask[y * SIZE + x], expected);
        }
}

/* A wall that stands on its corner: a square's four corners decide, one at a time. */
static void mask_needs_all_corners(void **state)
{
    (void)state;
    enum { SIZE = 20 };
    const homography_t fixed =
        homography_of((const double[9]){1, -1, 10, 1, 1, 2.3, 0, 0, 1}, (homography_sizes_t){8, 8, SIZE, SIZE});
    double_homography_t homography;
    double_homography_from_fixed(&homography, &fixed);
    uint8_t mask[SIZE * SIZE];
    memset(mask, 1, sizeof mask);
    flicker_mask(mask, &homography, 0.0);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            /* |x - 10| + |y - 10.3| <= 8 */
            const double across = fmax(fabs(x - 10.0), fabs(x + 1 - 10.0));
            const double down = fmax(fabs(y - 10.3), fabs(y + 1 - 10.3));
            if (mask[y * SIZE + x] != (across + down <= 8.0))
                fail_msg("pixel %d, %d: mask %d", x, y, mask[y * SIZE + x]);
        }
}

static void mask_leaves_out_the_edge_of_the_picture(void **state)
{
    (void)state;
    enum { SIZE = 8 };
    const homography_t fixed =
        homography_of((const double[9]){1, 0, -50, 0, 1, -50, 0, 0, 1}, (homography_sizes_t){100, 100, SIZE, SIZE});
    double_homography_t homography;
    double_homography_from_fixed(&homography, &fixed);
    uint8_t mask[SIZE * SIZE];
    memset(mask, 1, sizeof mask);
    flicker_mask(mask, &homography, 1.0);
    for (int n = 0; n < SIZE * SIZE; n++) {
        const int x = n % SIZE, y = n / SIZE;
        assert_int_equal(mask[n], x > 0 && x < SIZE - 1 && y > 0 && y < SIZE - 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(still_picture_does_not_flicker),
        cmocka_unit_test(alternating_picture_flickers_by_its_step),
        cmocka_unit_test(nothing_added_is_no_number),
        cmocka_unit_test(ideal_picture_is_sharp),
        cmocka_unit_test(contrast_scales_sharpness),
        cmocka_unit_test(blur_lowers_sharpness),
        cmocka_unit_test(noise_is_not_sharp),
        cmocka_unit_test(aliases_are_not_sharp),
        cmocka_unit_test(gradients_need_both_neighbours),
        cmocka_unit_test(mask_is_what_the_wall_covers),
        cmocka_unit_test(mask_needs_all_corners),
        cmocka_unit_test(mask_leaves_out_the_edge_of_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
