// SPDX-License-Identifier: Apache-2.0
// Prediction against holding the newest pose: the stated motions, rest, and swings too quick to predict.
#include "firmware/pose_predict.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "sim/study/prediction_tracks.h"

enum { SEEDS = 2 };

/* Root mean squares, over all seeds, of the length of the position's error and of the angle of the orientation's. */
static prediction_error_t errors(prediction_track_t track, int32_t lead_us, double loss)
{
    prediction_error_t error = {.frames = 0};
    for (uint64_t seed = 1; seed <= SEEDS; seed++)
        prediction_error_add(&error, track, lead_us, loss, seed);
    return error;
}

static bool moves(prediction_track_t track)
{
    return track != PREDICTION_TURNING && track != PREDICTION_STANDING;
}

static bool turns(prediction_track_t track)
{
    return track == PREDICTION_TURNING || track == PREDICTION_BOTH;
}

/* Never worse than holding by 10 %; what moves 30 % of it at most. */
static void check_ratios(double loss, int32_t first_us, int32_t step_us)
{
    for (int t = 0; t < PREDICTION_TRACKS; t++) {
        const prediction_track_t track = (prediction_track_t)t;
        for (int32_t lead_us = first_us; lead_us <= 60000; lead_us += step_us) {
            const prediction_error_t error = errors(track, lead_us, loss);
            const double position = prediction_position_ratio(&error), angle = prediction_angle_ratio(&error);
            if (position > (moves(track) ? 0.3 : 1.1) || angle > (turns(track) ? 0.3 : 1.1))
                fail_msg("%s, lead %d ms, loss %g, seeds 1 to %d: position %.3f, angle %.3f of the hold error",
                         prediction_track_name(track), lead_us / 1000, loss, SEEDS, position, angle);
        }
    }
}

static void better_than_holding(void **state)
{
    (void)state;
    check_ratios(0.0, 10000, 10000);
}

static void better_than_holding_with_every_tenth_pose_lost(void **state)
{
    (void)state;
    check_ratios(0.1, 20000, 20000);
}

/* What this filter reaches: 40 ms lead, with a third to spare. */
static void figures_at_40_ms(void **state)
{
    (void)state;
    const double position[PREDICTION_TRACKS] = {0.105, 0.4, 0.105, 0.05, 0.8};
    const double angle[PREDICTION_TRACKS] = {0.4, 0.045, 0.045, 0.4, 0.4};
    for (int t = 0; t < PREDICTION_TRACKS; t++) {
        const prediction_error_t error = errors((prediction_track_t)t, 40000, 0.0);
        if (prediction_position_ratio(&error) > position[t] || prediction_angle_ratio(&error) > angle[t])
            fail_msg("%s, seeds 1 to %d: position %.3f, angle %.3f of the hold error",
                     prediction_track_name((prediction_track_t)t), SEEDS, prediction_position_ratio(&error),
                     prediction_angle_ratio(&error));
    }
}

static void without_a_lead_noise_is_smoothed(void **state)
{
    (void)state;
    const prediction_error_t error = errors(PREDICTION_STANDING, 0, 0.0);
    if (prediction_position_ratio(&error) > 0.35 || prediction_angle_ratio(&error) > 0.3)
        fail_msg("seeds 1 to %d: position %.3f, angle %.3f of the hold error", SEEDS, prediction_position_ratio(&error),
                 prediction_angle_ratio(&error));
}

/* Root mean squares over 8 s of a swing along x, predicted over held; seed 7. */
static double swing_ratio(double size_mm, double rate_hz, int32_t lead_us)
{
    pose_history_t history = {.count = 0};
    rng_t rng = {7};
    double held = 0.0, predicted = 0.0;
    for (int n = 0; n < 9 * PREDICTION_RATE_HZ; n++) {
        const double time_s = (double)n / PREDICTION_RATE_HZ, due_s = time_s + lead_us * 1e-6;
        const pose_t now = {{llround(size_mm * 1e6 * sin(2 * M_PI * rate_hz * time_s))}, {1 << 30, 0, 0, 0}};
        const int64_t due_nm = llround(size_mm * 1e6 * sin(2 * M_PI * rate_hz * due_s));
        const can_pose_t tracked = {.pose = study_pose_tracked(&now, &prediction_noise, &rng),
                                    .quality = CAN_POSE_TRACKED};
        (void)pose_history_add(&history, &tracked, llround(time_s * 1e6));
        if (n < PREDICTION_RATE_HZ || n % PREDICTION_EVERY != 0)
            continue;
        pose_t pose;
        (void)pose_predict(&history, llround(due_s * 1e6), &pose);
        for (int i = 0; i < 3; i++) {
            const int64_t expected_nm = i == 0 ? due_nm : 0;
            held += pow((double)(tracked.pose.eye_nm[i] - expected_nm), 2);
            predicted += pow((double)(pose.eye_nm[i] - expected_nm), 2);
        }
    }
    return sqrt(predicted / held);
}

/* A parabola alone would be off by up to 2.7 times the error of holding. */
static void swings_too_quick_to_predict_are_held(void **state)
{
    (void)state;
    for (double size_mm = 1.0; size_mm < 70.0; size_mm *= 4.0)
        for (double rate_hz = 3.0; rate_hz < 7.0; rate_hz += 1.0)
            for (int32_t lead_us = 20000; lead_us <= 60000; lead_us += 40000) {
                const double ratio = swing_ratio(size_mm, rate_hz, lead_us);
                if (ratio > 1.12)
                    fail_msg("%g mm at %g Hz, lead %d ms: %.3f of the hold error", size_mm, rate_hz, lead_us / 1000,
                             ratio);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_at_40_ms),
        cmocka_unit_test(without_a_lead_noise_is_smoothed),
        cmocka_unit_test(swings_too_quick_to_predict_are_held),
        cmocka_unit_test(better_than_holding),
        cmocka_unit_test(better_than_holding_with_every_tenth_pose_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
