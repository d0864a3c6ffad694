// SPDX-License-Identifier: Apache-2.0
// The code survives JPEG, as capture devices on USB send pictures.
#include "firmware/frame_tag.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#include "sim/files/png_file.h"
#include "sim/devices/sim_picture.h"
#include "tests/support/tagged.h"

/* How a picture is compressed. */
typedef struct {
    int quality;
    int columns, rows; /* of pixels that share a pair of chroma */
} jpeg_t;

/* XRGB8888 to a JPEG file in memory, for the caller to free. */
static unsigned char *compress(const image_t *image, const jpeg_t *as, unsigned long *bytes)
{
    struct jpeg_error_mgr errors;
    struct jpeg_compress_struct jpeg = {.err = jpeg_std_error(&errors)};
    unsigned char *file = NULL;
    *bytes = 0;
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &file, bytes);
    jpeg.image_width = (JDIMENSION)image->width;
    jpeg.image_height = (JDIMENSION)image->height;
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_EXT_BGRX;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, as->quality, TRUE);
    jpeg.comp_info[0].h_samp_factor = as->columns;
    jpeg.comp_info[0].v_samp_factor = as->rows;
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        JSAMPROW row = image_row(image, (int32_t)jpeg.next_scanline);
        (void)jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return file;
}

static void expand(const image_t *image, const unsigned char *file, unsigned long bytes)
{
    struct jpeg_error_mgr errors;
    struct jpeg_decompress_struct jpeg = {.err = jpeg_std_error(&errors)};
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, file, bytes);
    assert_int_equal(jpeg_read_header(&jpeg, TRUE), JPEG_HEADER_OK);
    jpeg.out_color_space = JCS_EXT_BGRX;
    (void)jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = image_row(image, (int32_t)jpeg.output_scanline);
        (void)jpeg_read_scanlines(&jpeg, &row, 1);
    }
    (void)jpeg_finish_decompress(&jpeg);
    jpeg_destroy_decompress(&jpeg);
}

static void assert_survives(const image_t *image, const char *name, const jpeg_t *as, rng_t *rng)
{
    const frame_tag_t painted = tagged_random(rng);
    tagged_paint(image, &painted);
    unsigned long length;
    unsigned char *file = compress(image, as, &length);
    image_t received = *image;
    received.data = malloc((size_t)image->stride * (size_t)image->height);
    uint8_t *captured = malloc((size_t)image->stride * (size_t)image->height);
    assert_non_null(received.data);
    assert_non_null(captured);
    expand(&received, file, length);
    for (picture_format_t format = PICTURE_XRGB8888; format < PICTURE_FORMATS; format++) {
        const picture_t picture = sim_picture(format, image->width, image->height, captured);
        frame_tag_t found = {0, 0, 0};
        tagged_convert(&picture, &received);
        const frame_tag_status_t status = frame_tag_decode(&found, &picture);
        if (status != FRAME_TAG_OK)
            fail_msg("%s, quality %d, chroma of %d x %d, format %d: status %d", name, as->quality, as->columns,
                     as->rows, (int)format, (int)status);
        tagged_assert(&found, &painted);
    }
    free(captured);
    free(received.data);
    free(file);
}

static const int qualities[] = {20, 50, 60, 75, 85, 95};
static const int chroma[][2] = {{2, 2}, {2, 1}, {1, 1}};

/* Each image with every kind of JPEG. */
static void assert_survives_all(const image_t *image, const char *name)
{
    rng_t rng = {1};
    for (size_t q = 0; q < sizeof qualities / sizeof qualities[0]; q++)
        for (size_t c = 0; c < sizeof chroma / sizeof chroma[0]; c++)
            assert_survives(image, name, &(jpeg_t){qualities[q], chroma[c][0], chroma[c][1]}, &rng);
}

static void photographs_keep_it(void **state)
{
    (void)state;
    static const char *const paths[] = {"tests/images/studio_1920x1080.png", "tests/images/studio_480x270.png",
                                        "tests/images/coffee_510x290.png", "tests/images/astronaut_510x290.png"};
    for (size_t p = 0; p < sizeof paths / sizeof paths[0]; p++) {
        image_t image;
        char error[FILE_ERROR_LENGTH] = "";
        if (!png_file_load(paths[p], IMAGE_XRGB8888, &image, error))
            fail_msg("%s", error);
        assert_survives_all(&image, paths[p]);
        free(image.data);
    }
}

/* The worst neighbour: full contrast at every pixel, in every channel. */
static void noise_keeps_it(void **state)
{
    (void)state;
    enum { WIDTH = 400, HEIGHT = 120 };
    static uint8_t pixels[WIDTH * HEIGHT * 4];
    rng_t rng = {2};
    for (int n = 0; n < WIDTH * HEIGHT * 4; n++)
        pixels[n] = (rng_next(&rng) & 1) != 0 ? 255 : 0;
    assert_survives_all(&(image_t){pixels, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888}, "noise");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photographs_keep_it),
        cmocka_unit_test(noise_keeps_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
