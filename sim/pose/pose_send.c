// SPDX-License-Identifier: Apache-2.0
// Sends a pose list onto a bus at its own pace.
#include "sim/pose/pose_send.h"

#include <stdio.h>
#include <time.h>

#include "sim/devices/sim_clock.h"
#include "sim/pose/pose_frames.h"
#include "sim/pose/sync_send.h"

enum { PROGRESS_EVERY_US = 250000, LONGEST_SLEEP_US = 100000, NS_PER_US = 1000, US_PER_S = 1000000 };

/* Two heartbeats of every board. */
enum { ANNOUNCE_US = 2 * CAN_HEARTBEAT_PERIOD_MS * 1000 };

/* In short sleeps: a signal between the look at stop and the sleep would be slept over, and boards want their session.
 * @return false when the link failed. */
static bool sleep_until_us(int64_t time_us, const pose_send_t *send, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const int64_t longest_us = send->auth == NULL ? LONGEST_SLEEP_US : POSE_AUTH_TURN_US;
    int64_t now_us = sim_clock_monotonic_us();
    for (; now_us < time_us && !*send->stop; now_us = sim_clock_monotonic_us()) {
        const int64_t end_us = time_us - now_us > longest_us ? now_us + longest_us : time_us;
        const struct timespec when = {.tv_sec = (time_t)(end_us / US_PER_S),
                                      .tv_nsec = (long)(end_us % US_PER_S) * NS_PER_US};
        (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, NULL);
        if (send->auth != NULL && !pose_auth_turn(send->auth, error))
            return false;
    }
    return true;
}

/* Sleep until then, and give bus time meanwhile. @return false when the link failed. */
static bool wait_until_us(int64_t time_us, pose_link_t *link, const pose_send_t *send, sync_send_t *sync,
                          char error[POSE_LINK_MESSAGE_LENGTH])
{
    while (send->sync && !*send->stop && sync->due_us <= time_us) {
        if (!sleep_until_us(sync->due_us, send, error) || (!*send->stop && !sync_send(sync, link, error)))
            return false;
    }
    return sleep_until_us(time_us, send, error);
}

static int encode(hal_can_frame_t frame[POSE_AUTH_FRAMES], const pose_t *pose, const pose_send_t *send, int64_t time_us,
                  uint64_t number)
{
    const can_pose_t message = {.pose = *pose,
                                .capture_time_us = (uint64_t)time_us,
                                .quality = CAN_POSE_TRACKED,
                                .viewer = send->viewer,
                                .tracker = send->tracker};
    return pose_frames(frame, &message, send->fd, number);
}

bool pose_send_check(const pose_send_t *send, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const pose_list_t *list = send->list;
    hal_can_frame_t frame[POSE_AUTH_FRAMES];
    for (size_t i = 0; i < list->count; i++) {
        if (encode(frame, &list->entry[i].pose, send, 0, 0) > 0)
            continue;
        snprintf(error, POSE_LINK_MESSAGE_LENGTH,
                 "pose %zu: farther than 83.886 m from the origin, which three classic frames cannot say; use --fd",
                 i + 1);
        return false;
    }
    return true;
}

static void show(size_t sent, const pose_list_t *list, int64_t since_us)
{
    const int64_t length_us = list->entry[list->count - 1].time_us - list->entry[0].time_us;
    fprintf(stderr, "\r%zu of %zu poses, %.1f of %.1f s ", sent, list->count, (double)since_us / US_PER_S,
            (double)length_us / US_PER_S);
}

bool pose_send_list(pose_link_t *link, const pose_send_t *send, size_t *sent, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const pose_list_t *list = send->list;
    sync_send_t sync = {.auth = send->auth};
    *sent = 0;
    if (send->sync && !sync_send_begin(&sync, link, error))
        return false;
    const int64_t start_us = sim_clock_monotonic_us() + (send->auth == NULL ? 0 : ANNOUNCE_US);
    int64_t shown_us = start_us;
    for (; *sent < list->count; ++*sent) {
        const pose_list_entry_t *entry = &list->entry[*sent];
        if (!wait_until_us(start_us + entry->time_us - list->entry[0].time_us, link, send, &sync, error))
            return false;
        if (*send->stop)
            break;
        const int64_t time_us = sim_clock_monotonic_us();
        hal_can_frame_t frame[POSE_AUTH_FRAMES];
        const int plain = encode(frame, &entry->pose, send, time_us, (uint64_t)start_us + *sent);
        const int frames = pose_auth_sign_pose(send->auth, frame, plain, send->viewer, (uint64_t)time_us);
        if (!pose_link_send(link, frame, frames, error))
            return false;
        if (send->show_progress && time_us - shown_us >= PROGRESS_EVERY_US) {
            show(*sent + 1, list, time_us - start_us);
            shown_us = time_us;
        }
    }
    if (send->show_progress)
        fprintf(stderr, "\r%60s\r", "");
    return true;
}
