// SPDX-License-Identifier: Apache-2.0
// Videos of every kind: which pictures come, in which order, and what is refused.
#include "sim/files/video_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "sim/devices/sim_rate.h"
#include "sim/devices/test_pattern.h"
#include "sim/files/numbered_name.h"
#include "sim/files/png_file.h"
#include "tests/support/scratch.h"

enum { W = 6, H = 4 };

/* A picture all of one gray. */
static void write_png(const scratch_t *scratch, const char *name, uint8_t gray, int32_t width)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    uint8_t pixels[100];
    memset(pixels, gray, sizeof pixels);
    scratch_path(scratch, name, path);
    assert_true(png_file_write(path, &(image_t){pixels, width, H, width, IMAGE_GRAY8}, error));
}

static video_t *open_video(const scratch_t *scratch, const char *name)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH] = "";
    scratch_path(scratch, name, path);
    video_t *video = video_open(path, W, H, error);
    if (video == NULL)
        fail_msg("%s", error);
    return video;
}

/* The blue of the first pixel of a frame, as XRGB; the gray picture must agree. */
static int first_pixel(video_t *video, int64_t index)
{
    uint8_t colour[W * H * 4], gray[W * H];
    char error[FILE_ERROR_LENGTH];
    assert_true(video_frame(video, index, &(image_t){colour, W, H, W * 4, IMAGE_XRGB8888}, error));
    assert_true(video_frame(video, index, &(image_t){gray, W, H, W, IMAGE_GRAY8}, error));
    assert_int_equal(gray[0], (19595 * colour[2] + 38470 * colour[1] + 7471 * colour[0] + 32768) / 65536);
    return colour[0];
}

static void assert_refused(const scratch_t *scratch, const char *name, const char *wanted)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH] = "";
    scratch_path(scratch, name, path);
    assert_null(video_open(path, W, H, error));
    if (strstr(error, wanted) == NULL)
        fail_msg("'%s' does not say '%s'", error, wanted);
}

static void test_a_still_repeats(void **state)
{
    write_png(*state, "still.png", 77, W);
    video_t *video = open_video(*state, "still.png");
    assert_int_equal(video_info(video)->frame_count, 1);
    assert_int_equal(video_info(video)->rate_frames, 30);
    assert_int_equal(first_pixel(video, 0), 77);
    assert_int_equal(first_pixel(video, 1234567890123), 77);
    video_close(video);
}

static void test_numbered_pictures_loop(void **state)
{
    for (int first = 0; first <= 1; first++) {
        char name[64], pattern[64];
        snprintf(pattern, sizeof pattern, "from%d_100%%%%_%%03d.png", first);
        for (int i = 0; i < 3; i++) {
            snprintf(name, sizeof name, "from%d_100%%_%03d.png", first, first + i);
            write_png(*state, name, (uint8_t)(10 * i + 5), W);
        }
        snprintf(name, sizeof name, "from%d_100%%_%03d.png", first, first + 4); /* behind a gap: not part of it */
        write_png(*state, name, 99, W);
        video_t *video = open_video(*state, pattern);
        assert_int_equal(video_info(video)->frame_count, 3);
        for (int i = 0; i < 7; i++)
            assert_int_equal(first_pixel(video, i), 10 * (i % 3) + 5);
        video_close(video);
    }
}

static void test_raw_pictures(void **state)
{
    static const char *const names[] = {"a.raw", "a.XRGB", "a.bgrx"};
    for (int i = 0; i < 3; i++) {
        uint8_t pixels[3 * W * H * 4];
        char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
        for (size_t k = 0; k < sizeof pixels; k++)
            pixels[k] = (uint8_t)(k * 5);
        scratch_path(*state, names[i], path);
        scratch_write(path, pixels, sizeof pixels);
        video_t *video = open_video(*state, names[i]);
        assert_int_equal(video_info(video)->frame_count, 3);
        uint8_t read[W * H * 4];
        assert_true(video_frame(video, 5, &(image_t){read, W, H, W * 4, IMAGE_XRGB8888}, error));
        for (size_t k = 0; k < sizeof read; k++)
            assert_int_equal(read[k], k % 4 == 3 ? 0 : pixels[2 * sizeof read + k]);
        assert_int_equal(first_pixel(video, 1), (uint8_t)(W * H * 4 * 5));
        video_close(video);
        scratch_write(path, pixels, sizeof pixels - 1);
        assert_refused(*state, names[i], "287 bytes, expected a multiple of 96 (6x4, 4 bytes a pixel)");
        scratch_write(path, pixels, 0);
        assert_refused(*state, names[i], "0 bytes, expected a multiple");
    }
}

