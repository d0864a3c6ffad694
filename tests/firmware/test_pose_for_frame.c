// SPDX-License-Identifier: Apache-2.0
// Does the world stand still on the wall while the head turns and the viewer walks? Which pose is a picture's own?
#include "firmware/pose_for_frame.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "sim/eval/double_homography.h"
#include "sim/eval/double_view.h"
#include "sim/study/study_pose.h"

enum { RENDER_US = 50000, SHOWN_US = 20000, RATE_HZ = 240, EVERY = 4 };

static const camera_t camera = {1920, 1080, {1200000000, 1200000000}, {960000000, 540000000}};

/* A viewer 2.5 m before a wall of 4 m. */
typedef struct {
    double turn_deg_s, walk_m_s;
    study_noise_t noise;
    int counters;    /* of the pose messages: 256 or 15 */
    int64_t away_mm; /* content is so far from the drawn eye, along its axis; 0: infinitely far */
} motion_t;

static pose_t pose_of(const motion_t *motion, double time_s)
{
    pose_t pose = study_pose(0.0);
    study_pose_turn_head(&pose, (const double[3]){0.0, motion->turn_deg_s * time_s * M_PI / 180.0, 0.0});
    pose.eye_nm[0] += llround(motion->walk_m_s * time_s * 1e9);
    return pose;
}

static wall_t front_wall(void)
{
    const wall_corners_t corners = {
        .panel_width = 1920,
        .panel_height = 1080,
        .corner_um = {{-2000000, -1125000, 0}, {2000000, -1125000, 0}, {2000000, 1125000, 0}},
        .corner_known = {true, true, true, false}};
    wall_t wall;
    assert_int_equal(wall_from_corners(&wall, &corners), WALL_OK);
    return wall;
}

/* Angle between where the eye sees a point of the drawn picture on the wall and where the point is, degrees. */
static double off_deg(const motion_t *motion, const pose_for_frame_t *chosen, const pose_t *drawn, const pose_t *eye,
                      const double xy[2])
{
    const wall_t wall = front_wall();
    homography_t fixed;
    double_homography_t homography;
    double_view_t from, to;
    double_wall_t surface;
    double uv[2], point[3], ray[3], dot = 0.0, seen = 0.0, wanted = 0.0;
    assert_true(homography_from_pose(&fixed, &chosen->camera, &wall, &chosen->pose));
    double_homography_from_fixed(&homography, &fixed);
    assert_true(double_homography_panel_point(&homography, xy, uv));
    double_wall(&surface, &wall);
    double_wall_point(&surface, uv, point);
    double_view(&from, &camera, drawn);
    double_view(&to, &camera, eye);
    double_view_ray(&from, xy, ray);
    for (int i = 0; i < 3; i++) {
        if (motion->away_mm != 0)
            ray[i] = from.eye_m[i] + ray[i] * 1e-3 * (double)motion->away_mm - to.eye_m[i];
        point[i] -= to.eye_m[i];
        dot += ray[i] * point[i];
        seen += point[i] * point[i];
        wanted += ray[i] * ray[i];
    }
    return acos(fmin(dot / sqrt(seen * wanted), 1.0)) * 180.0 / M_PI;
}

/* A picture drawn with the pose of a time. */
static pose_for_frame_picture_t tagged(int64_t picture_us, int64_t shown_us, int64_t drawn_us)
{
    return (pose_for_frame_picture_t){.picture_us = picture_us,
                                      .shown_us = shown_us,
                                      .tagged = true,
                                      .tag = {.capture_time_us = (uint32_t)(uint64_t)drawn_us},
                                      .wrap_us = CAN_POSE_FD_WRAP_US};
}

/* The worst over half a second, in the middle of which the viewer is before the wall's middle and looks at it. */
static double worst_off_deg(const motion_t *motion, const pose_for_frame_rule_t *rule)
{
    pose_history_t history = {.count = 0};
    rng_t rng = {11};
    double worst = 0.0;
    int64_t drawn_us[RATE_HZ] = {0};
    pose_t drawn[RATE_HZ];
    for (int n = 0; n < RATE_HZ; n++) {
        const double time_s = (double)n / RATE_HZ - 0.75;
        const pose_t now = pose_of(motion, time_s);
        const can_pose_t tracked = {.pose = study_pose_tracked(&now, &motion->noise, &rng),
                                    .quality = CAN_POSE_TRACKED,
                                    .counter = (uint8_t)(n % motion->counters)};
        const int64_t time_us = llround(time_s * 1e6);
        (void)pose_history_add(&history, &tracked, time_us);
        drawn[n] = tracked.pose;
        drawn_us[n] = time_us;
        const int rendered = n - RENDER_US * RATE_HZ / 1000000;
        if (n < RATE_HZ / 2 || n % EVERY != 0)
            continue;
        const pose_for_frame_picture_t picture = tagged(time_us, time_us + SHOWN_US, drawn_us[rendered]);
        pose_for_frame_t chosen;
        assert_true(pose_for_frame(&chosen, &history, &camera, rule, &picture));
        assert_true(chosen.drawn_known);
        const pose_t eye = pose_of(motion, time_s + SHOWN_US * 1e-6);
        for (int at = 0; at < 3; at++) {
            const double xy[2] = {760.0 + at * 200.0, 540.0};
            worst = fmax(worst, off_deg(motion, &chosen, &drawn[rendered], &eye, xy));
        }
    }
    return worst;
}

