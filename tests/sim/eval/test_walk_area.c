// SPDX-License-Identifier: Apache-2.0
// Places of walls and of a viewer who looks at them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "sim/eval/double_homography.h"
#include "sim/eval/walk_area.h"
#include "tests/support/rng.h"

enum { PANEL_WIDTH = 64, PANEL_HEIGHT = 36 };

/* Corners in mm, top-left, top-right, bottom-right, bottom-left. */
typedef double corners_t[4][3];

/* sim/demo/room.yaml: y is down. */
static const corners_t front = {{-2400, -2700, 2400}, {2400, -2700, 2400}, {2400, 0, 2400}, {-2400, 0, 2400}};
static const corners_t left = {{-2400, -2700, -2400}, {-2400, -2700, 2400}, {-2400, 0, 2400}, {-2400, 0, -2400}};
static const corners_t ground = {{-2400, 0, 2400}, {2400, 0, 2400}, {2400, 0, -1200}, {-2400, 0, -1200}};
static const corners_t keystone = {{-1000, -900, 50}, {1200, -800, 50}, {900, 700, 50}, {-900, 600, 50}};

static wall_t wall_of(const corners_t corners)
{
    wall_corners_t measured = {.panel_width = PANEL_WIDTH, .panel_height = PANEL_HEIGHT};
    for (int c = 0; c < 4; c++) {
        measured.corner_known[c] = true;
        for (int a = 0; a < 3; a++)
            measured.corner_um[c][a] = (int32_t)lround(1000 * corners[c][a]);
    }
    wall_t wall;
    assert_int_equal(wall_from_corners(&wall, &measured), WALL_OK);
    return wall;
}

static wall_place_t place_of(const corners_t corners)
{
    const wall_t wall = wall_of(corners);
    wall_place_t place;
    wall_place(&place, &wall);
    return place;
}

static void assert_near(const char *what, double got, double expected, double within)
{
    if (!(fabs(got - expected) <= within))
        fail_msg("%s: %.9f, expected %.9f", what, got, expected);
}

static void assert_vector(const char *what, const double got[3], double x, double y, double z)
{
    assert_near(what, got[0], x, 1e-3);
    assert_near(what, got[1], y, 1e-3);
    assert_near(what, got[2], z, 1e-3);
}

static void wall_is_where_its_corners_are(void **state)
{
    (void)state;
    const corners_t *walls[4] = {&front, &left, &ground, &keystone};
    for (int n = 0; n < 4; n++) {
        const wall_place_t place = place_of(*walls[n]);
        for (int c = 0; c < 4; c++)
            assert_vector("corner", place.corner_mm[c], (*walls[n])[c][0], (*walls[n])[c][1], (*walls[n])[c][2]);
    }
    const wall_place_t place = place_of(front), side = place_of(left), floor_place = place_of(ground);
    assert_vector("centre", place.centre_mm, 0, -1350, 2400);
    assert_vector("top", place.top, 0, -1, 0);
    assert_vector("front", place.front, 0, 0, -1);
    assert_vector("front of the left wall", side.front, 1, 0, 0);
    assert_vector("front of the floor", floor_place.front, 0, -1, 0);
    assert_near("before", wall_place_distance_mm(&place, (const double[3]){500, 100, 400}), 2000, 1e-3);
    assert_near("behind", wall_place_distance_mm(&place, (const double[3]){500, 100, 2900}), -500, 1e-3);
}

/* Where the camera of f = 100 px, its principal point (50, 40), sees a panel point, and whether before it. */
static bool project(const wall_t *wall, const pose_t *pose, double u, double v, double xy[2])
{
    const camera_t camera = {100, 80, {100000000, 100000000}, {50000000, 40000000}};
    homography_t homography;
    assert_true(homography_from_pose(&homography, &camera, wall, pose));
    double form[3];
    for (int r = 0; r < 3; r++)
        form[r] = double_from_real(homography.row[r][0]) * u + double_from_real(homography.row[r][1]) * v +
                  double_from_real(homography.row[r][2]);
    xy[0] = form[0] / form[2];
    xy[1] = form[1] / form[2];
    return form[2] > 0.0;
}

