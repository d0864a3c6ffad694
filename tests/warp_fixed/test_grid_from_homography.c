// SPDX-License-Identifier: Apache-2.0
// The fixed-point grid against the float oracle: expected rows of the tree, and random walls, poses and points.
#include "warp_fixed/grid_from_homography.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "tests/support/oracle.h"
#include "warp_fixed/kernels.h"

/* The contract is 1/256; this is what grid_row.c proves. */
static const double grid_error_limit_px = 0.0022;
static grid_t grid;

typedef struct {
    uint64_t seed; /* of the present case */
    long points, inside, behind;
    double worst_px;
} tally_t;

/* The random scene of a seed, and its grid; rng goes on behind it. */
static void random_scene(oracle_scene_t *scene, rng_t *rng, uint64_t seed)
{
    *rng = (rng_t){seed};
    oracle_random_case(&scene->c, rng);
    if (!oracle_scene(scene))
        fail_msg("seed %lu: no homography", (unsigned long)seed);
    grid_from_homography(&grid, &scene->homography);
}

static void random_pixel(int32_t ij[2], rng_t *rng)
{
    ij[0] = (int32_t)rng_int(rng, 0, grid.panel_width - 1);
    ij[1] = (int32_t)rng_int(rng, 0, grid.panel_height - 1);
}

static bool near_edge(long double x, int32_t size)
{
    return fabsl(x) < 1.0L / 256 || fabsl(x - size) < 1.0L / 256;
}

static void check_point(tally_t *tally, const oracle_scene_t *scene, int32_t i, int32_t j)
{
    const camera_t *camera = &scene->c.camera;
    long double xy[2], depth;
    oracle_point(&scene->exact, i + 0.5L, j + 0.5L, xy, &depth);
    if (fabsl(depth) < 0.001L || near_edge(xy[0], camera->width) || near_edge(xy[1], camera->height))
        return;
    const bool inside = depth > 0 && xy[0] >= 0 && xy[0] <= camera->width && xy[1] >= 0 && xy[1] <= camera->height;
    int32_t x, y;
    const bool lit = grid_point(&grid, i, j, &x, &y);
    const bool got = lit && x >= 0 && x <= camera->width << 18 && y >= 0 && y <= camera->height << 18;
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
        rng_t rng;
        oracle_scene_t scene;
        tally.seed = seed;
        random_scene(&scene, &rng, seed);
        for (int n = 0; n < POINTS; n++) {
            int32_t ij[2];
            random_pixel(ij, &rng);
            if (oracle_incidence_deg(&scene.wall, &scene.c.pose, ij[0] + 0.5L, ij[1] + 0.5L) <= 85)
                check_point(&tally, &scene, ij[0], ij[1]);
        }
    }
    printf("%ld points of %d walls, %ld inside, %ld behind the viewer, worst error 1/%.0f px\n", tally.points, CASES,
           tally.inside, tally.behind, 1 / tally.worst_px);
    assert_true(tally.inside > 10000);
    assert_true(tally.behind > 1000);
}

/* The point of a pixel must be the one that the row's tiles give, in whatever order, by every table of loops. */
static void a_point_is_its_tiles_point(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        rng_t rng;
        oracle_scene_t scene;
        random_scene(&scene, &rng, seed);
        const warp_kernels_t *kernels = warp_kernels_levels[seed % WARP_KERNELS_LEVELS];
        for (int32_t j = 0; j < grid.panel_height; j += 97) {
            const grid_row_cursor_t row = grid_row_cursor(&grid, j);
            for (int32_t tile = grid.panel_width / GRID_MAX_SPAN; tile >= 0; tile--) {
                int32_t x[GRID_MAX_SPAN], y[GRID_MAX_SPAN], px, py;
                const int32_t first = tile * GRID_MAX_SPAN;
                const int32_t begin = first > row.row.begin ? first : row.row.begin;
                if (begin >= row.row.end || begin >= first + GRID_MAX_SPAN)
                    continue;
                const int32_t end = grid_row_tile_end(row.row, begin);
                assert_true(end > begin && end <= first + GRID_MAX_SPAN);
                kernels->grid_points(x, y, &row, begin, end);
                for (int32_t i = begin; i < end; i++) {
                    assert_true(grid_point(&grid, i, j, &px, &py));
                    if (px != x[i - begin] || py != y[i - begin])
                        fail_msg("seed %lu, %s, pixel (%d, %d)", (unsigned long)seed, kernels->name, i, j);
                }
            }
        }
    }
}