static const study_noise_t no_noise = {0.0, 0.0}, tracker_noise = {0.5, 0.05};

/* 100 degrees/s for 50 ms are 5 degrees. */
static void a_turning_head_does_not_turn_the_world(void **state)
{
    (void)state;
    const motion_t turning = {100.0, 0.0, tracker_noise, 256, 0};
    pose_for_frame_rule_t rule = {POSE_FOR_FRAME_TAG, POSE_FOR_FRAME_FAR, 0, RENDER_US};
    const double tag = worst_off_deg(&turning, &rule);
    rule.mode = POSE_FOR_FRAME_DELAY;
    const double delay = worst_off_deg(&turning, &rule);
    rule.mode = POSE_FOR_FRAME_LATEST;
    const double latest = worst_off_deg(&turning, &rule);
    printf("head at 100 degrees/s, picture 50 ms old: off by %.3f degrees (tag), %.3f (delay), %.3f (latest)\n", tag,
           delay, latest);
    assert_true(tag < 0.1);
    assert_true(delay < 0.1); /* as long as it is known exactly */
    assert_true(latest > 4.8 && latest < 5.3);
}

/* A tag says which pose it was, whatever the latency is believed to be. */
static void a_tag_needs_no_latency(void **state)
{
    (void)state;
    const motion_t turning = {100.0, 0.0, no_noise, 256, 0};
    pose_for_frame_rule_t rule = {POSE_FOR_FRAME_TAG, POSE_FOR_FRAME_FAR, 0, RENDER_US};
    for (rule.render_us = 0; rule.render_us <= 500000; rule.render_us += 100000)
        assert_true(worst_off_deg(&turning, &rule) < 0.02);
}

/* Walking past content on the wall, 2.5 m off, 5 m off, far off: only its own rule puts it where it is. */
static void content_stays_where_it_is(void **state)
{
    (void)state;
    const int64_t away_mm[] = {STUDY_DISTANCE_MM, 5000, 0};
    for (int at = 0; at < 3; at++) {
        const motion_t walking = {0.0, 1.4, no_noise, 256, away_mm[at]};
        for (int content = POSE_FOR_FRAME_WALL; content <= POSE_FOR_FRAME_FAR; content++) {
            const pose_for_frame_rule_t rule = {POSE_FOR_FRAME_TAG, (pose_for_frame_content_t)content, 5000000,
                                                RENDER_US};
            const double off = worst_off_deg(&walking, &rule);
            if (at == content ? off > 0.005 : off < 0.5)
                fail_msg("content %ld mm away, rule %d: off by %g degrees", (long)away_mm[at], content, off);
        }
    }
}

/* All of it at once, as on a set: what remains is noise. */
static void walking_and_turning_with_noise(void **state)
{
    (void)state;
    const motion_t both = {100.0, 1.4, tracker_noise, 256, 5000};
    const pose_for_frame_rule_t rule = {POSE_FOR_FRAME_TAG, POSE_FOR_FRAME_DEPTH, 5000000, RENDER_US};
    const double off = worst_off_deg(&both, &rule);
    printf("walking and turning, with noise: off by %.3f degrees\n", off);
    assert_true(off < 0.1);
}

/* Ten poses 10 ms apart from 1 s on, 1 mm and 1 degree apart, with a jump before the sixth. */
static pose_history_t ten_poses(void)
{
    pose_history_t history = {.count = 0};
    for (int n = 0; n < 10; n++) {
        can_pose_t pose = {.quality = CAN_POSE_TRACKED, .counter = (uint8_t)(200 + n)};
        pose.pose = study_pose(0.0);
        pose.pose.eye_nm[0] = n * 1000000 + (n >= 5) * INT64_C(2000000000);
        study_pose_turn_head(&pose.pose, (const double[3]){0.0, n * M_PI / 180.0, 0.0});
        (void)pose_history_add(&history, &pose, 1000000 + n * 10000);
    }
    return history;
}

static double yaw_deg(const pose_t *pose)
{
    return 360.0 / M_PI * atan2(pose->quaternion_q30[2], pose->quaternion_q30[0]);
}

