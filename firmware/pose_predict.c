// SPDX-License-Identifier: Apache-2.0
// Pose history -> where the viewer's eye is, and how it looks, at a time that is yet to come.
#include "firmware/pose_predict.h"

#include <stddef.h>

#include "firmware/parabola_fit.h"
#include "firmware/quaternion.h"
#include "warp_fixed/real_vector.h"

/* Time 0 of the parabolas: the middle of the window, before the pose that they are to go on from. */
enum { MIDDLE_US = POSE_PREDICT_WINDOW_US / 2 };

/* How far the viewer has gone and turned from a pose, as rotation vector in the frame of that pose. */
typedef struct {
    int64_t step_nm[3], turn_q30[3];
} motion_t;

/* Sums of a trial's predicted motion times what came of it, and of its square. */
typedef struct {
    real_t agrees, size;
} trust_t;

/* The lead that counts: beyond POSE_PREDICT_FULL_US speed falls evenly to 0 at POSE_PREDICT_STILL_US. */
static int32_t faded_lead_us(int64_t lead_us)
{
    enum { FADE_US = POSE_PREDICT_STILL_US - POSE_PREDICT_FULL_US };
    const int64_t lead = clamp_i64(lead_us, 0, POSE_PREDICT_STILL_US);
    if (lead <= POSE_PREDICT_FULL_US)
        return (int32_t)lead;
    const int64_t faded = lead - POSE_PREDICT_FULL_US;
    return (int32_t)(lead - faded * faded / (2 * FADE_US));
}

static void motion_between(motion_t *motion, const pose_t *from, const pose_t *to)
{
    for (int i = 0; i < 3; i++)
        motion->step_nm[i] = to->eye_nm[i] - from->eye_nm[i];
    quaternion_between(motion->turn_q30, from->quaternion_q30, to->quaternion_q30);
}

/* The newest pose of a time or before it, from one on, in its run. @return How far back; -1 when there is none. */
static int32_t find_back(const pose_history_t *history, int32_t back, int64_t time_us)
{
    for (; back < POSE_HISTORY_POSES; back++) {
        const pose_at_t *at = pose_history_back(history, back);
        if (at == NULL)
            return -1;
        if (at->time_us <= time_us)
            return back;
        if (at->begins_run)
            return -1;
    }
    return -1;
}

/* From a pose on, with only what was known then. @return false when that was too little. */
static bool predict_motion(motion_t *motion, const pose_history_t *history, int32_t back, int32_t lead_us)
{
    const pose_at_t *last = pose_history_back(history, back);
    parabola_sums_t position = {.count = 0}, turn = {.count = 0};
    for (; back < POSE_HISTORY_POSES; back++) {
        const pose_at_t *at = pose_history_back(history, back);
        if (at == NULL || last->time_us - at->time_us > POSE_PREDICT_WINDOW_US)
            break;
        /* Bounds: what pose_history.h allows in 110 ms and 256 steps, 6.3 m and half a turn, is below 2^33. */
        motion_t to;
        motion_between(&to, &last->pose, &at->pose);
        const int32_t time_us = (int32_t)(at->time_us - last->time_us) + MIDDLE_US;
        parabola_add(&position, time_us, to.step_nm);
        parabola_add(&turn, time_us, to.turn_q30);
        if (at->begins_run)
            break;
    }
    parabola_ask_t ask = {.time_us = MIDDLE_US + lead_us,
                          .farthest_us = MIDDLE_US + POSE_PREDICT_FULL_US,
                          .noise = POSE_PREDICT_NOISE_NM};
    if (!parabola_at(&position, &ask, motion->step_nm))
        return false;
    ask.noise = POSE_PREDICT_NOISE_Q30;
    return parabola_at(&turn, &ask, motion->turn_q30); /* at the same times: as known as the position */
}

static void add_trial(trust_t *trust, const int64_t predicted[3], const int64_t came[3])
{
    real_t p[3], c[3];
    for (int i = 0; i < 3; i++) {
        p[i] = real_from_int(predicted[i], 0);
        c[i] = real_from_int(came[i], 0);
    }
    trust->agrees = real_add(trust->agrees, vector_dot(p, c));
    trust->size = real_add(trust->size, vector_dot(p, p));
}

/* Predict again, over this lead, what has come since. */
static void try_on_the_past(trust_t *position, trust_t *turn, const pose_history_t *history, int32_t lead_us)
{
    enum { TRIALS = 8, BETWEEN_US = 33000 };
    const int64_t newest_us = pose_history_back(history, 0)->time_us;
    int32_t target = 0;
    for (int n = 0; n < TRIALS; n++) {
        target = find_back(history, target, newest_us - n * BETWEEN_US);
        if (target < 0)
            return;
        const pose_at_t *to = pose_history_back(history, target);
        const int32_t start = find_back(history, target, to->time_us - (lead_us > 0 ? lead_us : 1));
        if (start < 0)
            return;
        const pose_at_t *from = pose_history_back(history, start);
        motion_t predicted, came;
        if (!predict_motion(&predicted, history, start, (int32_t)(to->time_us - from->time_us)))
            return;
        motion_between(&came, &from->pose, &to->pose);
        add_trial(position, predicted.step_nm, came.step_nm);
        add_trial(turn, predicted.turn_q30, came.turn_q30);
    }
}

/* Keep of a prediction the part that would have been best for the trials, as long as they say more than noise. */
static void keep_trusted(int64_t predicted[3], const trust_t *trust, int64_t noise)
{
    enum { SILENT_TRIALS = 50 }; /* as if so many components of noise had been right */
    const real_t square = real_mul(real_from_int(noise, 0), real_from_int(noise, 0));
    const real_t silent = real_mul(real_from_int(SILENT_TRIALS, 0), square);
    const real_t agrees = real_add(trust->agrees, silent), size = real_add(trust->size, silent);
    if (!real_less(agrees, size))
        return;
    const real_t part = real_sign(agrees) > 0 ? real_div(agrees, size) : real_from_int(0, 0);
    for (int i = 0; i < 3; i++)
        predicted[i] = real_to_fixed(real_mul(part, real_from_int(predicted[i], 0)), 0, INT64_MAX);
}

pose_predict_t pose_predict(const pose_history_t *history, int64_t time_us, pose_t *pose)
{
    const pose_at_t *newest = pose_history_back(history, 0);
    if (newest == NULL)
        return POSE_PREDICT_NONE;
    const int64_t lead_us = time_us - newest->time_us;
    const int32_t faded_us = faded_lead_us(lead_us);
    motion_t motion;
    *pose = newest->pose;
    if (!predict_motion(&motion, history, 0, faded_us))
        return POSE_PREDICT_HELD;
    trust_t position = {{0, 0}, {0, 0}}, turn = position;
    try_on_the_past(&position, &turn, history, faded_us);
    keep_trusted(motion.step_nm, &position, POSE_PREDICT_NOISE_NM);
    keep_trusted(motion.turn_q30, &turn, POSE_PREDICT_NOISE_Q30);
    for (int i = 0; i < 3; i++)
        pose->eye_nm[i] += motion.step_nm[i];
    quaternion_turn(pose->quaternion_q30, newest->pose.quaternion_q30, motion.turn_q30);
    if (lead_us >= POSE_PREDICT_STILL_US)
        return POSE_PREDICT_HELD;
    return lead_us > 0 || !newest->measured ? POSE_PREDICT_PREDICTED : POSE_PREDICT_TRACKED;
}
