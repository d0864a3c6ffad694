// SPDX-License-Identifier: Apache-2.0
// Uses a real display through its contract (hal/hal_display.h), and says what it found: a line for each fault.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hal/linux/display_kms.h"

static const char USAGE[] =
    "usage: probe_display picture WIDTH HEIGHT SEED          writes the test picture, a PPM\n"
    "       probe_display frames NAME WIDTH HEIGHT HZ COUNT  shows so many, and judges the display\n"
    "       probe_display hold NAME WIDTH HEIGHT HZ SEED     shows the test picture until SIGTERM\n";

typedef struct {
    int32_t width, height;
    uint32_t seed;
} test_picture_t;

static volatile sig_atomic_t stop_requested;
static int faults;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

static void expect(bool right, const char *what)
{
    faults += !right;
    if (!right)
        printf("fault: %s\n", what);
}

/* No two pixels near each other alike, nor two seeds. */
static uint32_t pixel(const test_picture_t *picture, int32_t x, int32_t y)
{
    const uint32_t place = (uint32_t)(y * picture->width + x) + picture->seed * 0x01000193u;
    return (place * 2654435761u >> 8) ^ ((uint32_t)x << 16 | (uint32_t)y);
}

static int write_picture(const test_picture_t *picture)
{
    printf("P6\n%d %d\n255\n", picture->width, picture->height);
    for (int32_t y = 0; y < picture->height; y++)
        for (int32_t x = 0; x < picture->width; x++) {
            const uint32_t xrgb = pixel(picture, x, y);
            putchar((int)(xrgb >> 16 & 0xFF));
            putchar((int)(xrgb >> 8 & 0xFF));
            putchar((int)(xrgb & 0xFF));
        }
    return fflush(stdout) == 0 ? 0 : 1;
}

static void draw(const picture_t *buffer, uint32_t seed)
{
    const test_picture_t picture = {buffer->width, buffer->height, seed};
    for (int32_t y = 0; y < buffer->height; y++)
        for (int32_t x = 0; x < buffer->width; x++) {
            const uint32_t xrgb = pixel(&picture, x, y);
            memcpy(buffer->data[0] + (ptrdiff_t)buffer->stride[0] * y + 4 * x, &xrgb, sizeof xrgb);
        }
}

static int64_t now_us(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * INT64_C(1000000) + now.tv_nsec / 1000;
}

static bool show(hal_display_t *display, uint32_t seed)
{
    picture_t buffer;
    if (hal_display_back_buffer(display, PICTURE_XRGB8888, PICTURE_BT709, &buffer) != HAL_OK)
        return false;
    draw(&buffer, seed);
    return hal_display_present(display) == HAL_OK;
}

/* What the contract says of calls, whatever the time. */
static void judge_calls(hal_display_t *display, const display_kms_settings_t *settings)
{
    picture_t first, second;
    expect(hal_display_takes(display, PICTURE_XRGB8888), "every display takes XRGB8888");
    expect(!hal_display_takes(display, PICTURE_GRAY8), "no display takes GRAY8");
    expect(hal_display_present(display) == HAL_BAD_CALL, "nothing is borrowed to present");
    expect(hal_display_back_buffer(display, PICTURE_GRAY8, PICTURE_BT709, &first) == HAL_BAD_CALL, "GRAY8 is refused");
    if (hal_display_back_buffer(display, PICTURE_XRGB8888, PICTURE_BT709, &first) != HAL_OK ||
        hal_display_back_buffer(display, PICTURE_XRGB8888, PICTURE_BT709, &second) != HAL_OK) {
        expect(false, "there is a buffer at the start");
        return;
    }
    expect(first.data[0] == second.data[0], "a borrowed buffer is lent again");
    expect(picture_is_valid(&first) && first.width == settings->width && first.height == settings->height,
           "the buffer has the projector's size");
    draw(&first, 0);
    expect(hal_display_present(display) == HAL_OK, "a picture is presented");
    expect(hal_display_present(display) == HAL_BAD_CALL, "it is not borrowed any more");
    expect(hal_display_wait_vblank(display) == HAL_OK, "its blank comes");
}

/* No blank comes before its time: a slow machine may miss some, but none has more of them than its mode. */
static void judge_blanks(hal_display_t *display, const display_kms_settings_t *settings, int count)
{
    const double period_us = 1e6 * settings->refresh_seconds / settings->refresh_frames;
    int64_t early_us = 0;
    const int64_t begin_us = now_us();
    for (int i = 0; i < count && !stop_requested; i++) {
        if (i % 8 != 7) /* now and then the wall is frozen */
            expect(show(display, (uint32_t)i), "each refresh has a picture");
        const int64_t asked_us = now_us(), next_us = hal_display_next_vblank_us(display);
        expect(next_us > asked_us - 1000 && (double)(next_us - asked_us) < 1.02 * period_us + 1000,
               "the next blank is within a period");
        expect(hal_display_wait_vblank(display) == HAL_OK, "each blank comes");
        const int64_t before_us = next_us - now_us();
        early_us = before_us > early_us ? before_us : early_us;
    }
    const double seen_us = (double)(now_us() - begin_us) / count;
    printf("%d refreshes: %.1f us each, the mode's are near %.1f us; back at most %d us before the time told\n", count,
           seen_us, period_us, (int)early_us);
    expect(seen_us > 0.98 * period_us, "refreshes are not shorter than the mode's");
    expect((double)early_us < period_us / 4, "the wait ends no earlier than the blank");
}

static void hold(hal_display_t *display, uint32_t seed)
{
    hal_status_t before = HAL_OK;
    bool shown = show(display, seed);
    expect(shown, "the picture is shown");
    while (!stop_requested) {
        const hal_status_t status = hal_display_wait_vblank(display);
        if (status != before)
            printf("%s\n", status == HAL_OK ? "lit" : "dark");
        else if (shown)
            printf("shown\n");
        before = status;
        shown = false;
        fflush(stdout);
    }
}

static int use_display(char **words)
{
    const display_kms_settings_t settings = {
        .name = words[2],
        .width = atoi(words[3]),
        .height = atoi(words[4]),
        .refresh_frames = atoi(words[5]),
        .refresh_seconds = 1,
    };
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_display_t *display;
    signal(SIGTERM, request_stop);
    if (display_kms_open(&display, &settings, error) != HAL_OK) {
        fprintf(stderr, "probe_display: %s\n", error);
        return 1;
    }
    if (strcmp(words[1], "frames") == 0) {
        judge_calls(display, &settings);
        judge_blanks(display, &settings, atoi(words[6]));
    } else {
        hold(display, (uint32_t)atoi(words[6]));
    }
    display_kms_close(display);
    return faults == 0 ? 0 : 1;
}

int main(int argc, char **argv)
{
    if (argc == 5 && strcmp(argv[1], "picture") == 0)
        return write_picture(&(test_picture_t){atoi(argv[2]), atoi(argv[3]), (uint32_t)atoi(argv[4])});
    if (argc == 7 && (strcmp(argv[1], "frames") == 0 || strcmp(argv[1], "hold") == 0))
        return use_display(argv);
    fputs(USAGE, stderr);
    return 2;
}