/* From any place the wall's centre is in the middle of the picture, and what is higher there is higher in the world. */
static void viewer_looks_at_the_centre_upright(void **state)
{
    (void)state;
    const corners_t *walls[4] = {&front, &left, &ground, &keystone};
    const double up[3] = {0, -1, 0};
    rng_t rng = {7};
    for (int n = 0; n < 400; n++) {
        const wall_t wall = wall_of(*walls[n % 4]);
        wall_place_t place;
        wall_place(&place, &wall);
        double eye_mm[3], xy[2], above[2];
        for (int a = 0; a < 3; a++)
            eye_mm[a] = place.centre_mm[a] + rng_double(&rng, -5000, 5000);
        if (fabs(wall_place_distance_mm(&place, eye_mm)) < 300)
            continue;
        const pose_t pose = wall_place_look(&place, eye_mm, up);
        assert_true(project(&wall, &pose, PANEL_WIDTH / 2.0, PANEL_HEIGHT / 2.0, xy));
        assert_near("x of the centre", xy[0], 50, 1e-4);
        assert_near("y of the centre", xy[1], 40, 1e-4);
        if (n % 4 >= 2)
            continue; /* a floor has no higher, a keystoned picture no upright, middle line */
        assert_true(project(&wall, &pose, PANEL_WIDTH / 2.0, PANEL_HEIGHT / 2.0 - 0.5, above));
        assert_near("x above the centre", above[0], 50, 1e-4);
        if (!(above[1] < 40))
            fail_msg("case %d: upside down", n);
    }
}

/* Turned by exactly half a turn about each axis, the quaternion's w is 0. */
static void viewer_may_be_turned_round(void **state)
{
    (void)state;
    const wall_t wall = wall_of(front);
    wall_place_t place;
    wall_place(&place, &wall);
    const double before[3] = {0, -1350, 0}, behind[3] = {0, -1350, 4000}, up[3] = {0, -1, 0}, down[3] = {0, 1, 0};
    const struct {
        pose_t pose;
        int32_t w, x, y, z;
    } turned[] = {
        {wall_place_look(&place, before, up), 1, 0, 0, 0},
        {wall_place_look(&place, before, down), 0, 0, 0, 1},
        {wall_place_look(&place, behind, up), 0, 0, 1, 0},
        {wall_place_look(&place, behind, down), 0, 1, 0, 0},
    };
    for (int t = 0; t < 4; t++) {
        const int32_t expected[4] = {turned[t].w << 30, turned[t].x << 30, turned[t].y << 30, turned[t].z << 30};
        for (int i = 0; i < 4; i++)
            assert_int_equal(abs(turned[t].pose.quaternion_q30[i]), expected[i]);
    }
}

static void straight_down_has_the_walls_top_above(void **state)
{
    (void)state;
    const wall_t wall = wall_of(ground);
    wall_place_t place;
    wall_place(&place, &wall);
    const double eye_mm[3] = {0, -1700, 600}, up[3] = {0, -1, 0};
    const pose_t pose = wall_place_look(&place, eye_mm, up);
    double xy[2];
    assert_true(project(&wall, &pose, PANEL_WIDTH / 2.0, 0, xy));
    assert_near("x of the top edge", xy[0], 50, 1e-4);
    assert_near("y of the top edge", xy[1], 40 - 100 * 1800 / 1700.0, 1e-4);
}

