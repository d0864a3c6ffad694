// SPDX-License-Identifier: Apache-2.0
// Which step of its ladder a board can hold: down before pictures are late, and back up without flicker.
//
// A step is a method; step 0 is the one that is wanted, each further one costs less (ladder.h). What a frame would take
// with another step is expected from its cost there, times what a unit of cost takes on this board: measured on every
// frame, median of three, then a running mean over 8. Costs may be wrong: when a return fails within a second, its step
// is taken to cost as much more as it did then, and half of that after every 10 minutes. Of the period P, the time that
// there is for a frame:
//
//   down  after 8 frames in a row whose expected time is above 90 % of P; or at once when two pictures of 8 were late,
//         or three of 72; to the best step that is expected to take at most 80 % of P, or to the last. A single late
//         picture is no reason: what the system did in that moment no method can mend;
//   up    when a better step has been expected to take at most 80 % of P in every frame for the hold-off time:
//         to the worst of these in the second half of it.
//
// The hold-off is 4 s at first. A return that is followed by a step down within 10 minutes has failed: the hold-off
// doubles, up to 512 s; for every 10 minutes that a return has lasted it halves. So a load that swings about the limit
// is met by 13 returns in the first hour and 7 in each hour after, and no return comes within 4 s of another change.
#ifndef FIRMWARE_DEGRADE_H
#define FIRMWARE_DEGRADE_H

#include <stdbool.h>
#include <stdint.h>

enum {
    DEGRADE_MAX_STEPS = 5,
    DEGRADE_MIN_HOLD_S = 4,
    DEGRADE_MAX_HOLD_S = 512,
    DEGRADE_WARM_UP = 8 /**< frames after the start that are not judged: their memory is touched for the first time */
};

/** A frame that was made and shown. Times are in us, from 0 to an hour. */
typedef struct {
    int64_t busy_us;                  /**< from the step's begin until the picture was handed to the display */
    int64_t warp_us;                  /**< of that, what depends on the method */
    int64_t time_us;                  /**< there was: from the step's begin to the vertical blank */
    bool late;                        /**< the blank was missed */
    uint32_t cost[DEGRADE_MAX_STEPS]; /**< of this frame with every step, 1 to 2^28, in any unit */
} degrade_frame_t;

typedef struct {
    int32_t steps, step;
    uint32_t changes;
    int64_t hold_us;
    int64_t wanted_us; /**< what step 0 was expected to take for the newest frame */

    int64_t unit_q16[3];   /**< us per unit of cost in the last frames, up to 2^31 */
    int64_t mean_q16;      /**< of their medians */
    int64_t frames;        /**< seen */
    int64_t longest_us[2]; /**< time for a frame: the longest in this second or so, and in the one before */
    int32_t over;          /**< frames in a row above the limit */
    int32_t misses;        /**< late pictures, each worth 64 and then less by one a frame */
    int32_t candidate;     /**< step to return to */
    int64_t candidate_us;  /**< for so long there has been one */
    int32_t dearer_q8[DEGRADE_MAX_STEPS]; /**< than stated is each step by that factor; 256 at first, up to 1024 */
    int64_t since_learned_us;
    int64_t returned_q16; /**< us per unit of cost at the last return */
    bool returned;        /**< the last change was a return */
    int64_t since_return_us;
} degrade_t;

/** Begin at step 0 of `steps`, 1 to DEGRADE_MAX_STEPS. */
void degrade_init(degrade_t *degrade, int32_t steps);

/** Take note of a frame made with the present step. @return The step to make the next one with, also degrade->step. */
int32_t degrade_next(degrade_t *degrade, const degrade_frame_t *frame);

#endif