static void the_pose_at_a_time(void **state)
{
    (void)state;
    const pose_history_t history = ten_poses();
    const struct {
        int64_t time_us, eye_nm;
        double yaw_deg;
        int counter;
        bool known;
    } cases[] = {
        {1000000, 0, 0.0, 200, true},          {1012500, 1250000, 1.25, 201, true},
        {1039999, 3999900, 3.9999, 203, true}, {1045000, 4000000, 4.0, 204, true}, /* the jump is not crossed */
        {1050000, 2005000000, 5.0, 205, true}, {1085000, 2008500000, 8.5, 208, true},
        {1090000, 2009000000, 9.0, 209, true}, {1200000, 2009000000, 9.0, 209, true},
        {999999, 0, 0.0, 200, false},          {INT64_MIN / 4, 0, 0.0, 200, false},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        const pose_for_frame_rule_t rule = {POSE_FOR_FRAME_DELAY, POSE_FOR_FRAME_WALL, 0, 30000};
        const pose_for_frame_picture_t picture = tagged(cases[n].time_us + 30000, 1100000, 1030000);
        pose_for_frame_t chosen;
        assert_true(pose_for_frame(&chosen, &history, &camera, &rule, &picture));
        if (chosen.pose.eye_nm[0] != cases[n].eye_nm || fabs(yaw_deg(&chosen.pose) - cases[n].yaw_deg) > 1e-5 ||
            chosen.drawn.counter != cases[n].counter || chosen.drawn_known != cases[n].known)
            fail_msg("case %d: %ld nm, %f degrees, counter %d, known %d", (int)n, (long)chosen.pose.eye_nm[0],
                     yaw_deg(&chosen.pose), chosen.drawn.counter, chosen.drawn_known);
    }
}

static void a_lost_tag_falls_back_to_the_delay(void **state)
{
    (void)state;
    const pose_history_t history = ten_poses();
    const pose_for_frame_rule_t rule = {POSE_FOR_FRAME_TAG, POSE_FOR_FRAME_WALL, 0, 30000};
    pose_for_frame_picture_t picture = tagged(1100000, 1120000, 1020000);
    pose_for_frame_t chosen;
    assert_true(pose_for_frame(&chosen, &history, &camera, &rule, &picture));
    assert_true(chosen.drawn_known);
    assert_int_equal(chosen.drawn.counter, 202);
    picture.tag.capture_time_us = 1020001; /* no such pose */
    assert_true(pose_for_frame(&chosen, &history, &camera, &rule, &picture));
    assert_false(chosen.drawn_known);
    assert_int_equal(chosen.drawn.counter, 207);
    picture = tagged(1100000, 1120000, 1020000);
    picture.tagged = false;
    assert_true(pose_for_frame(&chosen, &history, &camera, &rule, &picture));
    assert_false(chosen.drawn_known);
    assert_int_equal(chosen.drawn.counter, 207);
}

static void without_a_pose_there_is_nothing_to_choose(void **state)
{
    (void)state;
    const pose_history_t history = {.count = 0};
    const pose_for_frame_rule_t rule = {POSE_FOR_FRAME_TAG, POSE_FOR_FRAME_FAR, 0, 30000};
    const pose_for_frame_picture_t picture = tagged(1100000, 1120000, 0);
    pose_for_frame_t chosen = {.drawn_known = true};
    assert_false(pose_for_frame(&chosen, &history, &camera, &rule, &picture));
    assert_true(chosen.drawn_known);
}

/* The content's plane is nearer than the new eye: what is on the wall at least stays. */
static void a_reached_content_is_left_on_the_wall(void **state)
{
    (void)state;
    const pose_history_t history = ten_poses(); /* the eye jumps 2 m to the side */
    const pose_for_frame_picture_t picture = tagged(1100000, 1120000, 1020000);
    pose_for_frame_rule_t rule = {POSE_FOR_FRAME_TAG, POSE_FOR_FRAME_DEPTH, 100000, 30000};
    pose_for_frame_t chosen;
    assert_true(pose_for_frame(&chosen, &history, &camera, &rule, &picture));
    assert_int_equal(chosen.pose.eye_nm[0], 2000000);
    assert_int_equal(chosen.camera.principal_upx[0], camera.principal_upx[0]);
    rule.depth_um = 2000000;
    assert_true(pose_for_frame(&chosen, &history, &camera, &rule, &picture));
    assert_true(chosen.pose.eye_nm[0] > 2000000000);
    assert_true(chosen.camera.principal_upx[0] > camera.principal_upx[0]);
    assert_true(fabs(yaw_deg(&chosen.pose) - 2.0) < 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_turning_head_does_not_turn_the_world),
        cmocka_unit_test(a_tag_needs_no_latency),
        cmocka_unit_test(content_stays_where_it_is),
        cmocka_unit_test(walking_and_turning_with_noise),
        cmocka_unit_test(the_pose_at_a_time),
        cmocka_unit_test(a_lost_tag_falls_back_to_the_delay),
        cmocka_unit_test(a_reached_content_is_left_on_the_wall),
        cmocka_unit_test(without_a_pose_there_is_nothing_to_choose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
