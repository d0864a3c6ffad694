// SPDX-License-Identifier: Apache-2.0
// The camera for a moved eye against rays in floating point that meet the content's plane; and the cases at its ends.
#include "warp_fixed/camera_for_content.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/oracle.h"
#include "warp_fixed/grid_from_homography.h"
#include "warp_fixed/grid_row.h"

/* As for the picture's own pose: test_grid_from_homography.c. */
static const double grid_error_limit_px = 0.0022;
static grid_t grid;

/* A picture drawn for a pose, a viewer who has moved since, and the content's depth. */
typedef struct {
    oracle_case_t c;
    oracle_wall_t wall;
    wall_t fixed_wall;
    pose_t moved;
    int64_t depth_um;
} content_case_t;

/* The camera's axes in the world. */
static void rotation_of(long double rows[3][3], const int32_t q30[4])
{
    long double q[4], length = 0;
    for (int i = 0; i < 4; i++)
        length += (long double)q30[i] * q30[i];
    for (int i = 0; i < 4; i++)
        q[i] = q30[i] / sqrtl(length);
    const long double w = q[0], x = q[1], y = q[2], z = q[3];
    const long double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                                 {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                                 {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(rows, r, sizeof r);
}

static void turn(long double out[3], long double rotation[3][3], const long double world[3])
{
    for (int a = 0; a < 3; a++)
        out[a] = rotation[a][0] * world[0] + rotation[a][1] * world[1] + rotation[a][2] * world[2];
}

/* Where the picture shows what the moved eye should see at a panel point. @return false when that is not before it. */
static bool expected_point(const content_case_t *test, long double u, long double v, long double xy[2])
{
    long double rotation[3][3], to_eye[3], to_wall[3], c[3], y[3];
    rotation_of(rotation, test->c.pose.quaternion_q30);
    const long double weight = test->wall.weight[0] * u + test->wall.weight[1] * v + test->wall.weight[2];
    for (int a = 0; a < 3; a++) {
        const long double *point = test->wall.point[a];
        const long double eye = test->moved.eye_nm[a] * 1e-9L;
        to_wall[a] = (point[0] * u + point[1] * v + point[2]) / weight - eye;
        to_eye[a] = eye - test->c.pose.eye_nm[a] * 1e-9L;
    }
    turn(c, rotation, to_eye);
    turn(y, rotation, to_wall);
    if (y[2] < 0.001L)
        return false;
    const long double depth = test->depth_um * 1e-6L, along = (depth - c[2]) / y[2];
    for (int a = 0; a < 2; a++) {
        const long double focal = test->c.camera.focal_upx[a] * 1e-6L;
        xy[a] = focal * (c[a] + along * y[a]) / depth + test->c.camera.principal_upx[a] * 1e-6L;
    }
    return true;
}

/* @return false when the moved eye is too near to the wall for the figure. */
static bool random_content(content_case_t *test, rng_t *rng)
{
    oracle_random_case(&test->c, rng);
    oracle_wall(&test->wall, &test->c.corners);
    assert_int_equal(wall_from_corners(&test->fixed_wall, &test->c.corners), WALL_OK);
    test->moved = test->c.pose;
    test->depth_um = llround(exp(rng_double(rng, log(0.5e6), log(1e9)))); /* 0.5 m to 1 km */
    for (int a = 0; a < 3; a++)
        test->moved.eye_nm[a] += llround(0.28e9 * rng_double(rng, -1.0, 1.0)); /* below the least depth */
    return oracle_eye_distance_m(&test->wall, &test->moved) >= 0.3;
}

static bool near_edge(long double x, int32_t size)
{
    return fabsl(x) < 1.0L / 256 || fabsl(x - size) < 1.0L / 256;
}

static void random_cases_agree(void **state)
{
    (void)state;
    enum { CASES = 6000, POINTS = 12 };
    long inside_points = 0;
    double worst = 0.0;
    for (uint64_t seed = 1; seed <= CASES; seed++) {
        rng_t rng = {seed};
        content_case_t test;
        camera_t camera;
        homography_t homography;
        if (!random_content(&test, &rng))
            continue;
        if (!camera_for_content(&camera, &test.c.camera, &test.c.pose, test.moved.eye_nm, test.depth_um) ||
            !homography_from_pose(&homography, &camera, &test.fixed_wall, &test.moved))
            fail_msg("seed %d: no camera", (int)seed);
        grid_from_homography(&grid, &homography);
        for (int n = 0; n < POINTS; n++) {
            const int32_t i = (int32_t)rng_int(&rng, 0, grid.panel_width - 1);
            const int32_t j = (int32_t)rng_int(&rng, 0, grid.panel_height - 1);
            long double xy[2] = {-1, -1};
            const bool before = expected_point(&test, i + 0.5L, j + 0.5L, xy);
            const int32_t width = camera.width, height = camera.height;
            if (near_edge(xy[0], width) || near_edge(xy[1], height) ||
                oracle_incidence_deg(&test.wall, &test.moved, i + 0.5L, j + 0.5L) > 85)
                continue;
            const bool inside = before && xy[0] >= 0 && xy[0] <= width && xy[1] >= 0 && xy[1] <= height;
            int32_t x, y;
            const bool lit = grid_point(&grid, i, j, &x, &y);
            const bool got = lit && x >= 0 && x <= width << 18 && y >= 0 && y <= height << 18;
            if (got != inside)
                fail_msg("seed %d, pixel (%d, %d): inside is %d, expected %d", (int)seed, i, j, got, inside);
            if (!inside)
                continue;
            inside_points++;
            const double error = fmax(fabs((double)(x / 262144.0L - xy[0])), fabs((double)(y / 262144.0L - xy[1])));
            worst = fmax(worst, error);
            if (error > grid_error_limit_px)
                fail_msg("seed %d, pixel (%d, %d): (%f, %f), expected (%.6Lf, %.6Lf)", (int)seed, i, j, x / 262144.0,
                         y / 262144.0, xy[0], xy[1]);
        }
    }
    printf("%ld points inside, worst error 1/%.0f px\n", inside_points, 1 / worst);
    assert_true(inside_points > 5000);
}

/* 2.5 m before a wall, looking straight at it. */
static const camera_t full_hd = {1920, 1080, {1200000000, 1200000000}, {960000000, 540000000}};
static const pose_t before_wall = {{0, 0, -2500000000}, {1 << 30, 0, 0, 0}};

/* On the very plane of the wall the moved eye's camera gives the picture point of the eye that it was drawn for. */
static void content_on_the_wall_stays(void **state)
{
    (void)state;
    const wall_corners_t corners = {
        .panel_width = 1920,
        .panel_height = 1080,
        .corner_um = {{-2000000, -1125000, 0}, {2000000, -1125000, 0}, {2000000, 1125000, 0}},
        .corner_known = {true, true, true, false}};
    wall_t wall;
    assert_int_equal(wall_from_corners(&wall, &corners), WALL_OK);
    pose_t moved = before_wall;
    moved.eye_nm[0] += 300000000;
    moved.eye_nm[1] -= 100000000;
    moved.eye_nm[2] += 200000000;
    camera_t camera;
    assert_true(camera_for_content(&camera, &full_hd, &before_wall, moved.eye_nm, 2500000));
    homography_t homography;
    assert_true(homography_from_pose(&homography, &camera, &wall, &moved));
    grid_from_homography(&grid, &homography);
    for (int32_t j = 0; j < 1080; j += 97)
        for (int32_t i = 0; i < 1920; i += 61) {
            int32_t x, y;
            assert_true(grid_point(&grid, i, j, &x, &y));
            assert_true(abs(x - (i << 18) - (1 << 17)) < 64); /* 1/4096 px */
            assert_true(abs(y - (j << 18) - (1 << 17)) < 64);
        }
}

/* 0.3 m to the side: 1200 px * 0.3 / depth; nearer by half the depth: half the focal length. */
static void camera_is_the_formula(void **state)
{
    (void)state;
    camera_t camera = full_hd;
    assert_true(
        camera_for_content(&camera, &camera, &before_wall, (const int64_t[3]){300000000, 0, -1500000000}, 2000000));
    assert_int_equal(camera.focal_upx[0], 600000000);
    assert_int_equal(camera.focal_upx[1], 600000000);
    assert_int_equal(camera.principal_upx[0], 960000000 + 180000000);
    assert_int_equal(camera.principal_upx[1], 540000000);
    assert_int_equal(camera.width, 1920);
    /* far away it is the picture's own: 0.3 m of 500 km is less than 0.001 px */
    assert_true(camera_for_content(&camera, &full_hd, &before_wall, (const int64_t[3]){300000000, 0, -2500000000},
                                   INT64_C(500000000000)));
    assert_in_range(camera.principal_upx[0], 960000000, 960001000);
    assert_int_equal(camera.focal_upx[0], 1200000000);
    /* the drawn camera looks along the world's x axis: what is nearer is its z */
    const pose_t aside = {{0, 0, 0}, {1 << 30, 0, 1 << 30, 0}};
    assert_true(camera_for_content(&camera, &full_hd, &aside, (const int64_t[3]){500000000, 0, 0}, 2000000));
    assert_in_range(camera.focal_upx[0], 899999999, 900000001);
    assert_in_range(camera.principal_upx[0], 959999999, 960000001);
}

static void too_far_is_refused(void **state)
{
    (void)state;
    const struct {
        int64_t eye_nm[3], depth_um;
        bool fits;
    } cases[] = {
        {{0, 0, 875000000 - 2500000000}, 1000000, true}, /* an eighth of the depth is left */
        {{0, 0, 875000001 - 2500000000}, 1000000, false},
        {{0, 0, 1500000000}, 1000000, false}, /* behind the content */
        {{8000000000, 0, -2500000000}, 1000000, true},
        {{0, -8000000001, -2500000000}, 1000000, false},
        {{0, 0, -8000000001 - 2500000000}, 1000000, false},
        {{0, 0, -2500000000}, 0, false},
        {{0, 0, -2500000000}, -5, false},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        camera_t camera = {.width = 7};
        const bool fits = camera_for_content(&camera, &full_hd, &before_wall, cases[n].eye_nm, cases[n].depth_um);
        if (fits != cases[n].fits || (!fits && camera.width != 7))
            fail_msg("case %d: fits is %d, width %d", (int)n, fits, camera.width);
    }
    camera_t camera = {.width = 7};
    const pose_t none = {{0, 0, 0}, {0, 0, 0, 0}};
    assert_false(camera_for_content(&camera, &full_hd, &none, none.eye_nm, 1000000));
    assert_int_equal(camera.width, 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(camera_is_the_formula),
        cmocka_unit_test(content_on_the_wall_stays),
        cmocka_unit_test(too_far_is_refused),
        cmocka_unit_test(random_cases_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
