// SPDX-License-Identifier: Apache-2.0
// Y4M files: headers, colour spaces, and broken files.
#include "sim/files/y4m_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/files/yuv_to_rgb.h"
#include "tests/support/scratch.h"

enum { MOST_BYTES = 20000 };

/* A file being put together. */
typedef struct {
    uint8_t bytes[MOST_BYTES];
    size_t length;
} draft_t;

static void add_text(draft_t *draft, const char *text)
{
    memcpy(draft->bytes + draft->length, text, strlen(text));
    draft->length += strlen(text);
}

/* Samples count up by 7 from first: all different from their neighbours. */
static void add_samples(draft_t *draft, size_t count, int first)
{
    assert_true(draft->length + count <= MOST_BYTES);
    for (size_t i = 0; i < count; i++)
        draft->bytes[draft->length++] = (uint8_t)(first + 7 * (int)i);
}

static y4m_file_t *open_draft(const char *path, const draft_t *draft)
{
    char error[FILE_ERROR_LENGTH] = "";
    scratch_write(path, draft->bytes, draft->length);
    y4m_file_t *y4m = y4m_file_open(path, error);
    if (y4m == NULL)
        fail_msg("%s", error);
    return y4m;
}

/* A 5x3 picture in the named colour space must come out as the conversion of the samples that cover each pixel. */
static void check_layout(const char *path, const char *name, int shift_x, int shift_y, bool full)
{
    enum { W = 5, H = 3, STRIDE = W * 4 + 3 };
    const int chroma_width = (W + shift_x) >> shift_x, chroma_height = (H + shift_y) >> shift_y;
    const bool mono = strcmp(name, "mono") == 0;
    draft_t draft = {.length = 0};
    add_text(&draft, "YUV4MPEG2 W5 H3 F25:1 Ip A1:1 C");
    add_text(&draft, name);
    add_text(&draft, full ? " XCOLORRANGE=FULL\n" : " XYSCSS=ANY\n");
    const size_t chroma = mono ? 0 : (size_t)(chroma_width * chroma_height);
    for (int frame = 0; frame < 2; frame++) {
        add_text(&draft, frame == 0 ? "FRAME\n" : "FRAME Xmore\n");
        add_samples(&draft, W * H + 2 * chroma, 20 + frame);
    }
    y4m_file_t *y4m = open_draft(path, &draft);
    assert_int_equal(y4m_file_info(y4m)->frame_count, 2);
    uint8_t colour[STRIDE * H], gray[W * H];
    memset(colour, 0xA5, sizeof colour);
    const image_t image = {colour, W, H, STRIDE, IMAGE_XRGB8888}, gray_image = {gray, W, H, W, IMAGE_GRAY8};
    char error[FILE_ERROR_LENGTH];
    assert_true(y4m_file_frame(y4m, 1, &gray_image, error));
    assert_true(y4m_file_frame(y4m, 1, &image, error));
    const uint8_t *samples = draft.bytes + draft.length - (W * H + 2 * chroma);
    for (int i = 0; i < W * H; i++) {
        const int x = i % W, y = i / W;
        const size_t at = W * H + (size_t)((y >> shift_y) * chroma_width + (x >> shift_x));
        const rgb_t rgb = rgb_from_yuv(yuv_matrix(false, full), samples[i], mono ? 128 : samples[at],
                                       mono ? 128 : samples[at + chroma]);
        const uint8_t expected[4] = {rgb.blue, rgb.green, rgb.red, 0};
        assert_memory_equal(colour + y * STRIDE + 4 * x, expected, 4);
        assert_int_equal(gray[i], (19595 * rgb.red + 38470 * rgb.green + 7471 * rgb.blue + 32768) >> 16);
    }
    for (int y = 0; y < H; y++)
        assert_int_equal(colour[y * STRIDE + W * 4], 0xA5);
    y4m_file_close(y4m);
}

static void test_every_colour_space(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "video.y4m", path);
    static const char *const halved_both[] = {"420jpeg", "420mpeg2", "420paldv", "420"};
    for (int i = 0; i < 4; i++)
        check_layout(path, halved_both[i], 1, 1, i & 1);
    check_layout(path, "422", 1, 0, false);
    check_layout(path, "444", 0, 0, true);
    check_layout(path, "mono", 0, 0, false);
}

