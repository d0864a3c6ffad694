// SPDX-License-Identifier: Apache-2.0
// The display in the simulator (hal/hal_display.h): pictures in memory, blanks in the board's time, faults on demand.
#include "sim/devices/sim_display.h"

#include <stdlib.h>
#include <time.h>

#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_picture.h"

enum { BUFFERS = 3, NONE = -1, NO_DISPLAY_NS = 20000000 };

struct hal_display {
    sim_display_settings_t settings;
    sim_display_faults_t faults;
    sim_display_counts_t counts;
    picture_t buffers[BUFFERS];
    image_t shown_image, converted;     /**< what is shown, as XRGB8888; memory for that */
    int shown, late, waiting, borrowed; /**< which buffer has that part, or NONE; all different */
    uint32_t late_blanks;               /**< how many blanks the late one has to wait yet */
    int64_t blank;                      /**< the last one performed */
    uint8_t *pixels;
};

static bool settings_are_right(const sim_display_settings_t *settings, char error[FILE_ERROR_LENGTH])
{
    const picture_format_t format = settings->format;
    if (settings->width < 1 || settings->width > IMAGE_MAX_WIDTH || settings->height < 1 ||
        settings->height > IMAGE_MAX_HEIGHT)
        return file_error(error, "display", "panel %dx%d, expected at most %dx%d", settings->width, settings->height,
                          IMAGE_MAX_WIDTH, IMAGE_MAX_HEIGHT);
    if (format != PICTURE_XRGB8888 && format != PICTURE_NV12 && format != PICTURE_YUYV)
        return file_error(error, "display", "format %s, expected xrgb8888, nv12 or yuyv", sim_picture_formats[format]);
    const picture_t panel = sim_picture(format, settings->width, settings->height, NULL);
    if (!picture_is_valid(&panel))
        return file_error(error, "display", "panel %dx%d, expected an even size for %s", settings->width,
                          settings->height, sim_picture_formats[format]);
    if (!sim_rate_is_valid(&settings->blanks))
        return file_error(error, "display", "%d blanks in %d s, expected up to 1000000 a second",
                          settings->blanks.frames, settings->blanks.seconds);
    return true;
}

hal_display_t *sim_display_create(const sim_display_settings_t *settings, char error[FILE_ERROR_LENGTH])
{
    if (!settings_are_right(settings, error))
        return NULL;
    const int32_t stride = settings->width * (int32_t)IMAGE_XRGB8888;
    const size_t bytes = (size_t)stride * (size_t)settings->height; /* enough for any format */
    hal_display_t *display = malloc(sizeof *display);
    uint8_t *pixels = calloc(BUFFERS + 1, bytes);
    if (display == NULL || pixels == NULL) {
        free(display);
        free(pixels);
        file_error(error, "display", "out of memory");
        return NULL;
    }
    *display = (hal_display_t){.settings = *settings, .shown = NONE, .late = NONE, .waiting = NONE, .borrowed = NONE};
    display->pixels = pixels;
    display->blank = sim_rate_beat_at(&settings->blanks, sim_clock_time_us(settings->clock));
    for (size_t i = 0; i < BUFFERS; i++)
        display->buffers[i].data[0] = pixels + i * bytes;
    display->converted = (image_t){pixels + BUFFERS * bytes, settings->width, settings->height, stride, IMAGE_XRGB8888};
    return display;
}

void sim_display_destroy(hal_display_t *display)
{
    if (display == NULL)
        return;
    free(display->pixels);
    free(display);
}

sim_display_faults_t *sim_display_faults(hal_display_t *display)
{
    return &display->faults;
}

sim_display_counts_t sim_display_counts(const hal_display_t *display)
{
    return display->counts;
}

static bool is_unplugged(const hal_display_t *display, int64_t time_us)
{
    return display->faults.unplugged_until_us != 0 && time_us < display->faults.unplugged_until_us;
}

/* Which buffer reaches the wall at this blank, or NONE. */
static int flip(hal_display_t *display)
{
    if (display->late != NONE) {
        if (--display->late_blanks > 0)
            return NONE;
        const int flipped = display->late;
        display->late = NONE;
        return flipped;
    }
    const int flipped = display->waiting;
    display->waiting = NONE;
    if (flipped != NONE && display->faults.late_next > 0) {
        display->faults.late_next--;
        display->late = flipped;
        display->late_blanks = display->faults.late_blanks > 0 ? display->faults.late_blanks : 1;
        return NONE;
    }
    return flipped;
}

