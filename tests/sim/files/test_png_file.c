// SPDX-License-Identifier: Apache-2.0
// PNG files: every kind is read right, and what is written comes back.
#include "sim/files/png_file.h"

#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/png_canvas.h"
#include "tests/support/scratch.h"

enum { PIXELS = WIDTH * HEIGHT };

static void test_written_pictures_come_back(void **state)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    scratch_path(*state, "a.png", path);
    static const image_format_t formats[] = {IMAGE_GRAY8, IMAGE_XRGB8888};
    for (int i = 0; i < 2; i++) {
        canvas_t written, read;
        uint32_t random = 1;
        blank_canvas(&written, formats[i]);
        blank_canvas(&read, formats[i]);
        for (size_t k = 0; k < sizeof written.bytes; k++)
            written.bytes[k] = (uint8_t)next_random(&random);
        assert_true(png_file_write(path, &written.image, error));
        int32_t width = 0, height = 0;
        assert_true(png_file_size(path, &width, &height, error));
        assert_int_equal(width, WIDTH);
        assert_int_equal(height, HEIGHT);
        assert_true(png_file_read(path, &read.image, error));
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < STRIDE; x++) {
                const bool outside = x >= WIDTH * (int)formats[i];
                const bool is_x = formats[i] == IMAGE_XRGB8888 && x % 4 == 3;
                const int expected = outside ? UNTOUCHED : is_x ? 0 : written.bytes[y * STRIDE + x];
                assert_int_equal(read.bytes[y * STRIDE + x], expected);
            }
        }
    }
}

/* A PNG to be written with libpng itself. Samples are 16 bits each here, row by row, cut to depth when written. */
typedef struct {
    int colour_type, depth, interlace;
    bool transparent_key; /**< the colour of the first pixel is transparent; a palette gets alphas */
} kind_t;

static int channels_of(const kind_t *kind)
{
    static const int channels[] = {1, 0, 3, 1, 2, 0, 4};
    return channels[kind->colour_type];
}

static void write_kind(const char *path, const kind_t *kind, const uint16_t *samples)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, WIDTH, HEIGHT, kind->depth, kind->colour_type, kind->interlace, 0, 0);
    png_color palette[256];
    png_byte alphas[256];
    for (int i = 0; i < 256; i++) {
        palette[i] = (png_color){(png_byte)(i * 7), (png_byte)(i * 11), (png_byte)(255 - i)};
        alphas[i] = (png_byte)(i * 37);
    }
    if (kind->colour_type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 1 << kind->depth);
    png_color_16 key = {.red = samples[0], .green = samples[1], .blue = samples[2], .gray = samples[0]};
    if (kind->transparent_key)
        png_set_tRNS(png, info, alphas, 1 << (kind->depth > 8 ? 8 : kind->depth), &key);
    png_set_gAMA(png, info, 1.0);
    png_write_info(png, info);
    const int per_row = WIDTH * channels_of(kind);
    for (int pass = png_set_interlace_handling(png); pass > 0; pass--) {
        for (int y = 0; y < HEIGHT; y++) {
            uint8_t row[WIDTH * 8] = {0};
            for (int i = 0; i < per_row; i++) {
                const unsigned sample = samples[y * per_row + i];
                if (kind->depth == 16) {
                    row[2 * i] = (uint8_t)(sample >> 8);
                    row[2 * i + 1] = (uint8_t)sample;
                } else {
                    const int bit = i * kind->depth;
                    row[bit / 8] = (uint8_t)(row[bit / 8] | sample << (8 - kind->depth - bit % 8));
                }
            }
            png_write_row(png, row);
        }
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

static int eight_bits(const kind_t *kind, unsigned sample)
{
    const unsigned top = (1u << kind->depth) - 1;
    return (int)((2 * sample * 255 + top) / (2 * top));
}

/* What pixel p must become: R, G, B on black. */
static void expected_pixel(const kind_t *kind, const uint16_t *samples, int p, int rgb[3])
{
    const int channels = channels_of(kind);
    const uint16_t *pixel = samples + p * channels;
    int alpha = 255;
    for (int c = 0; c < 3; c++)
        rgb[c] = eight_bits(kind, pixel[channels >= 3 ? c : 0]);
    if (kind->colour_type == PNG_COLOR_TYPE_PALETTE) {
        rgb[0] = pixel[0] * 7 & 255;
        rgb[1] = pixel[0] * 11 & 255;
        rgb[2] = 255 - pixel[0];
        alpha = kind->transparent_key ? pixel[0] * 37 & 255 : 255;
    } else if (kind->transparent_key) {
        alpha = memcmp(pixel, samples, (size_t)channels * sizeof *pixel) == 0 ? 0 : 255;
    } else if (channels == 2 || channels == 4) {
        alpha = eight_bits(kind, pixel[channels - 1]);
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = (rgb[c] * alpha + 127) / 255;
}

static void check_kind(const char *path, const kind_t *kind)
{
    print_message("colour type %d, %d bits, interlace %d, key %d\n", kind->colour_type, kind->depth, kind->interlace,
                  kind->transparent_key);
    uint16_t samples[PIXELS * 4];
    uint32_t random = 7;
    for (int i = 0; i < PIXELS * 4; i++)
        samples[i] = (uint16_t)(next_random(&random) & ((1u << kind->depth) - 1));
    write_kind(path, kind, samples);
    char error[FILE_ERROR_LENGTH] = "";
    image_t gray, colour;
    assert_true(png_file_load(path, IMAGE_GRAY8, &gray, error));
    assert_true(png_file_load(path, IMAGE_XRGB8888, &colour, error));
    assert_int_equal(gray.stride, WIDTH);
    assert_int_equal(colour.stride, WIDTH * 4);
    for (int p = 0; p < PIXELS; p++) {
        int rgb[3];
        expected_pixel(kind, samples, p, rgb);
        assert_int_equal(colour.data[4 * p + 2], rgb[0]);
        assert_int_equal(colour.data[4 * p + 1], rgb[1]);
        assert_int_equal(colour.data[4 * p], rgb[2]);
        assert_int_equal(colour.data[4 * p + 3], 0);
        assert_int_equal(gray.data[p], (19595 * rgb[0] + 38470 * rgb[1] + 7471 * rgb[2] + 32768) / 65536);
    }
    free(gray.data);
    free(colour.data);
}

static void test_every_kind_is_read(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "kind.png", path);
    static const int kinds[][2] = {{0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 16}, {2, 8}, {2, 16}, {3, 1},
                                   {3, 2}, {3, 4}, {3, 8}, {4, 8}, {4, 16}, {6, 8}, {6, 16}};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const bool may_have_key = kinds[i][0] < 4;
        for (int variant = 0; variant < (may_have_key ? 4 : 2); variant++)
            check_kind(path, &(kind_t){kinds[i][0], kinds[i][1], variant & 1, variant >= 2});
    }
}

static void test_test_picture_is_read(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH];
    image_t image;
    assert_true(png_file_load("tests/images/studio_1920x1080.png", IMAGE_XRGB8888, &image, error));
    assert_int_equal(image.width, 1920);
    assert_int_equal(image.height, 1080);
    free(image.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_written_pictures_come_back),
        cmocka_unit_test(test_every_kind_is_read),
        cmocka_unit_test(test_test_picture_is_read),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
