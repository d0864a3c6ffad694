// SPDX-License-Identifier: Apache-2.0
// The study's room against those of the tables in tests/oracle, and its warp.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "firmware/room.h"
#include "sim/eval/double_homography.h"
#include "sim/study/study_scene.h"
#include "sim/study/study_image.h"

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
        cmocka_unit_test(straight_on_the_warp_copies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
