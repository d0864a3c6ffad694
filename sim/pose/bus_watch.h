// SPDX-License-Identifier: Apache-2.0
// Looks at the frames of a bus as they come: poses, time, boards, load; for `wallwarp-pose monitor` and `check`.
#ifndef SIM_POSE_BUS_WATCH_H
#define SIM_POSE_BUS_WATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/bus_master.h"
#include "firmware/can_counts.h"
#include "firmware/can_latency.h"
#include "firmware/can_protocol.h"
#include "firmware/can_update.h"
#include "firmware/pose_from_can.h"
#include "sim/pose/step_watch.h"

enum { BUS_WATCH_WINDOW_US = 1000000 };

/** Times between events of one kind. */
typedef struct {
    int64_t count;   /**< events */
    int64_t last_us; /**< of the newest; unspecified while count is 0 */
    int64_t longest_us;
    double sum_us, sum_of_squares; /**< of the count - 1 intervals */
} bus_watch_rhythm_t;

/** One viewer's poses. */
typedef struct {
    can_poses_t receiver; /**< the one of the boards; its newest pose is the viewer's */
    can_faults_t faults;  /**< as a board would count them */
    bus_watch_rhythm_t poses;
    bool fd, set;              /**< which messages were heard */
    int64_t capture_us;        /**< of the newest pose, as sent, unwrapped from the first one on */
    int64_t captured_back;     /**< poses captured before the one ahead of them */
    bool captured;             /**< capture times differ: the tracker gives them */
    int64_t least_us, most_us; /**< arrival minus capture; their difference is the delay's jitter */
    int64_t delays;            /**< poses captured and come at known moments of bus time; while 0, unspecified: */
    int64_t delay_sum_us, delay_most_us; /**< from capture to arrival */
} bus_watch_viewer_t;

/** One board's reports. */
typedef struct {
    bus_watch_rhythm_t heartbeats;
    bool has_status, has_quality;
    can_heartbeat_t heartbeat; /**< the newest of each */
    can_status_t status;
    can_quality_t quality;
    int64_t restarts; /**< times its uptime went back */
    bool has_time;
    can_time_t time;        /**< the newest, */
    can_step_t step;        /**< and of these: unspecified while steps is 0 */
    int64_t steps, in_step; /**< Steps, and those of them that say so */
    bool has_latency, has_counts, has_update;
    can_latency_t latency;
    can_update_t update;
    can_counts_t counts, first_counts; /**< the newest, and the first that was heard since the board's start */
} bus_watch_board_t;

/** The pairs of Sync and FollowUp. */
typedef struct {
    bus_watch_rhythm_t pairs; /**< whole ones */
    uint8_t master, origin;   /**< of the newest; unspecified while pairs.count is 0 */
    int64_t changes;          /**< of the master */
    int64_t alone;            /**< Syncs without FollowUp, those of boards that are about to take over among them */
    uint8_t origins[CAN_MAX_NODE + 1]; /**< the watch's own: of each number's newest Sync, */
    int8_t awaited[CAN_MAX_NODE + 1];  /**< and one more than its counter as long as it is alone */
} bus_watch_time_t;

/** All zero but for the bit rates is a watch that has heard nothing; see bus_watch_init(). */
typedef struct {
    int32_t bitrate, data_bitrate; /**< bit/s */
    int64_t frames;                /**< heard */
    int64_t first_us, last_us;     /**< unspecified while frames is 0 */
    int64_t damaged;               /**< known messages with a wrong length, CRC or value, poses left out */
    int64_t unknown;               /**< frames that are none of wallwarp.dbc's */
    int64_t errors;                /**< bus errors reported by the controller */
    double busy_us;                /**< time that the wire was taken, since first_us */
    double window_busy_us;         /**< in the current window */
    int64_t window_start_us;
    int32_t load_ppm, worst_load_ppm; /**< of the last whole window, of the fullest one; -1: none is whole yet */
    bus_watch_viewer_t viewer[CAN_VIEWERS];
    bus_watch_time_t time;
    bus_master_t clock; /**< the watch's own: bus time over the clock that stamps the frames */
    step_watch_t steps;
    bool has_frame_clock;
    can_frame_clock_t frame_clock;             /**< the newest that holds */
    bus_watch_board_t board[CAN_MAX_NODE + 1]; /**< by node number */
} bus_watch_t;

/** Begin to watch a bus of these bit rates, bit/s. */
void bus_watch_init(bus_watch_t *watch, int32_t bitrate, int32_t data_bitrate);

/** Take a frame; times never go back by more than the bus's jitter. */
void bus_watch_take(bus_watch_t *watch, const hal_can_frame_t *frame);

/** @return Has the board sent anything? */
bool bus_watch_heard(const bus_watch_board_t *board);

/** @return Mean interval, us; 0 with fewer than two events. */
double bus_watch_mean_us(const bus_watch_rhythm_t *rhythm);

/** @return Standard deviation of the intervals, us; 0 with fewer than two events. */
double bus_watch_jitter_us(const bus_watch_rhythm_t *rhythm);

#endif