static void perform_blank(hal_display_t *display)
{
    display->blank++;
    const bool dark = is_unplugged(display, sim_rate_time_us(&display->settings.blanks, display->blank));
    const int flipped = dark ? NONE : flip(display);
    if (flipped != NONE) {
        display->shown = flipped;
        display->counts.flips++;
    } else if (display->counts.flips > 0) {
        display->counts.missed++;
    }
}

void sim_display_advance(hal_display_t *display, int64_t now_us)
{
    const int64_t due = sim_rate_beat_at(&display->settings.blanks, now_us);
    while (display->blank < due && (display->waiting != NONE || display->late != NONE))
        perform_blank(display);
    if (display->blank < due) { /* nothing to flip: only count */
        if (display->counts.flips > 0)
            display->counts.missed += (uint64_t)(due - display->blank);
        display->blank = due;
    }
}

const picture_t *sim_display_scanned(const hal_display_t *display)
{
    if (display->shown == NONE || is_unplugged(display, sim_clock_time_us(display->settings.clock)))
        return NULL;
    return &display->buffers[display->shown];
}

const image_t *sim_display_shown(hal_display_t *display)
{
    const picture_t *shown = sim_display_scanned(display);
    if (shown == NULL)
        return NULL;
    display->shown_image = shown->format == PICTURE_XRGB8888 ? picture_plane(shown, 0) : display->converted;
    if (shown->format != PICTURE_XRGB8888)
        sim_picture_to_xrgb(&display->converted, shown);
    return &display->shown_image;
}

static int find_free(const hal_display_t *display)
{
    for (int i = 0; i < BUFFERS; i++)
        if (i != display->shown && i != display->late && i != display->waiting)
            return i;
    return NONE;
}

bool hal_display_takes(const hal_display_t *display, picture_format_t format)
{
    return format == PICTURE_XRGB8888 || format == display->settings.format;
}

hal_status_t hal_display_back_buffer(hal_display_t *display, picture_format_t format, picture_matrix_t matrix,
                                     picture_t *buffer)
{
    const int64_t now_us = sim_clock_time_us(display->settings.clock);
    sim_display_advance(display, now_us);
    if (!hal_display_takes(display, format))
        return HAL_BAD_CALL;
    if (is_unplugged(display, now_us))
        return HAL_IO;
    if (display->borrowed == NONE)
        display->borrowed = find_free(display);
    if (display->borrowed == NONE)
        return HAL_FULL;
    picture_t *borrowed = &display->buffers[display->borrowed];
    *borrowed = sim_picture(format, display->settings.width, display->settings.height, borrowed->data[0]);
    borrowed->matrix = matrix;
    *buffer = *borrowed;
    sim_clock_work(display->settings.clock, display->faults.drawing_us);
    return HAL_OK;
}

hal_status_t hal_display_present(hal_display_t *display)
{
    const int64_t now_us = sim_clock_time_us(display->settings.clock);
    sim_display_advance(display, now_us);
    if (display->borrowed == NONE)
        return HAL_BAD_CALL;
    const int presented = display->borrowed;
    display->borrowed = NONE;
    if (is_unplugged(display, now_us) || display->faults.refuse_next > 0) {
        if (display->faults.refuse_next > 0)
            display->faults.refuse_next--;
        display->counts.refused++;
        return HAL_IO;
    }
    if (display->waiting != NONE)
        display->counts.replaced++;
    display->waiting = presented;
    return HAL_OK;
}

int64_t hal_display_next_vblank_us(const hal_display_t *display)
{
    const sim_rate_t *blanks = &display->settings.blanks;
    const hal_time_t *clock = display->settings.clock;
    return sim_clock_shows_us(clock, sim_rate_time_us(blanks, sim_rate_beat_at(blanks, sim_clock_time_us(clock)) + 1));
}

hal_status_t hal_display_wait_vblank(hal_display_t *display)
{
    if (display == NULL) {
        (void)nanosleep(&(struct timespec){.tv_nsec = NO_DISPLAY_NS}, NULL);
        return HAL_IO;
    }
    const hal_time_t *clock = display->settings.clock;
    const bool unplugged = is_unplugged(display, sim_clock_time_us(clock));
    const int64_t next_us = hal_display_next_vblank_us(display);
    if (sim_clock_is_real(clock)) {
        if (display->settings.while_waiting != NULL)
            display->settings.while_waiting(display->settings.context);
        sim_clock_sleep_until_us(clock, next_us);
    }
    sim_display_advance(display, sim_clock_time_us(clock));
    return unplugged ? HAL_IO : HAL_OK;
}
