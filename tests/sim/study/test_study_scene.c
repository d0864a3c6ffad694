// SPDX-License-Identifier: Apache-2.0
// The study's room and poses against those of the tables in tests/oracle, and its warp.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/room.h"
#include "sim/eval/double_homography.h"
#include "sim/pose/pose_text.h"
#include "sim/study/study_scene.h"

static void scene_is_room(const char *path, const study_sizes_t *sizes)
{
    char error[ROOM_MESSAGE_LENGTH];
    room_t *room = malloc(sizeof *room);
    study_scene_t scene;
    homography_t ours, theirs;
    double_homography_t a, b;
    const pose_t pose = study_pose(37.0);
    assert_true(room_load(room, path, NULL, NULL, error));
    study_scene(&scene, sizes);
    assert_int_equal(scene.camera.width, room->camera.width);
    assert_int_equal(scene.camera.height, room->camera.height);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(scene.camera.focal_upx[i], room->camera.focal_upx[i]);
        assert_int_equal(scene.camera.principal_upx[i], room->camera.principal_upx[i]);
    }
    assert_true(homography_from_pose(&ours, &scene.camera, &scene.wall, &pose));
    assert_true(homography_from_pose(&theirs, &room->camera, &room->board[0].wall, &pose));
    double_homography_from_fixed(&a, &ours);
    double_homography_from_fixed(&b, &theirs);
    assert_memory_equal(a.panel_from_picture, b.panel_from_picture, sizeof a.panel_from_picture);
    assert_int_equal(a.panel_width, b.panel_width);
    assert_int_equal(a.panel_height, b.panel_height);
    free(room);
}

static void scenes_are_the_rooms_of_the_tables(void **state)
{
    (void)state;
    scene_is_room("tests/oracle/room_eq.yaml", &(study_sizes_t){1920, 1080, 1920, 1080});
    scene_is_room("tests/oracle/room_gt.yaml", &(study_sizes_t){1920, 1080, 960, 540});
    scene_is_room("tests/oracle/room_low.yaml", &(study_sizes_t){510, 290, 1920, 1080});
}

static void poses_are_those_of_the_tables(void **state)
{
    (void)state;
    static const struct {
        double angle_deg;
        const char *text;
    } rows[] = {
        {0, "0.000000 0.000000 -2500.000000 1.000000000 0.000000000 0.000000000 0.000000000"},
        {30, "1250.000000 0.000000 -2165.063509 0.965925826 -0.000000000 -0.258819045 -0.000000000"},
        {60, "2165.063509 0.000000 -1250.000000 0.866025404 0.000000000 -0.500000000 0.000000000"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        char error[256];
        pose_t expected;
        const pose_t pose = study_pose(rows[r].angle_deg);
        assert_true(pose_from_text(rows[r].text, &expected, error));
        for (int i = 0; i < 3; i++)
            assert_int_equal(pose.eye_nm[i], expected.eye_nm[i]);
        for (int i = 0; i < 4; i++)
            assert_in_range(pose.quaternion_q30[i] - expected.quaternion_q30[i] + 2, 0, 4);
    }
}

/* Whatever the turns, the viewer looks at the wall's centre from 2.5 m. */
static void turned_poses_look_at_the_centre(void **state)
{
    (void)state;
    const study_sizes_t sizes = {1920, 1080, 1920, 1080};
    study_scene_t scene;
    study_scene(&scene, &sizes);
    for (int n = 0; n < 27; n++) {
        const double angle_deg[3] = {(n % 3 - 1) * 35.0, (n / 3 % 3 - 1) * 50.0, (n / 9 - 1) * 110.0};
        const pose_t pose = study_pose_turned(angle_deg);
        homography_t homography;
        double_homography_t seen;
        assert_true(homography_from_pose(&homography, &scene.camera, &scene.wall, &pose));
        double_homography_from_fixed(&seen, &homography);
        const double c =
            seen.panel_from_picture[2][0] * 960 + seen.panel_from_picture[2][1] * 540 + seen.panel_from_picture[2][2];
        const double depth = seen.inverse_depth[0] * 960 + seen.inverse_depth[1] * 540 + seen.inverse_depth[2];
        for (int axis = 0; axis < 2; axis++) {
            const double *row = seen.panel_from_picture[axis];
            const double at = (row[0] * 960 + row[1] * 540 + row[2]) / c;
            assert_true(fabs(at - (axis == 0 ? 960 : 540)) < 1e-4);
        }
        assert_true(fabs(1.0 / depth - 2.5) < 1e-6);
    }
    /* about Z alone by a right angle: what was right of the viewer is now above or below */
    const pose_t rolled = study_pose_turned((const double[3]){0.0, 0.0, 90.0});
    assert_int_equal(rolled.eye_nm[2], INT64_C(-2500000000));
    assert_in_range(rolled.quaternion_q30[0], 759250124 - 2, 759250125 + 2);
    assert_in_range(-rolled.quaternion_q30[3], 759250124 - 2, 759250125 + 2);
    /* about X: the eye moves up or down, not aside */
    const pose_t raised = study_pose_turned((const double[3]){30.0, 0.0, 0.0});
    assert_int_equal(raised.eye_nm[0], 0);
    assert_int_equal(llabs(raised.eye_nm[1]), INT64_C(1250000000));
    /* X first: a turn about the vertical then keeps the height */
    assert_int_equal(study_pose_turned((const double[3]){30.0, 50.0, 0.0}).eye_nm[1], raised.eye_nm[1]);
}

static void straight_on_the_warp_copies(void **state)
{
    (void)state;
    const study_sizes_t sizes = {480, 270, 480, 270};
    const pose_t pose = study_pose(0.0);
    study_scene_t scene;
    homography_t homography;
    image_t picture, panel;
    warp_t *warp = malloc(sizeof *warp);
    study_scene(&scene, &sizes);
    assert_true(homography_from_pose(&homography, &scene.camera, &scene.wall, &pose));
    assert_true(study_image(STUDY_NOISE, 480, 270, 1, &picture, NULL));
    assert_true(study_image(STUDY_STUDIO, 480, 270, 1, &panel, NULL));
    for (int m = 0; m < WARP_METHODS; m++) {
        memset(panel.data, 77, 480 * 270);
        study_warp_begin(warp, &warp_methods[m]);
        study_warp_frame(warp, &homography, &picture, &panel);
        assert_memory_equal(panel.data, picture.data, 480 * 270);
    }
    free(panel.data);
    free(picture.data);
    free(warp);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_the_rooms_of_the_tables),
        cmocka_unit_test(poses_are_those_of_the_tables),
        cmocka_unit_test(turned_poses_look_at_the_centre),
        cmocka_unit_test(straight_on_the_warp_copies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
