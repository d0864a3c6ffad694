// SPDX-License-Identifier: Apache-2.0
// Sends what a log or another bus says, in its own time, with faults when asked.
#include "sim/pose/bus_pump.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "firmware/can_frame_clock.h"
#include "sim/bus/candump_text.h"
#include "sim/devices/sim_clock.h"
#include "sim/files/file_io.h"

enum { MILLION = 1000000, US_PER_MS = 1000, LONGEST_WAIT_US = 100000, MOST_TURNED_BITS = 3 };

/* A frame that waits for its time. */
typedef struct {
    int64_t due_us;
    hal_can_frame_t frame;
} pending_t;

/* The source at work. */
typedef struct {
    const bus_pump_t *pump;
    bus_pump_counts_t *counts;
    pose_link_t to, from;
    FILE *log;
    char *line; /* of getline() */
    size_t line_size;
    long line_number;
    bool has_next, ended; /* of the log */
    hal_can_frame_t next; /* of the log */
    int64_t log_start_us; /* time of the log's first frame */
    int64_t start_us;     /* when it was sent */
    rng_t rng;
    int pending_count;
    pending_t pending[BUS_PUMP_PENDING]; /* the next to be sent is the last */
} work_t;

static bool strikes(rng_t *rng, int32_t ppm)
{
    return (int32_t)(rng_next(rng) % MILLION) < ppm;
}

static void turn_bits(hal_can_frame_t *frame, rng_t *rng)
{
    for (uint64_t bits = 1 + rng_next(rng) % MOST_TURNED_BITS; bits > 0; bits--) {
        const uint64_t bit = rng_next(rng) % ((uint64_t)frame->length * 8);
        frame->data[bit / 8] ^= (uint8_t)(1U << bit % 8);
    }
}

int bus_pump_strike(const bus_faults_t *faults, rng_t *rng, hal_can_frame_t *frame, bus_pump_counts_t *counts,
                    bool *late)
{
    /* Every chance is taken for every frame, so that one kind of fault does not move the others. */
    const bool drop = strikes(rng, faults->drop_ppm), twice = strikes(rng, faults->duplicate_ppm),
               corrupt = strikes(rng, faults->corrupt_ppm), delay = strikes(rng, faults->delay_ppm);
    if (drop) {
        counts->dropped++;
        return 0;
    }
    if (corrupt && frame->length > 0) {
        turn_bits(frame, rng);
        counts->corrupted++;
    }
    counts->duplicated += twice;
    counts->delayed += delay;
    *late = delay;
    return twice ? 2 : 1;
}

static bool send_next(work_t *work, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    work->counts->sent++;
    return pose_link_send(&work->to, &work->pending[--work->pending_count].frame, 1, error);
}

/* Room is made by sending what is next before its time. */
static bool put_pending(work_t *work, const hal_can_frame_t *frame, int64_t due_us, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    if (work->pending_count == BUS_PUMP_PENDING && !send_next(work, error))
        return false;
    int at = work->pending_count++;
    for (; at > 0 && work->pending[at - 1].due_us <= due_us; at--)
        work->pending[at] = work->pending[at - 1];
    work->pending[at] = (pending_t){due_us, *frame};
    return true;
}

/* What nodes on the bus send themselves: reports, bus time and numbers of refreshes, which would be those of another
 * day. */
static bool is_left_out(const hal_can_frame_t *frame)
{
    const bool is_time = frame->id >= CAN_ID_SYNC && frame->id <= CAN_ID_FOLLOW_UP + CAN_MAX_NODE;
    const bool is_clock = frame->id >= CAN_ID_FRAME_CLOCK && frame->id <= CAN_ID_FRAME_CLOCK + CAN_MAX_NODE;
    return !frame->extended && (frame->id >= CAN_ID_STATUS || is_time || is_clock);
}

static bool take(work_t *work, hal_can_frame_t *frame, int64_t due_us, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    const bus_pump_t *pump = work->pump;
    if ((frame->fd && !pump->fd) || (is_left_out(frame) && !pump->reports))
        return true;
    work->counts->taken++;
    bool late = false;
    for (int n = bus_pump_strike(&pump->faults, &work->rng, frame, work->counts, &late); n > 0; n--)
        if (!put_pending(work, frame, due_us + (late ? pump->faults.delay_ms * US_PER_MS : 0), error))
            return false;
    return true;
}