static void up_is_where_most_tops_are(void **state)
{
    (void)state;
    const corners_t turned = {{0, 0, 3000}, {0, 4000, 3000}, {0, 4000, 0}, {0, 0, 0}}; /* z is up */
    const corners_t lying = {{3000, 0, 0}, {3000, 4000, 0}, {0, 4000, 0}, {0, 0, 0}};  /* x is up */
    const wall_place_t room[4] = {place_of(front), place_of(left), place_of(ground), place_of(turned)};
    const wall_place_t y_and_x[2] = {room[0], place_of(lying)}, z_and_x[2] = {room[3], y_and_x[1]};
    assert_string_equal(walk_up_name(walk_up(room, 3)), "-y");
    assert_string_equal(walk_up_name(walk_up(&room[1], 2)), "-y"); /* of equal ones y */
    assert_string_equal(walk_up_name(walk_up(y_and_x, 2)), "-y");
    assert_string_equal(walk_up_name(walk_up(z_and_x, 2)), "z");
    assert_string_equal(walk_up_name(walk_up(&room[3], 1)), "z");
    assert_string_equal(walk_up_name((walk_up_t){0, 1}), "x");
    const walk_up_t up = walk_up(room, 3), up_z = {2, 1};
    assert_near("eye, y down", walk_eye_mm(room, 3, up, 1700), -1700, 1e-3);
    assert_near("eye, z up", walk_eye_mm(&room[3], 1, up_z, 1500), 1500, 1e-3);
}

static void assert_area(walk_area_t area, double low_0, double high_0, double low_1, double high_1)
{
    assert_near("low of the first axis", area.low_mm[0], low_0, 1e-3);
    assert_near("high of the first axis", area.high_mm[0], high_0, 1e-3);
    assert_near("low of the second axis", area.low_mm[1], low_1, 1e-3);
    assert_near("high of the second axis", area.high_mm[1], high_1, 1e-3);
}

static void area_is_inside_the_walls_or_before_a_single_one(void **state)
{
    (void)state;
    const corners_t small = {{-600, -900, 0}, {600, -900, 0}, {600, 0, 0}, {-600, 0, 0}};
    const corners_t tiny = {{-300, -900, 0}, {300, -900, 0}, {300, 0, 0}, {-300, 0, 0}};
    const wall_place_t room[2] = {place_of(front), place_of(left)};
    const wall_place_t small_wall = place_of(small), tiny_wall = place_of(tiny);
    const walk_up_t up = {1, -1};
    assert_area(walk_area(room, 2, up), -1900, 1900, -1900, 1900);
    assert_area(walk_area(room, 1, up), -1900, 1900, 2400 - 4800 + 500, 1900);
    assert_area(walk_area(&room[1], 1, up), -1900, 2400 - 500, -1900, 1900);
    assert_area(walk_area(&small_wall, 1, up), -100, 100, -2500, -500);
    assert_area(walk_area(&tiny_wall, 1, up), 0, 0, -2500, -500);
}

static void places_reach_the_edges(void **state)
{
    (void)state;
    const walk_area_t area = {{-100, 1000}, {200, 1600}};
    const walk_up_t up[3] = {{0, 1}, {1, -1}, {2, 1}};
    const double first[3][3] = {{7, -100, 1000}, {-100, 7, 1000}, {-100, 1000, 7}};
    const double second[3][3] = {{7, -50, 1000}, {-50, 7, 1000}, {-50, 1000, 7}};
    const double last[3][3] = {{7, 200, 1600}, {200, 7, 1600}, {200, 1600, 7}};
    for (int a = 0; a < 3; a++) {
        double eye_mm[3];
        walk_place(eye_mm, &area, up[a], 7, 0);
        assert_vector("first place", eye_mm, first[a][0], first[a][1], first[a][2]);
        walk_place(eye_mm, &area, up[a], 7, 1);
        assert_vector("second place", eye_mm, second[a][0], second[a][1], second[a][2]);
        walk_place(eye_mm, &area, up[a], 7, WALK_PLACES - 1);
        assert_vector("last place", eye_mm, last[a][0], last[a][1], last[a][2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wall_is_where_its_corners_are),
        cmocka_unit_test(viewer_looks_at_the_centre_upright),
        cmocka_unit_test(viewer_may_be_turned_round),
        cmocka_unit_test(straight_down_has_the_walls_top_above),
        cmocka_unit_test(up_is_where_most_tops_are),
        cmocka_unit_test(area_is_inside_the_walls_or_before_a_single_one),
        cmocka_unit_test(places_reach_the_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
