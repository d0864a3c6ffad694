// SPDX-License-Identifier: Apache-2.0
// What the eye sees of a wall corrected for another pose: the picture, moved by what is known.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "sim/study/latency_view.h"
#include "sim/study/study_image.h"

enum { WIDTH = 160, HEIGHT = 90 };

static latency_square_t seen_from(const image_t *picture, const pose_t *corrected, const pose_t *eye)
{
    const study_sizes_t sizes = {WIDTH, HEIGHT, WIDTH, HEIGHT};
    study_scene_t scene;
    latency_square_t sum = {0.0, 0};
    study_scene(&scene, &sizes);
    assert_true(latency_view_add(&sum, &scene, picture, corrected, eye));
    return sum;
}

/* Straight on the picture is the wall. 100 mm aside, 4 of 160 px, each column shows the one 4 px on. */
static void a_moved_eye_sees_the_picture_moved(void **state)
{
    (void)state;
    image_t picture;
    assert_true(study_image(STUDY_COFFEE, WIDTH, HEIGHT, 1, &picture, NULL));
    const pose_t there = study_pose(0.0);
    pose_t here = there;
    here.eye_nm[0] += 100000000;
    const latency_square_t same = seen_from(&picture, &there, &there), moved = seen_from(&picture, &there, &here);
    assert_int_equal(same.pixels, WIDTH * HEIGHT);
    assert_true(same.square == 0.0);
    double expected = 0.0;
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x + 4 < WIDTH; x++)
            expected += pow(image_row(&picture, y)[x + 4] - image_row(&picture, y)[x], 2);
    assert_int_equal(moved.pixels, (WIDTH - 4) * HEIGHT);
    assert_true(moved.square == expected);
    free(picture.data);
}

/* The wall is corrected for the first pose and seen from the second: the other way round it is not the same. */
static void what_both_poses_see_is_counted(void **state)
{
    (void)state;
    image_t picture;
    assert_true(study_image(STUDY_COFFEE, WIDTH, HEIGHT, 1, &picture, NULL));
    const pose_t there = study_pose(0.0), aside = study_pose(40.0);
    const latency_square_t own = seen_from(&picture, &aside, &aside), other = seen_from(&picture, &there, &aside);
    assert_true(own.pixels > WIDTH * HEIGHT / 3);
    assert_true(other.square / (double)other.pixels > 4.0 * own.square / (double)own.pixels);
    free(picture.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_moved_eye_sees_the_picture_moved),
        cmocka_unit_test(what_both_poses_see_is_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