/* The log's next frame; empty lines are passed over. @return false with the reason when a line is none. */
static bool read_log(work_t *work, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    work->has_next = false;
    while (getline(&work->line, &work->line_size, work->log) >= 0) {
        char interface[CANDUMP_INTERFACE_LENGTH];
        work->line_number++;
        if (work->line[strspn(work->line, " \t\r\n")] == '\0')
            continue;
        const char *expected = candump_frame_from_text(&work->next, interface, work->line);
        if (expected != NULL) {
            snprintf(error, BUS_PUMP_MESSAGE_LENGTH, "%.200s:%ld: expected %s", work->pump->log, work->line_number,
                     expected);
            return false;
        }
        work->has_next = true;
        return true;
    }
    work->ended = true;
    if (ferror(work->log) == 0)
        return true;
    snprintf(error, BUS_PUMP_MESSAGE_LENGTH, "%.200s: cannot be read on", work->pump->log);
    return false;
}

static int64_t due_of_next_us(const work_t *work)
{
    return work->start_us + (int64_t)((double)(work->next.time_us - work->log_start_us) / work->pump->speed);
}

/* Wait for the source, and take what it has. @return false when it has failed. */
static bool hear_log(work_t *work, int64_t wait_us, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    const int64_t now_us = sim_clock_monotonic_us();
    if (work->has_next && due_of_next_us(work) <= now_us)
        return take(work, &work->next, due_of_next_us(work), error) && read_log(work, error);
    if (work->has_next && due_of_next_us(work) - now_us < wait_us)
        wait_us = due_of_next_us(work) - now_us;
    const struct timespec nap = {.tv_nsec = wait_us * 1000};
    nanosleep(&nap, NULL);
    return true;
}

static bool hear_bus(work_t *work, int64_t wait_us, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    hal_can_frame_t frame;
    switch (pose_link_receive(&work->from, &frame, (int)(wait_us / US_PER_MS), error)) {
    case POSE_LINK_FRAME:
        return take(work, &frame, sim_clock_monotonic_us(), error);
    case POSE_LINK_ENDED:
        work->ended = true;
        return true;
    case POSE_LINK_ERROR:
    case POSE_LINK_QUIET:
        break;
    }
    return true;
}

static bool run(work_t *work, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    work->start_us = sim_clock_monotonic_us();
    work->log_start_us = work->has_next ? work->next.time_us : 0;
    while (!*work->pump->stop && (!work->ended || work->pending_count > 0)) {
        const int64_t now_us = sim_clock_monotonic_us();
        const pending_t *next = work->pending_count > 0 ? &work->pending[work->pending_count - 1] : NULL;
        /* in the order of their times, however late this program itself is */
        const bool overtaken = work->has_next && next != NULL && due_of_next_us(work) <= next->due_us;
        if (next != NULL && next->due_us <= now_us && !overtaken) {
            if (!send_next(work, error))
                return false;
            continue;
        }
        const int64_t wait_us =
            next != NULL && next->due_us - now_us < LONGEST_WAIT_US ? next->due_us - now_us : LONGEST_WAIT_US;
        if (!(work->log != NULL || work->ended ? hear_log(work, wait_us, error) : hear_bus(work, wait_us, error)))
            return false;
    }
    return true;
}

/* What it leaves open when it fails, close_source() closes. */
static bool open_source(work_t *work, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    const bus_pump_t *pump = work->pump;
    work->from.socket = -1;
    if (pump->log == NULL)
        return pose_link_open(&work->from, pump->from, false, error) && pose_link_listen(&work->from, error);
    int64_t size = 0;
    work->log = file_open(pump->log, &size, error);
    return work->log != NULL && read_log(work, error);
}

static void close_source(work_t *work)
{
    if (work->from.socket >= 0)
        pose_link_close(&work->from);
    if (work->log != NULL)
        fclose(work->log);
    free(work->line);
}

bool bus_pump(const bus_pump_t *pump, bus_pump_counts_t *counts, char error[BUS_PUMP_MESSAGE_LENGTH])
{
    *counts = (bus_pump_counts_t){.taken = 0};
    work_t *work = calloc(1, sizeof *work);
    if (work == NULL) {
        snprintf(error, BUS_PUMP_MESSAGE_LENGTH, "out of memory");
        return false;
    }
    work->pump = pump;
    work->counts = counts;
    work->rng = (rng_t){pump->seed};
    bool ok = open_source(work, error) && pose_link_open(&work->to, pump->bus, pump->fd, error);
    if (ok) {
        ok = run(work, error);
        pose_link_close(&work->to);
    }
    close_source(work);
    free(work);
    return ok;
}