/* Half a frame read must not pass for the frame that was read before. */
static void test_a_raw_file_that_shrinks(void **state)
{
    enum { FRAME = W * H * 4, FRAMES = 200 }; /* more than stdio reads ahead */
    uint8_t pixels[FRAME * FRAMES], gray[W * H];
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    for (int i = 0; i < FRAMES; i++)
        memset(pixels + FRAME * i, i, FRAME);
    scratch_path(*state, "shrinks.raw", path);
    scratch_write(path, pixels, sizeof pixels);
    video_t *video = open_video(*state, "shrinks.raw");
    assert_true(video_frame(video, 2, &(image_t){gray, W, H, W, IMAGE_GRAY8}, error));
    scratch_write(path, pixels, FRAME * 150 + FRAME / 2);
    assert_false(video_frame(video, 150, &(image_t){gray, W, H, W, IMAGE_GRAY8}, error));
    assert_non_null(strstr(error, "frame 150 is short, row 2 of 4"));
    assert_int_equal(gray[0], 2);
    assert_true(video_frame(video, 2, &(image_t){gray, W, H, W, IMAGE_GRAY8}, error));
    assert_int_equal(gray[0], 2);
    video_close(video);
}

static void test_y4m_is_known_by_its_beginning(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    static const char file[] = "YUV4MPEG2 W6 H4 F24000:1001 Cmono XCOLORRANGE=FULL\n"
                               "FRAME\naaaaaaaaaaaaaaaaaaaaaaaa"
                               "FRAME\nbbbbbbbbbbbbbbbbbbbbbbbb";
    scratch_path(*state, "movie", path);
    scratch_write(path, file, sizeof file - 1);
    video_t *video = open_video(*state, "movie");
    assert_int_equal(video_info(video)->frame_count, 2);
    assert_int_equal(video_info(video)->rate_frames, 24000);
    assert_int_equal(video_info(video)->rate_seconds, 1001);
    assert_int_equal(first_pixel(video, 0), 'a');
    assert_int_equal(first_pixel(video, 3), 'b');
    video_close(video);
}

static void test_bad_videos_say_what_is_wrong(void **state)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    assert_refused(*state, "none.png", "No such file");
    assert_refused(*state, "none.raw", "No such file");
    assert_refused(*state, "none_%d.png", "no such pictures, expected the first with number 0 or 1");
    assert_refused(*state, "", "not a regular file");
    write_png(*state, "wide.png", 1, W + 1);
    assert_refused(*state, "wide.png", "wide.png: picture 7x4, the room's camera is 6x4");
    write_png(*state, "mixed_0.png", 1, W);
    write_png(*state, "mixed_1.png", 1, W + 2);
    assert_refused(*state, "mixed_%d.png", "mixed_1.png: picture 8x4, the room's camera is 6x4");
    static const char *const patterns[] = {"a%s.png", "a%n.png",   "a%5d.png",   "a%d%d.png", "a%",
                                           "a%0.png", "a%00d.png", "a%012d.png", "a%ld.png",  "a%%.png"};
    for (int i = 0; i < 10; i++)
        assert_refused(*state, patterns[i], "expected exactly one %d or %0Nd");
    static const struct {
        const char *name, *content, *wanted;
    } files[] = {{"text.txt", "hello, world", "unknown kind of video"},
                 {"short", "x", "unknown kind of video"},
                 {"text.png", "hello, world", "not a PNG file"},
                 {"text.y4m", "hello, world", "not a Y4M file"},
                 {"small.y4m", "YUV4MPEG2 W2 H1 Cmono\nFRAME\nab", "picture 2x1, the room's camera is 6x4"}};
    for (int i = 0; i < 5; i++) {
        scratch_path(*state, files[i].name, path);
        scratch_write(path, files[i].content, strlen(files[i].content));
        assert_refused(*state, files[i].name, files[i].wanted);
    }
    assert_null(video_open("tests/images/coffee_510x290.png", 1920, 1080, error));
    assert_string_equal(error, "tests/images/coffee_510x290.png: picture 510x290, the room's camera is 1920x1080");
}

static void test_a_picture_that_vanishes_is_reported(void **state)
{
    char path[SCRATCH_PATH_LENGTH], error[FILE_ERROR_LENGTH];
    write_png(*state, "gone_0.png", 1, W);
    write_png(*state, "gone_1.png", 2, W);
    video_t *video = open_video(*state, "gone_%d.png");
    assert_int_equal(first_pixel(video, 0), 1);
    scratch_path(*state, "gone_1.png", path);
    assert_int_equal(unlink(path), 0);
    uint8_t gray[W * H], untouched[W * H];
    memset(gray, 0xA5, sizeof gray);
    memset(untouched, 0xA5, sizeof untouched);
    assert_false(video_frame(video, 1, &(image_t){gray, W, H, W, IMAGE_GRAY8}, error));
    assert_non_null(strstr(error, "gone_1.png: cannot read"));
    assert_memory_equal(gray, untouched, sizeof gray);
    assert_int_equal(first_pixel(video, 2), 1);
    video_close(video);
}

