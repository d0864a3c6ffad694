// SPDX-License-Identifier: Apache-2.0
// What an open display keeps, and how its dark times end.
#include "hal/linux/display_kms_state.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <xf86drm.h>

#include "hal/linux/clocks.h"

static const int64_t LOOK_NS = 50000000, RETRY_NS = 500000000;

kms_scan_t kms_state_scan(const hal_display_t *display, int32_t buffer)
{
    const kms_look_t look = display->look[buffer];
    return (kms_scan_t){display->buffers.buffer[buffer].framebuffer[look.format], look.format, look.matrix};
}

int kms_state_watch(hal_display_t *display)
{
    char path[80];
    (void)snprintf(path, sizeof path, "/sys/class/drm/card%d-%s/status", display->card.number,
                   display->card.connector_name);
    display->status = open(path, O_RDONLY | O_CLOEXEC);
    return display->status < 0 ? errno : 0;
}

/* The kernel's own knowledge, kept up by the projector's hot-plug line: no question to the projector. */
static bool is_connected(const hal_display_t *display)
{
    static const char expected[] = "connected";
    char state[sizeof expected];
    const ssize_t length = pread(display->status, state, sizeof state, 0);
    return length >= (ssize_t)strlen(expected) && memcmp(state, expected, strlen(expected)) == 0;
}

/* Of a driver without vertical blanks there is no sequence to ask for. */
static void begin_blanks(hal_display_t *display, int64_t period_ns)
{
    uint64_t sequence = 0, time_ns = 0;
    display->by_clock = drmCrtcGetSequence(display->card.file, display->pipe.screen.crtc, &sequence, &time_ns) != 0;
    kms_blank_init(&display->blank, period_ns, time_ns == 0 ? clock_monotonic_ns() : (int64_t)time_ns,
                   (uint32_t)sequence);
}

static int32_t newest_buffer(const hal_display_t *display)
{
    if (display->waiting != KMS_NO_BUFFER)
        return display->waiting;
    return display->flying != KMS_NO_BUFFER ? display->flying : display->shown;
}

int kms_state_light(hal_display_t *display, const drmModeConnector *connector)
{
    const int32_t mode = kms_mode_choose(connector->modes, connector->count_modes, &display->wanted);
    if (mode == KMS_NO_MODE)
        return ENOENT;
    const int32_t newest = newest_buffer(display);
    const kms_scan_t scan = kms_state_scan(display, newest);
    int failure = kms_pipe_set_mode(&display->pipe, &connector->modes[mode]);
    if (failure == 0)
        failure = kms_pipe_light(&display->pipe, &scan);
    if (failure != 0)
        return failure;
    display->shown = newest;
    display->flying = display->waiting = KMS_NO_BUFFER;
    display->dark = display->hangs = false;
    begin_blanks(display, kms_mode_period_ns(&connector->modes[mode]));
    return 0;
}

/* Be the display's owner again, if that was lost, and light what is connected now. */
static void try_to_light(hal_display_t *display)
{
    if (!drmIsMaster(display->card.file) && drmSetMaster(display->card.file) != 0)
        return;
    drmModeConnector *connector = drmModeGetConnector(display->card.file, display->card.connector);
    if (connector != NULL && connector->connection == DRM_MODE_CONNECTED && kms_pipe_darken(&display->pipe) == 0)
        (void)kms_state_light(display, connector); /* on failure it stays dark until the next try */
    drmModeFreeConnector(connector);
}

void kms_state_look(hal_display_t *display, int64_t now_ns)
{
    if (now_ns - display->looked_ns < LOOK_NS)
        return;
    display->looked_ns = now_ns;
    const bool connected = is_connected(display);
    if (!connected)
        display->dark = true;
    if (!connected || !display->dark || now_ns - display->lit_ns < RETRY_NS)
        return;
    display->lit_ns = now_ns;
    try_to_light(display);
}
