// SPDX-License-Identifier: Apache-2.0
// Hears a tracker over UDP and sends its poses onto a bus.
#include "sim/pose/bridge_run.h"

#include <errno.h>
#include <inttypes.h>
#include <poll.h>
#include <string.h>

#include "sim/devices/sim_clock.h"
#include "sim/pose/pose_frames.h"
#include "sim/pose/sync_send.h"
#include "sim/pose/udp_listen.h"

enum { LOOK_MS = 100, PROGRESS_EVERY_US = 1000000 };

static void show(const bridge_run_t *run)
{
    const bridge_counts_t *counts = &run->bridge->counts;
    uint64_t refused = 0;
    for (int c = 0; c < TRACKER_CHECKS; c++)
        refused += counts->refused[c];
    fprintf(stderr, "\r%" PRIu64 " packets, %" PRIu64 " poses sent, %" PRIu64 " refused ", counts->packets, run->sent,
            refused);
}

static bool send_poses(bridge_run_t *run, const can_pose_t *message, int count, uint64_t next[CAN_VIEWERS],
                       char error[POSE_LINK_MESSAGE_LENGTH])
{
    for (int i = 0; i < count; i++) {
        hal_can_frame_t frame[POSE_AUTH_FRAMES];
        const int plain = pose_frames(frame, &message[i], run->fd, next[message[i].viewer]);
        const int frames =
            pose_auth_sign_pose(run->auth, frame, plain, message[i].viewer, (uint64_t)sim_clock_monotonic_us());
        if (frames == 0) {
            run->bridge->counts.too_far++;
            continue;
        }
        if (!pose_link_send(run->link, frame, frames, error))
            return false;
        next[message[i].viewer]++;
        run->sent++;
    }
    return true;
}

/* @return false when it has failed. */
static bool take_packet(bridge_run_t *run, uint64_t next[CAN_VIEWERS], char error[POSE_LINK_MESSAGE_LENGTH])
{
    uint8_t bytes[TRACKER_MAX_PACKET];
    can_pose_t message[TRACKER_MAX_POSES];
    int64_t arrived_us = 0;
    const ssize_t size = udp_listen_take(run->listener, bytes, sizeof bytes, &arrived_us);
    if (size < 0) {
        if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)
            return true;
        snprintf(error, POSE_LINK_MESSAGE_LENGTH, "the tracker's socket: %s", strerror(errno));
        return false;
    }
    const int count = bridge_packet(run->bridge, bytes, (size_t)size, arrived_us, message);
    return send_poses(run, message, count, next, error);
}

/* Wait for the tracker, until bus time is due again. @return false when it has failed. */
static bool turn(bridge_run_t *run, sync_send_t *sync, uint64_t next[CAN_VIEWERS], char error[POSE_LINK_MESSAGE_LENGTH])
{
    int64_t wait_ms = LOOK_MS;
    if (run->sync) {
        if (!sync_send(sync, run->link, error))
            return false;
        const int64_t due_ms = (sync->due_us - sim_clock_monotonic_us()) / 1000 + 1;
        wait_ms = due_ms < 0 ? 0 : due_ms < LOOK_MS ? due_ms : LOOK_MS;
    }
    if (run->auth != NULL) {
        if (!pose_auth_turn(run->auth, error))
            return false;
        wait_ms = wait_ms < POSE_AUTH_TURN_US / 1000 ? wait_ms : POSE_AUTH_TURN_US / 1000;
    }
    struct pollfd tracker = {.fd = run->listener, .events = POLLIN};
    return poll(&tracker, 1, (int)wait_ms) <= 0 || take_packet(run, next, error);
}

bool bridge_run(bridge_run_t *run, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const int64_t start_us = sim_clock_monotonic_us();
    int64_t now_us = start_us, shown_us = start_us;
    sync_send_t sync = {.auth = run->auth};
    uint64_t next[CAN_VIEWERS];
    /* A bridge started twice is not taken for a repetition. */
    for (int v = 0; v < CAN_VIEWERS; v++)
        next[v] = (uint64_t)start_us;
    run->sent = 0;
    if (run->sync && !sync_send_begin(&sync, run->link, error))
        return false;
    while (!*run->stop && (run->duration_us == 0 || now_us - start_us < run->duration_us)) {
        if (!turn(run, &sync, next, error))
            return false;
        now_us = sim_clock_monotonic_us();
        if (run->show_progress && now_us - shown_us >= PROGRESS_EVERY_US) {
            show(run);
            shown_us = now_us;
        }
    }
    if (run->show_progress)
        fprintf(stderr, "\r%70s\r", "");
    return true;
}
