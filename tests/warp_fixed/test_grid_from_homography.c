// SPDX-License-Identifier: Apache-2.0
// The fixed-point grid against the float oracle: expected rows of the tree, and random walls, poses and points.
#include "warp_fixed/grid_from_homography.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>
#include <stdio.h>

#include "tests/support/oracle.h"
#include "warp_fixed/kernels.h"

static const double grid_error_limit_px = 1.0 / 256;
static grid_t grid;

typedef struct {
    uint64_t seed; /* of the present case */
    long points, inside, behind;
    double worst_px;
} tally_t;

static bool near_edge(long double x, int32_t size)
{
    return fabsl(x) < 1.0L / 256 || fabsl(x - size) < 1.0L / 256;
}

static void check_point(tally_t *tally, const oracle_case_t *c, const oracle_homography_t *h, int32_t i, int32_t j)
{
    long double xy[2], depth;
    oracle_point(h, i + 0.5L, j + 0.5L, xy, &depth);
    if (fabsl(depth) < 0.001L || near_edge(xy[0], c->camera.width) || near_edge(xy[1], c->camera.height))
        return;
    const bool inside = depth > 0 && xy[0] >= 0 && xy[0] <= c->camera.width && xy[1] >= 0 && xy[1] <= c->camera.height;
    int32_t x, y;
    const bool lit = grid_point(&grid, i, j, &x, &y);
    const bool got = lit && x >= 0 && x <= c->camera.width << 18 && y >= 0 && y <= c->camera.height << 18;
    if (got != inside)
        fail_msg("seed %lu, pixel (%d, %d): inside is %d, expected %d at (%.6Lf, %.6Lf)", (unsigned long)tally->seed, i,
                 j, got, inside, xy[0], xy[1]);
    tally->points++;
    tally->behind += depth <= 0;
    if (!inside)
        return;
    tally->inside++;
    const double error = fmax(fabs((double)(x / 262144.0L - xy[0])), fabs((double)(y / 262144.0L - xy[1])));
    tally->worst_px = fmax(tally->worst_px, error);
    if (error > grid_error_limit_px)
        fail_msg("seed %lu, pixel (%d, %d): (%f, %f), expected (%.6Lf, %.6Lf), span 2^%d", (unsigned long)tally->seed,
                 i, j, x / 262144.0, y / 262144.0, xy[0], xy[1], grid.row[j].span_log2);
}

static void random_cases_agree(void **state)
{
    (void)state;
    enum { CASES = 12000, POINTS = 12 };
    tally_t tally = {0};
    for (uint64_t seed = 1; seed <= CASES; seed++) {
        rng_t rng = {seed};
        tally.seed = seed;
        oracle_case_t c;
        oracle_random_case(&c, &rng);
        wall_t wall;
        homography_t homography;
        if (wall_from_corners(&wall, &c.corners) != WALL_OK ||
            !homography_from_pose(&homography, &c.camera, &wall, &c.pose))
            fail_msg("seed %lu: no homography", (unsigned long)seed);
        grid_from_homography(&grid, &homography);
        oracle_wall_t exact_wall;
        oracle_homography_t exact;
        oracle_wall(&exact_wall, &c.corners);
        oracle_homography(&exact, &c.camera, &exact_wall, &c.pose);
        for (int n = 0; n < POINTS; n++) {
            const int32_t i = (int32_t)rng_int(&rng, 0, c.corners.panel_width - 1);
            const int32_t j = (int32_t)rng_int(&rng, 0, c.corners.panel_height - 1);
            if (oracle_incidence_deg(&exact_wall, &c.pose, i + 0.5L, j + 0.5L) <= 85)
                check_point(&tally, &c, &exact, i, j);
        }
    }
    printf("%ld points of %d walls, %ld inside, %ld behind the viewer, worst error 1/%.0f px\n", tally.points, CASES,
           tally.inside, tally.behind, 1 / tally.worst_px);
    assert_true(tally.inside > 10000);
    assert_true(tally.behind > 1000);
}

/* The point of a pixel must be the one that the row's blocks give, however the row is walked. */
static void a_point_is_its_blocks_point(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        rng_t rng = {seed};
        oracle_case_t c;
        wall_t wall;
        homography_t homography;
        oracle_random_case(&c, &rng);
        assert_int_equal(wall_from_corners(&wall, &c.corners), WALL_OK);
        assert_true(homography_from_pose(&homography, &c.camera, &wall, &c.pose));
        grid_from_homography(&grid, &homography);
        for (int32_t j = 0; j < grid.panel_height; j += 97) {
            const grid_row_t *row = &grid.row[j];
            for (int32_t begin = row->begin; begin < row->end;) {
                int32_t x[GRID_MAX_SPAN], y[GRID_MAX_SPAN], px, py;
                const int32_t end = grid_block_end(&grid, j, begin);
                const grid_quadratic_t block = grid_block(&grid, j, begin, end);
                assert_true(end > begin && end - begin <= GRID_MAX_SPAN);
                warp_kernels_scalar.grid_points(x, y, &block, end - begin);
                for (int32_t i = begin; i < end; i++) {
                    assert_true(grid_point(&grid, i, j, &px, &py));
                    if (px != x[i - begin] || py != y[i - begin])
                        fail_msg("seed %lu, pixel (%d, %d)", (unsigned long)seed, i, j);
                }
                begin = end;
            }
        }
    }
}