static void test_the_pattern_moves_and_repeats(void **state)
{
    (void)state;
    enum { PW = 128, PH = 72 };
    char error[FILE_ERROR_LENGTH];
    video_t *video = video_open("pattern", PW, PH, error);
    assert_non_null(video);
    uint8_t *frames[4];
    static const int64_t indices[4] = {0, 1, TEST_PATTERN_STEPS, TEST_PATTERN_STEPS / 2};
    for (int i = 0; i < 4; i++) {
        frames[i] = malloc(PW * PH * 4);
        assert_true(video_frame(video, indices[i], &(image_t){frames[i], PW, PH, PW * 4, IMAGE_XRGB8888}, error));
    }
    assert_memory_not_equal(frames[0], frames[1], PW * PH * 4);
    assert_memory_equal(frames[0], frames[2], PW * PH * 4);
    assert_memory_not_equal(frames[0], frames[3], PW * PH * 4);
    static const uint8_t orange[4] = {0, 128, 255, 0}, white[4] = {255, 255, 255, 0}, gray[4] = {126, 126, 126, 0};
    assert_memory_equal(frames[1] + 4 * (2 * PW + 3), orange, 4); /* the bar covers columns 2 and 3 */
    assert_memory_equal(frames[1], white, 4);
    static const uint8_t bars[8][4] = {{191, 191, 191}, {0, 191, 191}, {191, 191, 0}, {0, 191, 0},
                                       {191, 0, 191},   {0, 0, 191},   {191, 0, 0},   {0, 0, 0}};
    for (int i = 0; i < 8; i++)
        assert_memory_equal(frames[1] + 4 * (2 * PW + 16 * i + 5), bars[i], 4);
    assert_memory_equal(frames[1] + 4 * (57 * PW + 63), gray, 4);
    assert_memory_equal(frames[1] + 4 * (57 * PW + 64), white, 4); /* a line of the grid */
    for (int i = 0; i < 4; i++)
        free(frames[i]);
    video_close(video);
    for (int32_t width = 1; width < 70; width++) { /* no size is too small */
        uint8_t pixels[70 * 3];
        test_pattern_draw(&(image_t){pixels, width, 3, width, IMAGE_GRAY8}, 63);
    }
}

static void test_numbered_names_that_do_not_fit(void **state)
{
    (void)state;
    char name[10];
    assert_true(numbered_name(name, sizeof name, "a_%04d.xy", 12));
    assert_string_equal(name, "a_0012.xy");
    assert_false(numbered_name(name, sizeof name, "a_%04d.xyz", 12));
    assert_false(numbered_name(name, sizeof name, "a_%d.xyz", 1234567));
    assert_false(numbered_name(name, sizeof name, "abcdefghijklmnop%d", 1));
}

static void test_beats_are_where_they_should_be(void **state)
{
    (void)state;
    static const sim_rate_t rates[] = {{1000, 30, 1}, {-77, 60000, 1001}, {0, 1000000, 1}, {5, 1, 3}, {0, 7, 2}};
    for (int i = 0; i < 5; i++) {
        const sim_rate_t *rate = &rates[i];
        for (int64_t n = -300; n < 3000000; n += n < 300 ? 1 : 99991) {
            const int64_t time_us = sim_rate_time_us(rate, n);
            const double exact_us = (double)rate->start_us + (double)n * 1e6 * rate->seconds / rate->frames;
            assert_true((double)time_us <= exact_us + 1e-3 && (double)time_us > exact_us - 1.001);
            assert_int_equal(sim_rate_beat_at(rate, time_us), n);
            assert_int_equal(sim_rate_beat_at(rate, time_us - 1), n - 1);
        }
    }
    assert_int_equal(sim_rate_time_us(&rates[1], 60000LL * 1000000), 1001000000000000LL - 77);
    assert_false(sim_rate_is_valid(&(sim_rate_t){0, 0, 1}));
    assert_false(sim_rate_is_valid(&(sim_rate_t){0, 1, 0}));
    assert_false(sim_rate_is_valid(&(sim_rate_t){0, 1000001, 1}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_still_repeats),
        cmocka_unit_test(test_numbered_pictures_loop),
        cmocka_unit_test(test_raw_pictures),
        cmocka_unit_test(test_a_raw_file_that_shrinks),
        cmocka_unit_test(test_y4m_is_known_by_its_beginning),
        cmocka_unit_test(test_bad_videos_say_what_is_wrong),
        cmocka_unit_test(test_a_picture_that_vanishes_is_reported),
        cmocka_unit_test(test_the_pattern_moves_and_repeats),
        cmocka_unit_test(test_numbered_names_that_do_not_fit),
        cmocka_unit_test(test_beats_are_where_they_should_be),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
