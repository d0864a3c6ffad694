// SPDX-License-Identifier: Apache-2.0
// Displacements that are known: of moved eyes, turned heads, and pictures drawn for another pose.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "sim/study/study_walk.h"
#include "sim/study/latency_tracks.h"

static const study_sizes_t full_hd = {1920, 1080, 1920, 1080};

static latency_error_t error_of(const pose_t *drawn, const pose_t *corrected, const pose_t *eye, double content_m)
{
    study_scene_t scene;
    study_scene(&scene, &full_hd);
    const latency_poses_t poses = {*drawn, *corrected, *eye, content_m};
    latency_error_t error = {0};
    latency_error_add(&error, &scene, &poses);
    return error;
}

static void same_pose_is_exact(void **state)
{
    (void)state;
    for (int angle = -60; angle <= 60; angle += 30) {
        const pose_t pose = study_pose(angle);
        const latency_error_t error = error_of(&pose, &pose, &pose, 2.5);
        if (!(error.worst_px < 1e-6 && error.points > LATENCY_POINTS_X * LATENCY_POINTS_Y / 3))
            fail_msg("angle %d: off by %g px at %d points", angle, error.worst_px, (int)error.points);
    }
}

/* 2.5 m before the wall, 1 mm is 1200 px / 2500. */
static void moved_eye_moves_the_picture(void **state)
{
    (void)state;
    const pose_t there = study_pose(0.0);
    pose_t here = there;
    here.eye_nm[0] += 50000000;
    const latency_error_t wall_late = error_of(&here, &there, &here, 0.0);
    assert_true(fabs(latency_mean_px(&wall_late) - 24.0) < 1e-3);
    assert_true(fabs(wall_late.worst_px - 24.0) < 1e-3);
    assert_true(wall_late.worst_deg < 24.0 / 1200 * 180 / M_PI + 1e-3);
    assert_true(wall_late.worst_deg > 0.99 * 24.0 / 1200 * 180 / M_PI);
    /* the same for any content: the picture is the eye's own */
    const latency_error_t far = error_of(&here, &there, &here, HUGE_VAL);
    assert_true(fabs(latency_mean_px(&far) - 24.0) < 1e-3);
}

/* Picture and wall for where the eye was: right on the wall, and half the parallax as far behind it. */
static void content_moves_by_its_parallax(void **state)
{
    (void)state;
    const pose_t there = study_pose(0.0);
    pose_t here = there;
    here.eye_nm[0] += 50000000;
    const struct {
        double content_m, px;
    } expected[] = {{0.0, 0.0}, {2.5, 12.0}, {7.5, 18.0}, {HUGE_VAL, 24.0}};
    for (int n = 0; n < 4; n++) {
        const latency_error_t error = error_of(&there, &there, &here, expected[n].content_m);
        if (fabs(latency_mean_px(&error) - expected[n].px) > 1e-3)
            fail_msg("content %g m behind the wall: %g px, expected %g", expected[n].content_m, latency_mean_px(&error),
                     expected[n].px);
    }
}

static void turned_head_turns_the_world_when_the_wall_follows_it(void **state)
{
    (void)state;
    const pose_t before = study_pose(0.0);
    pose_t now = before;
    study_pose_turn_head(&now, (const double[3]){0.0, 10.0 * M_PI / 180.0, 0.0});
    const latency_error_t trap = error_of(&before, &now, &now, HUGE_VAL);
    assert_true(trap.worst_deg < 10.0 + 1e-4); /* at the horizon; less above and below it */
    assert_true(latency_mean_deg(&trap) > 9.0);
    const latency_error_t one_pose = error_of(&before, &before, &now, HUGE_VAL);
    assert_true(one_pose.points > 0 && one_pose.worst_px < 1e-3);
}

static void wall_out_of_view_is_no_number(void **state)
{
    (void)state;
    pose_t away = study_pose(0.0);
    study_pose_turn_head(&away, (const double[3]){0.0, M_PI, 0.0});
    const latency_error_t error = error_of(&away, &away, &away, 1.0);
    assert_int_equal(error.points, 0);
    assert_true(isnan(latency_mean_px(&error)));
    assert_true(isnan(latency_mean_deg(&error)));
    const pose_t facing = study_pose(0.0);
    assert_int_equal(error_of(&facing, &facing, &away, 1.0).points, 0);
}

static void errors_grow_with_latency_and_vanish_without(void **state)
{
    (void)state;
    study_scene_t scene;
    study_scene(&scene, &full_hd);
    for (int t = 0; t < LATENCY_TRACKS; t++) {
        const latency_track_t track = (latency_track_t)t;
        const latency_error_t none = latency_late_error(&scene, track, 0.0, 2.5);
        const latency_error_t some = latency_late_error(&scene, track, 0.01, 2.5);
        const latency_error_t more = latency_late_error(&scene, track, 0.05, 2.5);
        if (!(none.worst_px < 1e-3 && latency_mean_px(&some) > 1.0 &&
              latency_mean_px(&more) > 4.0 * latency_mean_px(&some)))
            fail_msg("%s: %g, %g, %g px", latency_track_name(track), none.worst_px, latency_mean_px(&some),
                     latency_mean_px(&more));
    }
}

static void each_choice_of_poses_is_exact_for_its_content(void **state)
{
    (void)state;
    study_scene_t scene;
    study_scene(&scene, &full_hd);
    /* what is drawn on the wall needs the picture's own pose; what is far away, only its orientation */
    assert_true(latency_late_error(&scene, LATENCY_ONE_POSE, 0.05, 0.0).worst_px < 1e-2);
    assert_true(latency_late_error(&scene, LATENCY_ONE_POSE_WALKING, 0.05, 0.0).worst_px < 1e-2);
    assert_true(latency_late_error(&scene, LATENCY_ONE_TURN, 0.05, HUGE_VAL).worst_px < 1e-2);
    const latency_error_t trap = latency_late_error(&scene, LATENCY_TRAP, 0.05, HUGE_VAL);
    assert_true(trap.worst_deg > 9.0 && trap.worst_deg < 10.0); /* at most 198 degrees a second */
}

static void noise_of_one_pose_for_both_hardly_shows(void **state)
{
    (void)state;
    study_scene_t scene;
    study_scene(&scene, &full_hd);
    const study_noise_t noise = {.orientation_deg = 1.0};
    const latency_error_t alone = latency_noise_error(&scene, false, &noise, 2.5);
    const latency_error_t both = latency_noise_error(&scene, true, &noise, 2.5);
    assert_true(latency_mean_px(&alone) > 10.0);
    assert_true(both.worst_px < 1e-2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_pose_is_exact),
        cmocka_unit_test(moved_eye_moves_the_picture),
        cmocka_unit_test(content_moves_by_its_parallax),
        cmocka_unit_test(turned_head_turns_the_world_when_the_wall_follows_it),
        cmocka_unit_test(wall_out_of_view_is_no_number),
        cmocka_unit_test(errors_grow_with_latency_and_vanish_without),
        cmocka_unit_test(each_choice_of_poses_is_exact_for_its_content),
        cmocka_unit_test(noise_of_one_pose_for_both_hardly_shows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
