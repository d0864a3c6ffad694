// SPDX-License-Identifier: Apache-2.0
// The kernel's part of a display, played for tests: it takes flips and lights, answers when it is told to, and its time
// passes only while the display sleeps.
#include "tests/hal/linux/kms_kernel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <drm.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <xf86drm.h>

#include "hal/linux/clocks.h"
#include "hal/linux/display_kms.h"
#include "tests/support/scratch.h"

static const int64_t PERIOD_NS = 16666667, SECOND_NS = 1000000000;

kms_kernel_t kms_kernel;
hal_display_t kms_display;

static scratch_t scratch;

int64_t clock_monotonic_ns(void)
{
    return kms_kernel.now_ns;
}

/* In place of the C library's. */
int clock_nanosleep(clockid_t clock, int flags, const struct timespec *until, struct timespec *left)
{
    (void)left;
    assert_int_equal(clock, CLOCK_MONOTONIC);
    assert_int_equal(flags, TIMER_ABSTIME);
    const int64_t until_ns = until->tv_sec * SECOND_NS + until->tv_nsec;
    if (until_ns > kms_kernel.now_ns)
        kms_kernel.now_ns = until_ns;
    return 0;
}

int ppoll(struct pollfd *files, nfds_t count, const struct timespec *timeout, const sigset_t *mask)
{
    (void)mask;
    const int ready = poll(files, count, 0);
    if (ready == 0)
        kms_kernel.now_ns += timeout->tv_sec * SECOND_NS + timeout->tv_nsec;
    return ready;
}

void kms_kernel_answer(uint64_t token)
{
    kms_kernel.time_ns = clock_monotonic_ns();
    const struct drm_event_vblank event = {
        .base = {DRM_EVENT_FLIP_COMPLETE, sizeof event},
        .user_data = token,
        .tv_sec = (uint32_t)(kms_kernel.time_ns / SECOND_NS),
        .tv_usec = (uint32_t)(kms_kernel.time_ns % SECOND_NS / 1000),
        .sequence = ++kms_kernel.sequence,
    };
    assert_int_equal(write(kms_kernel.events[1], &event, sizeof event), sizeof event);
}

int kms_pipe_flip(const kms_pipe_t *pipe, const kms_scan_t *scan, uint64_t token)
{
    assert_ptr_equal(pipe, &kms_display.pipe);
    kms_kernel.flips++;
    if (kms_kernel.answer != 0)
        return kms_kernel.answer;
    kms_kernel.flown = *scan;
    kms_kernel.token = token;
    if (kms_kernel.at_once)
        kms_kernel_answer(token);
    return 0;
}

int kms_pipe_light(const kms_pipe_t *pipe, const kms_scan_t *scan)
{
    assert_ptr_equal(pipe, &kms_display.pipe);
    assert_true(kms_kernel.darkened);
    kms_kernel.darkened = false;
    kms_kernel.lights++;
    kms_kernel.lit = *scan;
    return kms_kernel.answer;
}

int kms_pipe_darken(const kms_pipe_t *pipe)
{
    assert_ptr_equal(pipe, &kms_display.pipe);
    kms_kernel.darkened = true;
    return 0;
}

int kms_pipe_set_mode(kms_pipe_t *pipe, const drmModeModeInfo *mode)
{
    assert_ptr_equal(pipe, &kms_display.pipe);
    assert_int_equal(mode->hdisplay, KMS_KERNEL_WIDTH);
    return 0;
}

int drmCrtcGetSequence(int card, uint32_t crtc, uint64_t *sequence, uint64_t *time_ns)
{
    (void)card;
    (void)crtc;
    *sequence = kms_kernel.sequence;
    *time_ns = (uint64_t)kms_kernel.time_ns;
    return kms_kernel.blanks ? 0 : -1;
}

int drmCrtcQueueSequence(int card, uint32_t crtc, uint32_t flags, uint64_t sequence, uint64_t *queued, uint64_t token)
{
    (void)card;
    (void)crtc;
    (void)queued;
    assert_int_equal(flags, DRM_CRTC_SEQUENCE_RELATIVE);
    assert_int_equal(sequence, 1);
    kms_kernel.asked++;
    if (kms_kernel.holds) {
        kms_kernel.token = token;
        return 0;
    }
    const struct drm_event_crtc_sequence event = {
        .base = {DRM_EVENT_CRTC_SEQUENCE, sizeof event},
        .user_data = token,
        .time_ns = kms_kernel.time_ns = clock_monotonic_ns(),
        .sequence = ++kms_kernel.sequence,
    };
    assert_int_equal(write(kms_kernel.events[1], &event, sizeof event), sizeof event);
    return 0;
}