static void test_hd_pictures_are_bt709(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "video.y4m", path);
    for (int height = 719; height <= 720; height++) {
        draft_t draft = {.length = 0};
        char header[64];
        snprintf(header, sizeof header, "YUV4MPEG2 W2 H%d C444\nFRAME\n", height);
        add_text(&draft, header);
        add_samples(&draft, 6 * (size_t)height, 90);
        y4m_file_t *y4m = open_draft(path, &draft);
        uint8_t pixels[2 * 720 * 4];
        const image_t image = {pixels, 2, height, 8, IMAGE_XRGB8888};
        char error[FILE_ERROR_LENGTH];
        assert_true(y4m_file_frame(y4m, 0, &image, error));
        const uint8_t *samples = draft.bytes + strlen(header);
        const rgb_t rgb =
            rgb_from_yuv(yuv_matrix(height == 720, false), samples[0], samples[2 * height], samples[4 * height]);
        assert_int_equal(pixels[2], rgb.red);
        assert_int_equal(pixels[1], rgb.green);
        y4m_file_close(y4m);
    }
}

static void test_rates(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "video.y4m", path);
    static const struct {
        const char *header;
        int frames, seconds;
    } cases[] = {{"YUV4MPEG2 W1 H1 Cmono F30000:1001\nFRAME\nx", 30000, 1001},
                 {"YUV4MPEG2 W1 H1 Cmono F0:0 I?\nFRAME\nx", 30, 1},
                 {"YUV4MPEG2 H1 W1 Cmono\nFRAME\nx", 30, 1}};
    for (int i = 0; i < 3; i++) {
        draft_t draft = {.length = 0};
        add_text(&draft, cases[i].header);
        y4m_file_t *y4m = open_draft(path, &draft);
        assert_int_equal(y4m_file_info(y4m)->rate_frames, cases[i].frames);
        assert_int_equal(y4m_file_info(y4m)->rate_seconds, cases[i].seconds);
        assert_int_equal(y4m_file_info(y4m)->frame_count, 1);
        y4m_file_close(y4m);
    }
}

static void test_broken_files_say_what_is_wrong(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "video.y4m", path);
    static const struct {
        const char *file, *wanted;
    } cases[] = {
        {"", "not a Y4M file"},
        {"YUV4MPEG2 W1 H1 X"
         "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx"
         "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx"
         "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\n",
         "not a Y4M file"},
        {"YUV4MPEG2", "not a Y4M file"},
        {"YUV4MPEG W4 H4\nFRAME\n", "not a Y4M file"},
        {"YUV4MPEG2 \001W4 H4\n", "not a Y4M file"},
        {"YUV4MPEG2 H4\nFRAME\n", "no width or height"},
        {"YUV4MPEG2 W4\nFRAME\n", "no width or height"},
        {"YUV4MPEG2 W0 H4\n", "width '0', expected 1 to 4096"},
        {"YUV4MPEG2 W4097 H4\n", "width '4097'"},
        {"YUV4MPEG2 W-4 H4\n", "width '-4'"},
        {"YUV4MPEG2 W99999999999999999999 H4\n", "width '9999"},
        {"YUV4MPEG2 W4x H4\n", "width '4x'"},
        {"YUV4MPEG2 W4 H2161\n", "height '2161', expected 1 to 2160"},
        {"YUV4MPEG2 W4 H4 F30\n", "frame rate '30', expected FRAMES:SECONDS"},
        {"YUV4MPEG2 W4 H4 F30:0\n", "frame rate '30:0'"},
        {"YUV4MPEG2 W4 H4 F:1\n", "frame rate ':1'"},
        {"YUV4MPEG2 W4 H4 It\n", "interlacing 't', expected progressive"},
        {"YUV4MPEG2 W4 H4 Im\n", "interlacing 'm'"},
        {"YUV4MPEG2 W4 H4 C420p10\n", "colour space '420p10', expected 8-bit"},
        {"YUV4MPEG2 W4 H4 C411\n", "colour space '411'"},
        {"YUV4MPEG2 W4 H4 Q7\n", "unknown header parameter 'Q7'"},
        {"YUV4MPEG2 W4 H4\n", "no frame behind the header"},
        {"YUV4MPEG2 W2 H1 Cmono\nFRAME\nabFRAMES\nab", "frame 1 is broken"},
        {"YUV4MPEG2 W2 H1 Cmono\nFRAME\nabGRAME\nab", "frame 1 is broken"},
        {"YUV4MPEG2 W2 H1 Cmono\nFRAME\nabFRAME\na", "frame 1 is short: 1 bytes, expected 2"},
        {"YUV4MPEG2 W4096 H2160\nFRAME\na", "frame 0 is short: 1 bytes, expected 13271040"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char error[FILE_ERROR_LENGTH] = "";
        scratch_write(path, cases[i].file, strlen(cases[i].file));
        assert_null(y4m_file_open(path, error));
        if (strstr(error, cases[i].wanted) == NULL || strstr(error, path) != error)
            fail_msg("'%s' does not say '%s'", error, cases[i].wanted);
    }
}

