// SPDX-License-Identifier: Apache-2.0
// PNG files: broken ones are refused whole, with the reason; writing is all or nothing.
#include "sim/files/png_file.h"

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>
#include <zlib.h>

#include "tests/support/png_canvas.h"
#include "tests/support/scratch.h"

static void assert_untouched(const canvas_t *canvas)
{
    for (size_t i = 0; i < sizeof canvas->bytes; i++)
        assert_int_equal(canvas->bytes[i], UNTOUCHED);
}

/* A small PNG with random pixels, as bytes. */
static uint8_t *good_png(const char *path, canvas_t *canvas, size_t *length)
{
    char error[FILE_ERROR_LENGTH];
    uint32_t random = 3;
    blank_canvas(canvas, IMAGE_XRGB8888);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH * 4; x++)
            canvas->bytes[y * STRIDE + x] = x % 4 == 3 ? 0 : (uint8_t)next_random(&random);
    assert_true(png_file_write(path, &canvas->image, error));
    return scratch_read(path, length);
}

static void assert_refused(const char *path, const char *wanted)
{
    char error[FILE_ERROR_LENGTH] = "";
    canvas_t canvas;
    image_t image = {.width = -1};
    blank_canvas(&canvas, IMAGE_XRGB8888);
    assert_false(png_file_read(path, &canvas.image, error));
    assert_untouched(&canvas);
    assert_non_null(strstr(error, strrchr(path, '/') + 1));
    if (strstr(error, wanted) == NULL)
        fail_msg("'%s' does not say '%s'", error, wanted);
    assert_false(png_file_load(path, IMAGE_GRAY8, &image, error));
    assert_int_equal(image.width, -1);
}

static void test_every_truncation_is_refused(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "cut.png", path);
    canvas_t canvas;
    size_t length;
    uint8_t *bytes = good_png(path, &canvas, &length);
    for (size_t kept = 0; kept < length; kept++) {
        scratch_write(path, bytes, kept);
        assert_refused(path, kept < 8 ? "not a PNG file" : "the file ends too early");
    }
    free(bytes);
    bytes = scratch_read("tests/images/astronaut_510x290.png", &length);
    for (size_t kept = 9; kept < length; kept += length / 40) {
        char error[FILE_ERROR_LENGTH];
        image_t image;
        scratch_write(path, bytes, kept);
        assert_false(png_file_load(path, IMAGE_GRAY8, &image, error));
    }
    free(bytes);
}

/* Every chunk is protected by its CRC: what is accepted all the same must be the very same picture. */
static void test_flipped_bytes_are_refused_or_harmless(void **state)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    scratch_path(*state, "flipped.png", path);
    canvas_t canvas, read;
    size_t length;
    uint8_t *bytes = good_png(path, &canvas, &length);
    int refused = 0;
    for (uint32_t seed = 1; seed <= 2000; seed++) {
        uint32_t random = seed;
        uint8_t *spoilt = malloc(length);
        memcpy(spoilt, bytes, length);
        for (uint32_t flips = 1 + next_random(&random) % 3; flips > 0; flips--) {
            const size_t at = next_random(&random) % length;
            spoilt[at] = (uint8_t)(spoilt[at] ^ (1u + next_random(&random) % 255));
        }
        scratch_write(path, spoilt, length);
        free(spoilt);
        blank_canvas(&read, IMAGE_XRGB8888);
        error[0] = '\0';
        if (png_file_read(path, &read.image, error)) {
            if (memcmp(read.bytes, canvas.bytes, sizeof canvas.bytes) != 0)
                fail_msg("seed %u: another picture was accepted", seed);
            continue;
        }
        refused++;
        if (error[0] == '\0')
            fail_msg("seed %u: refused without a reason", seed);
        assert_untouched(&read);
    }
    free(bytes);
    assert_true(refused > 1900);
}

/* A header and an empty IDAT chunk: as much as is read before the size is judged. */
static void write_header(const char *path, uint32_t width, uint32_t height)
{
    static const uint8_t empty_idat[12] = {0, 0, 0, 0, 'I', 'D', 'A', 'T', 0x35, 0xAF, 0x06, 0x1E};
    uint8_t bytes[33 + sizeof empty_idat] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
    for (int i = 0; i < 4; i++) {
        bytes[16 + i] = (uint8_t)(width >> (24 - 8 * i));
        bytes[20 + i] = (uint8_t)(height >> (24 - 8 * i));
    }
    bytes[24] = 8;
    bytes[25] = 6;
    const uint32_t crc = (uint32_t)crc32(0, bytes + 12, 17);
    for (int i = 0; i < 4; i++)
        bytes[29 + i] = (uint8_t)(crc >> (24 - 8 * i));
    memcpy(bytes + 33, empty_idat, sizeof empty_idat);
    scratch_write(path, bytes, sizeof bytes);
}

