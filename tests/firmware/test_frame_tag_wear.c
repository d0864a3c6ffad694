// SPDX-License-Identifier: Apache-2.0
// The code in worn pictures is read; pictures without it are not taken for one with it.
#include "firmware/frame_tag.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/devices/test_pattern.h"
#include "sim/files/png_file.h"
#include "sim/devices/sim_picture.h"
#include "tests/support/tagged.h"
#include "warp_fixed/fixed.h"

enum { WIDTH = 480, HEIGHT = 270 };

static const frame_tag_t UNTOUCHED = {1, 2, 3};

static uint8_t pixels[WIDTH * HEIGHT], captured[WIDTH * HEIGHT];

/* What happens to a picture between the engine and the board. */
typedef struct {
    const char *name;
    bool limited;
    double gain, gamma, noise;
    int blur, shift_x, shift_y; /* pixels */
} wear_t;

static double source_at(const uint8_t *from, int x, int y, const wear_t *wear)
{
    double sum = 0;
    for (int dy = -wear->blur; dy <= wear->blur; dy++)
        for (int dx = -wear->blur; dx <= wear->blur; dx++)
            sum += from[clamp_i32(y - wear->shift_y + dy, 0, HEIGHT - 1) * WIDTH +
                        clamp_i32(x - wear->shift_x + dx, 0, WIDTH - 1)];
    return sum / ((2 * wear->blur + 1) * (2 * wear->blur + 1));
}

static void wear_out(uint8_t *to, const uint8_t *from, const wear_t *wear, rng_t *rng)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double level = 255 * pow(source_at(from, x, y, wear) / 255, wear->gamma) * wear->gain;
            level = wear->limited ? 16 + level * 219 / 255 : level;
            level += wear->noise > 0 ? wear->noise * rng_normal(rng) : 0;
            to[y * WIDTH + x] = (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : level);
        }
}

static void worn_pictures_are_read(void **state)
{
    (void)state;
    static const wear_t wears[] = {
        {"nothing", false, 1, 1, 0, 0, 0, 0},
        {"limited range", true, 1, 1, 0, 0, 0, 0},
        {"gamma down", false, 1, 0.8, 0, 0, 0, 0},
        {"gamma up", false, 1, 1.25, 0, 0, 0, 0},
        {"gamma of linear light", false, 1, 2.2, 0, 0, 0, 0},
        {"a third of the contrast", false, 0.33, 1, 0, 0, 0, 0},
        {"noise", false, 1, 1, 40, 0, 0, 0},
        {"blur", false, 1, 1, 0, 1, 0, 0},
        {"right", false, 1, 1, 0, 0, 1, 0},
        {"left and down", false, 1, 1, 0, 0, -1, 1},
        {"further right than promised", false, 1, 1, 0, 0, 2, 0},
        {"further left and down", false, 1, 1, 0, 0, -2, 2},
        {"up", false, 1, 1, 0, 0, 0, -1},
        {"all of it", true, 0.9, 1.2, 10, 1, 1, 1},
        {"all of it, the other way", true, 0.9, 0.8, 10, 1, -1, -1},
    };
    enum { ROUNDS = 10 };
    const picture_t picture = sim_picture(PICTURE_GRAY8, WIDTH, HEIGHT, captured);
    for (size_t w = 0; w < sizeof wears / sizeof wears[0]; w++)
        for (uint64_t seed = 0; seed < ROUNDS; seed++) {
            rng_t rng = {seed};
            const frame_tag_t painted = tagged_random(&rng);
            frame_tag_t found = UNTOUCHED;
            for (int n = 0; n < WIDTH * HEIGHT; n++)
                pixels[n] = (uint8_t)(rng_next(&rng) & 0xFF);
            tagged_paint(&(image_t){pixels, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8}, &painted);
            wear_out(captured, pixels, &wears[w], &rng);
            const frame_tag_status_t status = frame_tag_decode(&found, &picture);
            if (status != FRAME_TAG_OK)
                fail_msg("%s, seed %d: status %d", wears[w].name, (int)seed, (int)status);
            tagged_assert(&found, &painted);
        }
}