static void good_draft(draft_t *draft)
{
    *draft = (draft_t){.length = 0};
    add_text(draft, "YUV4MPEG2 W6 H4 F25:1 Ip C420jpeg\n");
    for (int frame = 0; frame < 3; frame++) {
        add_text(draft, "FRAME\n");
        add_samples(draft, 36, 40);
    }
}

/* A file cut between two frames is a shorter video; cut anywhere else it is refused. */
static void test_truncations(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "video.y4m", path);
    draft_t draft;
    good_draft(&draft);
    const size_t header = draft.length - 3 * 42;
    for (size_t kept = 0; kept <= draft.length; kept++) {
        char error[FILE_ERROR_LENGTH];
        scratch_write(path, draft.bytes, kept);
        y4m_file_t *y4m = y4m_file_open(path, error);
        const bool whole = kept > header && (kept - header) % 42 == 0;
        assert_int_equal(y4m != NULL, whole);
        if (whole)
            assert_int_equal(y4m_file_info(y4m)->frame_count, (kept - header) / 42);
        y4m_file_close(y4m);
    }
}

/* Whatever the bytes, opening and reading every frame stays within the limits (seen by the sanitizers). */
static void test_flipped_bytes_do_no_harm(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "video.y4m", path);
    draft_t draft;
    int refused = 0;
    for (uint32_t seed = 1; seed <= 2000; seed++) {
        good_draft(&draft);
        uint32_t random = seed;
        for (int flips = 0; flips < 3; flips++) {
            random = random * 1664525u + 1013904223u;
            draft.bytes[(random >> 8) % 80] = (uint8_t)(random >> 24);
        }
        scratch_write(path, draft.bytes, draft.length);
        char error[FILE_ERROR_LENGTH] = "";
        y4m_file_t *y4m = y4m_file_open(path, error);
        if (y4m == NULL) {
            if (error[0] == '\0')
                fail_msg("seed %u: refused without a reason", seed);
            refused++;
            continue;
        }
        const y4m_info_t *info = y4m_file_info(y4m);
        uint8_t *pixels = malloc((size_t)info->width * (size_t)info->height * 4);
        const image_t image = {pixels, info->width, info->height, info->width * 4, IMAGE_XRGB8888};
        for (int frame = 0; frame < info->frame_count; frame++)
            if (!y4m_file_frame(y4m, frame, &image, error))
                fail_msg("seed %u, frame %d: %s", seed, frame, error);
        free(pixels);
        y4m_file_close(y4m);
    }
    assert_in_range(refused, 1000, 1999);
}

static void test_a_file_that_shrinks_is_noticed(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "video.y4m", path);
    enum { W = 100, H = 60 };
    draft_t draft = {.length = 0};
    add_text(&draft, "YUV4MPEG2 W100 H60 Cmono\n");
    for (int frame = 0; frame < 3; frame++) { /* together more than what stdio may have read ahead */
        add_text(&draft, "FRAME\n");
        add_samples(&draft, W * H, frame);
    }
    y4m_file_t *y4m = open_draft(path, &draft);
    scratch_write(path, draft.bytes, draft.length - 100);
    uint8_t pixels[W * H], untouched[W * H];
    memset(pixels, 0xA5, sizeof pixels);
    memset(untouched, 0xA5, sizeof untouched);
    const image_t image = {pixels, W, H, W, IMAGE_GRAY8};
    char error[FILE_ERROR_LENGTH];
    assert_false(y4m_file_frame(y4m, 2, &image, error));
    assert_non_null(strstr(error, "frame 2 is short"));
    assert_memory_equal(pixels, untouched, sizeof pixels);
    y4m_file_close(y4m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_colour_space),
        cmocka_unit_test(test_hd_pictures_are_bt709),
        cmocka_unit_test(test_rates),
        cmocka_unit_test(test_broken_files_say_what_is_wrong),
        cmocka_unit_test(test_truncations),
        cmocka_unit_test(test_flipped_bytes_do_no_harm),
        cmocka_unit_test(test_a_file_that_shrinks_is_noticed),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
