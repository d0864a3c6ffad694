// SPDX-License-Identifier: Apache-2.0
// Viewers who walk, turn their heads, stop and go; tracked with noise, and how far off their predicted poses are.
#include "sim/study/prediction_tracks.h"

#include <math.h>

#include "firmware/pose_predict.h"

static const double speed_m_s = 1.4, bob_m = 0.03, bob_hz = 2.0, yaw_deg = 45.0, yaw_hz = 0.7;
static const double acceleration_m_s2 = 1.0, going_s = 1.0, standing_s = 1.0;
const study_noise_t prediction_noise = {.position_mm = 0.5, .orientation_deg = 0.05};

const char *prediction_track_name(prediction_track_t track)
{
    static const char *const name[PREDICTION_TRACKS] = {"walking", "turning", "both", "stop and go", "standing"};
    return name[track];
}

/* One period of stop and go: speeding up, going, slowing down, standing. */
static double slowing_s(void)
{
    return speed_m_s / acceleration_m_s2;
}

static double period_s(void)
{
    return 2 * slowing_s() + going_s + standing_s;
}

static double stop_and_go_m(double time_s)
{
    const double periods = floor(time_s / period_s()), step_m = speed_m_s * (slowing_s() + going_s);
    const double t = time_s - periods * period_s();
    const double speeding = fmin(t, slowing_s()), slowing = fmin(fmax(t - slowing_s() - going_s, 0.0), slowing_s());
    const double going = fmin(fmax(t - slowing_s(), 0.0), going_s);
    return periods * step_m + acceleration_m_s2 / 2 * speeding * speeding + speed_m_s * (going + slowing) -
           acceleration_m_s2 / 2 * slowing * slowing;
}

static bool stands(double time_s)
{
    return fmod(time_s, period_s()) >= period_s() - standing_s;
}

pose_t prediction_pose(prediction_track_t track, double time_s)
{
    pose_t pose = study_pose(0.0);
    if (track == PREDICTION_WALKING || track == PREDICTION_BOTH) {
        pose.eye_nm[0] += llround(speed_m_s * time_s * 1e9);
        pose.eye_nm[1] += llround(bob_m * sin(2.0 * M_PI * bob_hz * time_s) * 1e9);
    }
    if (track == PREDICTION_TURNING || track == PREDICTION_BOTH)
        study_pose_turn_head(&pose,
                             (const double[3]){0.0, yaw_deg * M_PI / 180.0 * sin(2.0 * M_PI * yaw_hz * time_s), 0.0});
    if (track == PREDICTION_STOP_AND_GO || track == PREDICTION_STANDING)
        pose.eye_nm[0] += llround(stop_and_go_m(time_s) * 1e9);
    return pose;
}

static double distance_mm2(const pose_t *a, const pose_t *b)
{
    double square = 0.0;
    for (int i = 0; i < 3; i++)
        square += pow((double)(a->eye_nm[i] - b->eye_nm[i]) * 1e-6, 2);
    return square;
}

/* From the vector part of conj(a) b, half the sine of the angle: accurate for small ones too. */
static double angle_deg2(const pose_t *a, const pose_t *b)
{
    const int32_t *p = a->quaternion_q30, *q = b->quaternion_q30;
    const double scale = ldexp(1.0, -60);
    double vector = 0.0, scalar = 0.0;
    for (int i = 0; i < 4; i++)
        scalar += (double)p[i] * q[i];
    for (int i = 1; i < 4; i++) {
        const int j = i % 3 + 1, k = j % 3 + 1;
        vector = hypot(vector, (double)p[0] * q[i] - (double)p[i] * q[0] - (double)p[j] * q[k] + (double)p[k] * q[j]);
    }
    return pow(2.0 * atan2(vector * scale, fabs(scalar) * scale) * 180.0 / M_PI, 2);
}

void prediction_error_add(prediction_error_t *error, prediction_track_t track, int32_t lead_us, double loss,
                          uint64_t seed)
{
    pose_history_t history = {.count = 0};
    rng_t rng = {seed};
    for (int32_t n = 0; n < PREDICTION_SECONDS * PREDICTION_RATE_HZ; n++) {
        const double time_s = (double)n / PREDICTION_RATE_HZ, due_s = time_s + lead_us * 1e-6;
        const pose_t now = prediction_pose(track, time_s);
        const can_pose_t tracked = {.pose = study_pose_tracked(&now, &prediction_noise, &rng),
                                    .quality = CAN_POSE_TRACKED};
        const bool lost = rng_unit(&rng) <= loss;
        if (!lost)
            (void)pose_history_add(&history, &tracked, llround(time_s * 1e6));
        if (n < PREDICTION_RATE_HZ || n % PREDICTION_EVERY != 0 || (track == PREDICTION_STANDING && !stands(due_s)))
            continue;
        const pose_t due = prediction_pose(track, due_s), held = pose_history_back(&history, 0)->pose;
        pose_t predicted = held;
        (void)pose_predict(&history, llround(due_s * 1e6), &predicted);
        error->hold_mm2 += distance_mm2(&held, &due);
        error->predicted_mm2 += distance_mm2(&predicted, &due);
        error->hold_deg2 += angle_deg2(&held, &due);
        error->predicted_deg2 += angle_deg2(&predicted, &due);
        error->frames++;
    }
}

double prediction_position_ratio(const prediction_error_t *error)
{
    return sqrt(error->predicted_mm2 / error->hold_mm2);
}

double prediction_angle_ratio(const prediction_error_t *error)
{
    return sqrt(error->predicted_deg2 / error->hold_deg2);
}