static void assert_none(const picture_t *picture, const char *what)
{
    frame_tag_t found = UNTOUCHED;
    const frame_tag_status_t status = frame_tag_decode(&found, picture);
    if (status != FRAME_TAG_NONE)
        fail_msg("%s: status %d", what, (int)status);
    tagged_assert(&found, &UNTOUCHED);
}

static void pictures_without_it_are_not_taken_for_it(void **state)
{
    (void)state;
    const picture_t gray = sim_picture(PICTURE_GRAY8, WIDTH, HEIGHT, pixels);
    for (int level = 0; level < 256; level++) {
        memset(pixels, level, WIDTH * HEIGHT);
        assert_none(&gray, "one level");
    }
    for (int64_t index = 0; index < TEST_PATTERN_STEPS; index++) {
        test_pattern_draw(&(image_t){pixels, WIDTH, HEIGHT, WIDTH, IMAGE_GRAY8}, index);
        assert_none(&gray, "the test pattern");
    }
    static const char *const paths[] = {"tests/images/studio_1920x1080.png", "tests/images/studio_480x270.png",
                                        "tests/images/coffee_510x290.png", "tests/images/astronaut_510x290.png"};
    for (size_t p = 0; p < sizeof paths / sizeof paths[0]; p++) {
        image_t image;
        char error[FILE_ERROR_LENGTH] = "";
        if (!png_file_load(paths[p], IMAGE_XRGB8888, &image, error))
            fail_msg("%s", error);
        for (int32_t top = 0; top < image.height / 2; top++) { /* as if the picture began at this row */
            const picture_t whole = picture_from_image(&image);
            const picture_t picture = frame_tag_picture_below(&whole, top);
            assert_none(&picture, paths[p]);
        }
        free(image.data);
    }
}

/* Noise of blocks meets the first 16 once in 65536 times, and never the CRC. */
static void noise_is_not_taken_for_it(void **state)
{
    (void)state;
    enum { ROUNDS = 100000 };
    rng_t rng = {3};
    int damaged = 0;
    for (int round = 0; round < ROUNDS; round++) {
        uint8_t bits[TAGGED_BYTES];
        for (int i = 0; i < TAGGED_BYTES; i++)
            bits[i] = (uint8_t)(rng_next(&rng) >> 56);
        if (round % 2 != 0)
            memcpy(bits, (const uint8_t[]){0xF3, 0x50}, 2);
        const picture_t picture = tagged_draw_bits(pixels, bits);
        frame_tag_t found = UNTOUCHED;
        const frame_tag_status_t status = frame_tag_decode(&found, &picture);
        if (status == FRAME_TAG_OK || status == FRAME_TAG_FOREIGN)
            fail_msg("round %d: status %d", round, (int)status);
        damaged += status == FRAME_TAG_DAMAGED;
        tagged_assert(&found, &UNTOUCHED);
    }
    assert_in_range(damaged, ROUNDS / 2, ROUNDS / 2 + 10);
}

static void contrast_must_be_enough(void **state)
{
    (void)state;
    const picture_t picture = sim_picture(PICTURE_GRAY8, TAGGED_WIDTH, TAGGED_HEIGHT, pixels);
    for (int contrast = 0; contrast < 60; contrast++) {
        frame_tag_t found = UNTOUCHED;
        memset(pixels, 128, TAGGED_WIDTH * TAGGED_HEIGHT);
        tagged_paint(&(image_t){pixels, TAGGED_WIDTH, TAGGED_HEIGHT, TAGGED_WIDTH, IMAGE_GRAY8}, &UNTOUCHED);
        for (int n = 0; n < TAGGED_WIDTH * TAGGED_HEIGHT; n++)
            pixels[n] = pixels[n] == 224 ? (uint8_t)(70 + contrast) : pixels[n] == 32 ? 70 : pixels[n];
        assert_int_equal(frame_tag_decode(&found, &picture),
                         contrast < FRAME_TAG_MIN_CONTRAST ? FRAME_TAG_NONE : FRAME_TAG_OK);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(worn_pictures_are_read),
        cmocka_unit_test(pictures_without_it_are_not_taken_for_it),
        cmocka_unit_test(noise_is_not_taken_for_it),
        cmocka_unit_test(contrast_must_be_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
