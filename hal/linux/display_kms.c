// SPDX-License-Identifier: Apache-2.0
// The projector's display (hal/hal_display.h) on Linux: which buffer is drawn into, flies and is shown; the wait.
#include "hal/linux/display_kms.h"

#include <errno.h>
#include <poll.h>
#include <time.h>
#include <xf86drm.h>

#include "hal/linux/clocks.h"
#include "hal/linux/display_kms_events.h"
#include "hal/linux/display_kms_state.h"

static const int64_t SECOND_NS = 1000000000, NO_BLANK_NS = 100000000, NO_DISPLAY_NS = 20000000;

static void take_event(hal_display_t *display, const kms_event_t *event)
{
    display->hangs = false;
    if (!display->by_clock)
        kms_blank_add(&display->blank, event->time_ns, event->sequence);
    if (event->token > display->answered)
        display->answered = event->token;
    if (event->token != display->flight || display->flying == KMS_NO_BUFFER)
        return;
    display->shown = display->flying;
    display->flying = KMS_NO_BUFFER;
}

/* Give the waiting picture to the kernel, unless one is on its way. @return 0, or an errno: it waits no more. */
static int fly(hal_display_t *display)
{
    if (display->waiting == KMS_NO_BUFFER || display->flying != KMS_NO_BUFFER || display->dark)
        return 0;
    const kms_scan_t scan = kms_state_scan(display, display->waiting);
    const int failure = kms_pipe_flip(&display->pipe, &scan, ++display->asked);
    if (failure == EBUSY) /* the kernel still ends something of its own */
        return 0;
    if (failure == 0) {
        display->flying = display->waiting;
        display->flight = display->asked;
    }
    display->waiting = KMS_NO_BUFFER;
    display->dark = failure == EACCES || failure == EPERM || failure == ENODEV; /* not ours any more, or gone */
    return failure;
}

static void take_events(hal_display_t *display)
{
    kms_event_t events[KMS_EVENTS];
    const int32_t count = kms_events_take(events, display->card.file);
    for (int32_t i = 0; i < count; i++)
        take_event(display, &events[i]);
    (void)fly(display); /* what is refused is left out, and the wall keeps its picture */
}

bool hal_display_takes(const hal_display_t *display, picture_format_t format)
{
    return display->buffers.buffer[0].framebuffer[format] != 0;
}

static int32_t find_free(const hal_display_t *display)
{
    for (int32_t i = 0; i < KMS_BUFFERS; i++)
        if (i != display->shown && i != display->flying && i != display->waiting)
            return i;
    return KMS_NO_BUFFER;
}

hal_status_t hal_display_back_buffer(hal_display_t *display, picture_format_t format, picture_matrix_t matrix,
                                     picture_t *buffer)
{
    if (!hal_display_takes(display, format))
        return HAL_BAD_CALL;
    if (display->dark)
        return HAL_IO;
    take_events(display);
    if (display->borrowed == KMS_NO_BUFFER)
        display->borrowed = find_free(display);
    if (display->borrowed == KMS_NO_BUFFER)
        return HAL_FULL;
    display->look[display->borrowed] = (kms_look_t){format, matrix};
    *buffer = kms_buffers_picture(&display->buffers, display->borrowed, format);
    buffer->matrix = matrix;
    return HAL_OK;
}

hal_status_t hal_display_present(hal_display_t *display)
{
    if (display->borrowed == KMS_NO_BUFFER)
        return HAL_BAD_CALL;
    take_events(display);
    const int32_t presented = display->borrowed;
    display->borrowed = KMS_NO_BUFFER;
    if (display->dark)
        return HAL_IO;
    display->waiting = presented;
    return fly(display) == 0 ? HAL_OK : HAL_IO;
}

int64_t hal_display_next_vblank_us(const hal_display_t *display)
{
    return kms_blank_after(&display->blank, clock_monotonic_ns()) / 1000;
}

static void sleep_until(int64_t time_ns)
{
    const struct timespec until = {.tv_sec = time_ns / SECOND_NS, .tv_nsec = time_ns % SECOND_NS};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) == EINTR) {
        /* a signal: the picture's time is the same */
    }
}

/* Sleep until a request is answered. @return false when it is not by then. */
static bool wait_for_answer(hal_display_t *display, uint64_t token, int64_t until_ns)
{
    struct pollfd card = {.fd = display->card.file, .events = POLLIN};
    for (int64_t now_ns = clock_monotonic_ns(); display->answered < token && now_ns < until_ns;
         now_ns = clock_monotonic_ns()) {
        const struct timespec left = {.tv_nsec = until_ns - now_ns};
        if (ppoll(&card, 1, &left, NULL) > 0 && (card.revents & POLLIN) == 0)
            sleep_until(until_ns); /* the card is gone */
        take_events(display);
    }
    return display->answered >= token;
}

/* The next blank, or that of the flip on its way, even if it has just been. */
static bool wait_for_driver(hal_display_t *display, int64_t until_ns)
{
    uint64_t token = display->flight;
    if (display->flying == KMS_NO_BUFFER) {
        token = ++display->asked;
        if (drmCrtcQueueSequence(display->card.file, display->pipe.screen.crtc, DRM_CRTC_SEQUENCE_RELATIVE, 1, NULL,
                                 token) != 0)
            return false;
    }
    return wait_for_answer(display, token, until_ns);
}

static bool wait_for_clock(hal_display_t *display, int64_t until_ns)
{
    sleep_until(kms_blank_after(&display->blank, clock_monotonic_ns()));
    take_events(display);
    return display->flying == KMS_NO_BUFFER || wait_for_answer(display, display->flight, until_ns);
}

hal_status_t hal_display_wait_vblank(hal_display_t *display)
{
    const int64_t begin_ns = clock_monotonic_ns();
    if (display == NULL) {
        sleep_until(begin_ns + NO_DISPLAY_NS);
        return HAL_IO;
    }
    kms_state_look(display, begin_ns);
    if (display->hangs)
        take_events(display); /* an answer has come after the last wait */
    const int64_t next_ns = kms_blank_after(&display->blank, begin_ns);
    if (display->dark) {
        sleep_until(next_ns);
        return HAL_IO;
    }
    const int64_t end_ns = display->hangs ? next_ns : begin_ns + NO_BLANK_NS;
    if (display->by_clock ? wait_for_clock(display, end_ns) : wait_for_driver(display, end_ns))
        return HAL_OK;
    display->hangs = true;
    sleep_until(end_ns);
    return HAL_IO;
}