/* With c = M/2 in eq 2 the panel's corners lie on the markers: a wall that fills the picture maps centre to centre. */
static void frontal_wall_maps_pixel_centres_exactly(void **state)
{
    (void)state;
    oracle_scene_t scene = {.c = {.corners = {.panel_width = 1920,
                                              .panel_height = 1080,
                                              .corner_um = {{-2000000, -1125000, 0},
                                                            {2000000, -1125000, 0},
                                                            {2000000, 1125000, 0},
                                                            {-2000000, 1125000, 0}},
                                              .corner_known = {true, true, true, true}},
                                  .camera = {1920, 1080, {1200000000, 1200000000}, {960000000, 540000000}},
                                  .pose = {{0, 0, -2500000000}, {1 << 30, 0, 0, 0}}}};
    assert_true(oracle_scene(&scene));
    grid_from_homography(&grid, &scene.homography);
    for (int32_t j = 0; j < 1080; j += 13) {
        for (int32_t i = 0; i < 1920; i += 7) {
            int32_t x, y;
            assert_true(grid_point(&grid, i, j, &x, &y));
            assert_int_equal(x, (i << 18) + (1 << 17));
            assert_int_equal(y, (j << 18) + (1 << 17));
        }
    }
    assert_int_equal(homography_depth_um(&scene.homography, 1, 1), 2500000);
}

/* From the other side of the wall its picture is mirrored, whatever the roll, and only from there. */
static void a_wall_seen_from_behind_is_mirrored(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        rng_t rng = {seed};
        oracle_scene_t scene;
        oracle_random_case(&scene.c, &rng);
        assert_true(oracle_scene(&scene));
        const bool mirrored = homography_is_mirrored(&scene.homography);
        for (int k = 0; k < 3; k++) /* the eye to the other side of the plane */
            scene.c.pose.eye_nm[k] = llroundl((2 * scene.wall.through[k] - scene.c.pose.eye_nm[k] * 1e-9L) * 1e9L);
        assert_true(oracle_scene(&scene));
        assert_int_equal(homography_is_mirrored(&scene.homography), !mirrored);
    }
    oracle_scene_t frontal = {.c = {.corners = {.panel_width = 16,
                                                .panel_height = 9,
                                                .corner_um = {{-16000, -9000, 0}, {16000, -9000, 0}, {16000, 9000, 0}},
                                                .corner_known = {true, true, true, false}},
                                    .camera = {16, 9, {16000000, 16000000}, {8000000, 4500000}},
                                    .pose = {{0, 0, -1000000000}, {1 << 30, 0, 0, 0}}}};
    assert_true(oracle_scene(&frontal));
    assert_false(homography_is_mirrored(&frontal.homography));
}

/*
 * How far outside the picture a pixel's point is, in units of what its square reaches to either side. Negative depth,
 * and the few pixels next to the plane of depth 0, where derivatives say nothing about the square, are told apart.
 */
typedef enum { BEHIND, BETWEEN, IN_FRONT } place_t;

static place_t reaches_outside(const oracle_scene_t *scene, const int32_t ij[2], long double *reaches)
{
    const long double u = ij[0] + 0.5L, v = ij[1] + 0.5L;
    const long double *w_row = scene->exact.row[2];
    const long double w = w_row[0] * u + w_row[1] * v + w_row[2];
    const int32_t size[2] = {scene->c.camera.width, scene->c.camera.height};
    long double xy[2], depth;
    oracle_point(&scene->exact, u, v, xy, &depth);
    *reaches = 0;
    for (int a = 0; a < 2; a++) {
        const long double *row = scene->exact.row[a];
        const long double reach = (fabsl(row[0] - xy[a] * w_row[0]) + fabsl(row[1] - xy[a] * w_row[1])) / w / 2;
        *reaches = fmaxl(*reaches, fmaxl(fmaxl(-xy[a], xy[a] - size[a]), 0) / reach);
    }
    if (fabsl(w) < 8 * (fabsl(w_row[0]) + fabsl(w_row[1])))
        return BETWEEN;
    return depth > 0 ? IN_FRONT : BEHIND;
}

/* Lit: a superset of the pixels whose square can overlap the picture, larger by one pixel at most. */
static void lit_pixels_are_those_that_reach_the_picture(void **state)
{
    (void)state;
    long lit_count = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        rng_t rng;
        oracle_scene_t scene;
        random_scene(&scene, &rng, seed);
        for (int n = 0; n < 2000; n++) {
            int32_t ij[2], x, y;
            long double reaches;
            random_pixel(ij, &rng);
            const bool lit = grid_point(&grid, ij[0], ij[1], &x, &y);
            const place_t place = reaches_outside(&scene, ij, &reaches);
            const bool must = place == IN_FRONT && reaches <= 0.999L;
            const bool must_not = place == BEHIND || (place == IN_FRONT && reaches > 3);
            if ((must && !lit) || (must_not && lit))
                fail_msg("seed %lu, pixel (%d, %d): lit is %d, %.4Lf reaches outside", (unsigned long)seed, ij[0],
                         ij[1], lit, reaches);
            lit_count += lit;
        }
    }
    assert_true(lit_count > 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frontal_wall_maps_pixel_centres_exactly),
        cmocka_unit_test(a_wall_seen_from_behind_is_mirrored),
        cmocka_unit_test(a_point_is_its_tiles_point),
        cmocka_unit_test(lit_pixels_are_those_that_reach_the_picture),
        cmocka_unit_test(random_cases_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