int drmIsMaster(int card)
{
    (void)card;
    return kms_kernel.master;
}

int drmSetMaster(int card)
{
    (void)card;
    return kms_kernel.master ? 0 : -1;
}

drmModeConnector *drmModeGetConnector(int card, uint32_t id)
{
    (void)card;
    (void)id;
    drmModeConnector *connector = test_calloc(1, sizeof *connector);
    connector->connection = DRM_MODE_CONNECTED;
    connector->count_modes = 1;
    connector->modes = &kms_kernel.mode;
    return connector;
}

void drmModeFreeConnector(drmModeConnector *connector)
{
    test_free(connector);
}

void kms_kernel_set_status(const char *text)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(&scratch, "status", path);
    scratch_write(path, text, strlen(text));
    kms_display.looked_ns = 0; /* it is time to look again */
    kms_display.lit_ns = 0;
}

int kms_kernel_set_up(void **state)
{
    static uint8_t pixels[KMS_BUFFERS][KMS_KERNEL_WIDTH * KMS_KERNEL_HEIGHT * 4];
    (void)state;
    scratch_open(&scratch);
    memset(&kms_kernel, 0, sizeof kms_kernel);
    kms_kernel.now_ns = 3600 * SECOND_NS;
    kms_kernel.blanks = kms_kernel.at_once = kms_kernel.master = true;
    kms_kernel.mode = (drmModeModeInfo){
        .clock = 1200, .hdisplay = KMS_KERNEL_WIDTH, .htotal = 200, .vdisplay = KMS_KERNEL_HEIGHT, .vtotal = 100};
    kms_kernel.time_ns = clock_monotonic_ns();
    assert_int_equal(pipe2(kms_kernel.events, O_NONBLOCK | O_CLOEXEC), 0);
    kms_display = (hal_display_t){
        .card = {.file = kms_kernel.events[0]},
        .wanted = {KMS_KERNEL_WIDTH, KMS_KERNEL_HEIGHT, 60, 1},
        .buffers = {.width = KMS_KERNEL_WIDTH, .height = KMS_KERNEL_HEIGHT, .pitch = KMS_KERNEL_WIDTH * 4},
        .flying = KMS_NO_BUFFER,
        .waiting = KMS_NO_BUFFER,
        .borrowed = KMS_NO_BUFFER,
    };
    for (uint32_t i = 0; i < KMS_BUFFERS; i++) {
        kms_display.buffers.buffer[i].data = pixels[i];
        kms_display.buffers.buffer[i].framebuffer[PICTURE_XRGB8888] = 1 + i;
        kms_display.buffers.buffer[i].framebuffer[PICTURE_NV12] = KMS_KERNEL_NV12 + i;
    }
    kms_blank_init(&kms_display.blank, PERIOD_NS, kms_kernel.time_ns, 0);
    char path[SCRATCH_PATH_LENGTH];
    kms_kernel_set_status("connected\n");
    scratch_path(&scratch, "status", path);
    kms_display.status = open(path, O_RDONLY | O_CLOEXEC);
    assert_true(kms_display.status >= 0);
    return 0;
}

int kms_kernel_tear_down(void **state)
{
    (void)state;
    close(kms_display.status);
    close(kms_kernel.events[0]);
    close(kms_kernel.events[1]);
    scratch_close(&scratch);
    return 0;
}

uint32_t kms_kernel_show(hal_status_t expected)
{
    picture_t buffer;
    assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_XRGB8888, PICTURE_BT709, &buffer), HAL_OK);
    const uint32_t framebuffer = (uint32_t)kms_display.borrowed + 1;
    assert_ptr_equal(buffer.data[0], kms_display.buffers.buffer[kms_display.borrowed].data);
    assert_int_equal(hal_display_present(&kms_display), expected);
    return framebuffer;
}