static void test_bad_files_say_what_is_wrong(void **state)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    scratch_path(*state, "bad.png", path);
    assert_refused(path, "No such file");
    scratch_write(path, "", 0);
    assert_refused(path, "not a PNG file, expected one");
    scratch_write(path, "hello, this is text", 19);
    assert_refused(path, "not a PNG file, expected one");
    assert_refused(((const scratch_t *)*state)->folder, "not a regular file");
    int32_t width = -1, height = -1;
    static const uint32_t huge[][2] = {{4097, 1}, {1, 2161}, {0x7fffffff, 0x7fffffff}, {1000001, 7}};
    for (int i = 0; i < 4; i++) {
        write_header(path, huge[i][0], huge[i][1]);
        assert_false(png_file_size(path, &width, &height, error));
        assert_refused(path, "4096x2160");
    }
    static const uint32_t nonsense[][2] = {{0, 5}, {5, 0}, {0x80000000, 5}};
    for (int i = 0; i < 3; i++) {
        write_header(path, nonsense[i][0], nonsense[i][1]);
        assert_false(png_file_size(path, &width, &height, error));
        assert_refused(path, "broken PNG");
    }
    assert_int_equal(width, -1);
    assert_int_equal(height, -1);

    canvas_t canvas;
    blank_canvas(&canvas, IMAGE_GRAY8);
    assert_false(png_file_read("tests/images/studio_480x270.png", &canvas.image, error));
    assert_string_equal(error, "tests/images/studio_480x270.png: picture 480x270, expected 13x7");
    assert_untouched(&canvas);
}

static void test_a_long_path_leaves_room_for_the_reason(void **state)
{
    (void)state;
    char path[1000], error[FILE_ERROR_LENGTH];
    memset(path, 'a', sizeof path);
    memcpy(path + sizeof path - 9, "/end.png", 9);
    int32_t width, height;
    assert_false(png_file_size(path, &width, &height, error));
    assert_non_null(strstr(error, "/end.png: cannot read: File name too long"));
}

static void assert_write_fails(const char *path, const image_t *image, const char *wanted)
{
    char error[FILE_ERROR_LENGTH] = "", part[SCRATCH_PATH_LENGTH + 8];
    assert_false(png_file_write(path, image, error));
    if (strstr(error, wanted) == NULL || strstr(error, path) == NULL)
        fail_msg("'%s' does not say '%s'", error, wanted);
    snprintf(part, sizeof part, "%s.part", path);
    assert_int_not_equal(access(part, F_OK), 0);
}

static void test_failed_writing_leaves_the_old_file(void **state)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    scratch_path(*state, "old.png", path);
    scratch_write(path, "old", 3);
    image_t image;
    assert_true(png_file_load("tests/images/coffee_510x290.png", IMAGE_XRGB8888, &image, error));

    /* A file size limit stands in for a full disk. */
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, SIG_IGN);
    const struct rlimit small = {20000, before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const bool written = png_file_write(path, &image, error);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_false(written);
    assert_non_null(strstr(error, "cannot write: File too large"));
    size_t length;
    uint8_t *bytes = scratch_read(path, &length);
    assert_int_equal(length, 3);
    free(bytes);
    char part[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "old.png.part", part);
    assert_int_not_equal(access(part, F_OK), 0);

    assert_write_fails("/dev/full", &image, "cannot write: No space left");
    assert_write_fails("build/no/such/folder/a.png", &image, "cannot create: No such file");
    assert_true(png_file_write(path, &image, error));
    int32_t width, height;
    assert_true(png_file_size(path, &width, &height, error));
    assert_int_equal(width, 510);
    free(image.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_truncation_is_refused),
        cmocka_unit_test(test_flipped_bytes_are_refused_or_harmless),
        cmocka_unit_test(test_bad_files_say_what_is_wrong),
        cmocka_unit_test(test_a_long_path_leaves_room_for_the_reason),
        cmocka_unit_test(test_failed_writing_leaves_the_old_file),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
