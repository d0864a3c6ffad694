// SPDX-License-Identifier: Apache-2.0
// The study's pictures: sizes, means, and the files that they are made of.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "sim/files/png_file.h"
#include "sim/study/study_image.h"

static void equals_file(study_image_t image, const char *path)
{
    char error[FILE_ERROR_LENGTH];
    image_t file, picture;
    assert_true(png_file_load(path, IMAGE_GRAY8, &file, error));
    assert_true(study_image(image, file.width, file.height, 1, &picture, NULL));
    assert_memory_equal(picture.data, file.data, (size_t)file.width * (size_t)file.height);
    free(picture.data);
    free(file.data);
}

static void photographs_are_the_files(void **state)
{
    (void)state;
    equals_file(STUDY_STUDIO, "tests/images/studio_1920x1080.png");
    equals_file(STUDY_STUDIO, "tests/images/studio_480x270.png");
    equals_file(STUDY_ASTRONAUT, "tests/images/astronaut_510x290.png");
    equals_file(STUDY_COFFEE, "tests/images/coffee_510x290.png");
}

/* Every pixel of the picture is the mean of its part of the original, rounded half up. */
static void pictures_are_means_of_their_originals(void **state)
{
    (void)state;
    static const struct {
        study_image_t image;
        int32_t width, height, factor;
    } cases[] = {{STUDY_STUDIO, 480, 270, 4},   {STUDY_STUDIO, 960, 540, 2},      {STUDY_STUDIO, 510, 290, 3},
                 {STUDY_ASTRONAUT, 170, 96, 3}, {STUDY_COFFEE, 255, 145, 2},      {STUDY_NOISE, 33, 17, 5},
                 {STUDY_NOISE, 1, 1, 1},        {STUDY_CHECKERBOARD, 100, 50, 3}, {STUDY_STUDIO, 1920, 1080, 1}};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        const int32_t factor = cases[n].factor;
        image_t picture, original;
        assert_true(study_image(cases[n].image, cases[n].width, cases[n].height, factor, &picture, &original));
        assert_int_equal(picture.width, cases[n].width);
        assert_int_equal(picture.height, cases[n].height);
        assert_int_equal(original.width, cases[n].width * factor);
        assert_int_equal(original.height, cases[n].height * factor);
        for (int32_t y = 0; y < picture.height; y++)
            for (int32_t x = 0; x < picture.width; x++) {
                int32_t sum = 0;
                for (int32_t s = 0; s < factor * factor; s++)
                    sum += image_row(&original, y * factor + s / factor)[x * factor + s % factor];
                assert_int_equal(image_row(&picture, y)[x], (2 * sum + factor * factor) / (2 * factor * factor));
            }
        free(picture.data);
        free(original.data);
    }
}

static void photographs_are_cut_to_the_middle(void **state)
{
    (void)state;
    image_t whole, middle;
    assert_true(study_image(STUDY_COFFEE, 510, 290, 1, &whole, NULL));
    assert_true(study_image(STUDY_COFFEE, 480, 270, 1, &middle, NULL));
    for (int32_t y = 0; y < 270; y++)
        assert_memory_equal(image_row(&middle, y), image_row(&whole, y + 10) + 15, 480);
    free(whole.data);
    free(middle.data);
}

static void made_pictures(void **state)
{
    (void)state;
    image_t first, second;
    assert_true(study_image(STUDY_CHECKERBOARD, 64, 32, 1, &first, NULL));
    assert_true(study_image(STUDY_CHECKERBOARD, 64, 32, 2, &second, NULL));
    assert_memory_equal(first.data, second.data, 64 * 32);
    assert_int_equal(image_row(&first, 0)[7], 0);
    assert_int_equal(image_row(&first, 0)[8], 255);
    assert_int_equal(image_row(&first, 8)[8], 0);
    free(first.data);
    free(second.data);
    assert_true(study_image(STUDY_NOISE, 64, 32, 1, &first, NULL));
    assert_true(study_image(STUDY_NOISE, 64, 32, 1, &second, NULL));
    assert_memory_equal(first.data, second.data, 64 * 32);
    int64_t sum = 0;
    for (int n = 0; n < 64 * 32; n++)
        sum += first.data[n];
    assert_in_range(sum / (64 * 32), 118, 137);
    free(first.data);
    free(second.data);
}

static void too_large_is_refused(void **state)
{
    (void)state;
    image_t picture = {.width = 7}, original = {.width = 7};
    assert_false(study_image(STUDY_STUDIO, 1921, 1080, 1, &picture, &original));
    assert_false(study_image(STUDY_ASTRONAUT, 480, 270, 2, &picture, &original));
    assert_false(study_image(STUDY_NOISE, 4096, 2160, 2, &picture, &original));
    assert_int_equal(picture.width, 7);
    assert_int_equal(original.width, 7);
}

static void names(void **state)
{
    (void)state;
    assert_string_equal(study_image_name(STUDY_STUDIO), "studio");
    assert_string_equal(study_image_name(STUDY_NOISE), "noise");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photographs_are_the_files),
        cmocka_unit_test(pictures_are_means_of_their_originals),
        cmocka_unit_test(photographs_are_cut_to_the_middle),
        cmocka_unit_test(made_pictures),
        cmocka_unit_test(too_large_is_refused),
        cmocka_unit_test(names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