/* With c = M/2 in eq 2 the panel's corners lie on the markers: a wall that fills the picture maps centre to centre. */
static void frontal_wall_maps_pixel_centres_exactly(void **state)
{
    (void)state;
    const wall_corners_t corners = {
        .panel_width = 1920,
        .panel_height = 1080,
        .corner_um = {{-2000000, -1125000, 0}, {2000000, -1125000, 0}, {2000000, 1125000, 0}, {-2000000, 1125000, 0}},
        .corner_known = {true, true, true, true}};
    const camera_t camera = {1920, 1080, {1200000000, 1200000000}, {960000000, 540000000}};
    const pose_t pose = {{0, 0, -2500000000}, {1 << 30, 0, 0, 0}};
    wall_t wall;
    homography_t homography;
    assert_int_equal(wall_from_corners(&wall, &corners), WALL_OK);
    assert_true(homography_from_pose(&homography, &camera, &wall, &pose));
    grid_from_homography(&grid, &homography);
    for (int32_t j = 0; j < 1080; j += 13) {
        for (int32_t i = 0; i < 1920; i += 7) {
            int32_t x, y;
            assert_true(grid_point(&grid, i, j, &x, &y));
            assert_int_equal(x, (i << 18) + (1 << 17));
            assert_int_equal(y, (j << 18) + (1 << 17));
        }
    }
    assert_int_equal(homography_depth_um(&homography, 1, 1), 2500000);
}

/* Lit: a superset of the pixels whose square can overlap the picture, larger by one pixel at most. */
static void lit_pixels_are_those_that_reach_the_picture(void **state)
{
    (void)state;
    long lit_count = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        rng_t rng = {seed};
        oracle_case_t c;
        wall_t wall;
        homography_t homography;
        oracle_wall_t exact_wall;
        oracle_homography_t h;
        oracle_random_case(&c, &rng);
        assert_int_equal(wall_from_corners(&wall, &c.corners), WALL_OK);
        assert_true(homography_from_pose(&homography, &c.camera, &wall, &c.pose));
        grid_from_homography(&grid, &homography);
        oracle_wall(&exact_wall, &c.corners);
        oracle_homography(&h, &c.camera, &exact_wall, &c.pose);
        for (int n = 0; n < 2000; n++) {
            const int32_t i = (int32_t)rng_int(&rng, 0, c.corners.panel_width - 1);
            const int32_t j = (int32_t)rng_int(&rng, 0, c.corners.panel_height - 1);
            int32_t x, y;
            const bool lit = grid_point(&grid, i, j, &x, &y);
            long double xy[2], depth, reach[2];
            oracle_point(&h, i + 0.5L, j + 0.5L, xy, &depth);
            const long double w = h.row[2][0] * (i + 0.5L) + h.row[2][1] * (j + 0.5L) + h.row[2][2];
            long double beyond = 0; /* how far outside, in reaches of the pixel's square */
            const int32_t size[2] = {c.camera.width, c.camera.height};
            for (int a = 0; a < 2; a++) {
                reach[a] =
                    (fabsl(h.row[a][0] - xy[a] * h.row[2][0]) + fabsl(h.row[a][1] - xy[a] * h.row[2][1])) / w / 2;
                const long double outside = fmaxl(fmaxl(-xy[a], xy[a] - size[a]), 0);
                beyond = fmaxl(beyond, outside / reach[a]);
            }
            /* Within a few pixels of the plane of depth 0 the derivatives say nothing about the square. */
            if (fabsl(w) < 8 * (fabsl(h.row[2][0]) + fabsl(h.row[2][1])))
                continue;
            const bool overlaps = depth > 0 && beyond <= 0.999L;
            const bool far = depth < 0 || beyond > 3;
            if ((overlaps && !lit) || (far && lit))
                fail_msg("seed %lu, pixel (%d, %d): lit is %d, %.4Lf reaches outside at depth %.4Lf",
                         (unsigned long)seed, i, j, lit, beyond, depth);
            lit_count += lit;
        }
    }
    assert_true(lit_count > 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frontal_wall_maps_pixel_centres_exactly),
        cmocka_unit_test(a_point_is_its_blocks_point),
        cmocka_unit_test(lit_pixels_are_those_that_reach_the_picture),
        cmocka_unit_test(random_cases_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
