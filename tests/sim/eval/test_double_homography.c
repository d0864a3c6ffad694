// SPDX-License-Identifier: Apache-2.0
// The inverse homography takes picture points of random walls back to their panel points, and knows their depth.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "sim/eval/double_homography.h"
#include "tests/support/oracle.h"

static long double along(const double form[3], const long double xy[2])
{
    return (long double)form[0] * xy[0] + (long double)form[1] * xy[1] + (long double)form[2];
}

/* Panel point (u, v) of the wall, there and back. Points near or behind the viewer's plane are left out. */
static void check_point(uint64_t seed, const oracle_homography_t *oracle, const double_homography_t *h, long double u,
                        long double v)
{
    long double xy[2], depth_m;
    oracle_point(oracle, u, v, xy, &depth_m);
    if (depth_m < 0.05L)
        return;
    const long double a = along(h->panel_from_picture[0], xy), b = along(h->panel_from_picture[1], xy);
    const long double c = along(h->panel_from_picture[2], xy);
    const double u_error = (double)fabsl(a / c - u), v_error = (double)fabsl(b / c - v);
    const double depth_error = (double)fabsl(along(h->inverse_depth, xy) * depth_m - 1);
    if (!(c > 0 && u_error < 1e-6 && v_error < 1e-6 && depth_error < 1e-8))
        fail_msg("seed %llu, panel point %.1Lf, %.1Lf: c %g, off by %g and %g px, depth by %g",
                 (unsigned long long)seed, u, v, (double)c, u_error, v_error, depth_error);
}

static void random_walls_there_and_back(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 500; seed++) {
        rng_t rng = {seed};
        oracle_case_t random;
        oracle_random_case(&random, &rng);
        wall_t wall;
        homography_t fixed;
        assert_int_equal(wall_from_corners(&wall, &random.corners), WALL_OK);
        assert_true(homography_from_pose(&fixed, &random.camera, &wall, &random.pose));
        double_homography_t h;
        double_homography_from_fixed(&h, &fixed);
        assert_int_equal(h.panel_width, random.corners.panel_width);
        assert_int_equal(h.panel_height, random.corners.panel_height);
        assert_int_equal(h.picture_width, random.camera.width);
        assert_int_equal(h.picture_height, random.camera.height);
        oracle_wall_t oracle_plane;
        oracle_homography_t oracle;
        oracle_wall(&oracle_plane, &random.corners);
        oracle_homography(&oracle, &random.camera, &oracle_plane, &random.pose);
        for (int n = 0; n < 20; n++)
            check_point(seed, &oracle, &h, (long double)rng_double(&rng, 0, h.panel_width),
                        (long double)rng_double(&rng, 0, h.panel_height));
    }
}

static void eye_in_the_walls_plane_gives_zeros(void **state)
{
    (void)state;
    const wall_corners_t corners = {
        .panel_width = 1920,
        .panel_height = 1080,
        .corner_um = {{-2000000, -1125000, 0}, {2000000, -1125000, 0}, {2000000, 1125000, 0}, {-2000000, 1125000, 0}},
        .corner_known = {true, true, true, true},
    };
    const camera_t camera = {1920, 1080, {1200000000, 1200000000}, {960000000, 540000000}};
    const pose_t in_plane = {{5000000000, 300000000, 0}, {700000000, 100000000, -800000000, 30000000}};
    wall_t wall;
    homography_t fixed;
    assert_int_equal(wall_from_corners(&wall, &corners), WALL_OK);
    assert_true(homography_from_pose(&fixed, &camera, &wall, &in_plane));
    double_homography_t h;
    double_homography_from_fixed(&h, &fixed);
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            assert_true(h.panel_from_picture[r][k] == 0.0 && h.inverse_depth[k] == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_walls_there_and_back),
        cmocka_unit_test(eye_in_the_walls_plane_gives_zeros),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
