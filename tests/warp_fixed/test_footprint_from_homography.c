// SPDX-License-Identifier: Apache-2.0
// Step k in closed form against the exhaustive search, and the sides of blocks against the float Jacobian.
#include "warp_fixed/footprint_from_homography.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "tests/support/oracle.h"

/* A 4 m x 2.25 m wall seen from 2.5 m, turned about the vertical axis. */
static void turned_scene(oracle_scene_t *scene, double degrees, int32_t panel_width, int32_t picture_width)
{
    const int32_t panel_height = panel_width * 9 / 16, picture_height = picture_width * 9 / 16;
    const double a = degrees / 57.29577951308232;
    scene->c = (oracle_case_t){
        .corners = {.panel_width = panel_width,
                    .panel_height = panel_height,
                    .corner_um = {{-2000000, -1125000, 0},
                                  {2000000, -1125000, 0},
                                  {2000000, 1125000, 0},
                                  {-2000000, 1125000, 0}},
                    .corner_known = {true, true, true, true}},
        .camera = {picture_width,
                   picture_height,
                   {picture_width * 625000LL, picture_width * 625000LL},
                   {picture_width * 500000LL, picture_height * 500000LL}},
        .pose = {{llround(2.5e9 * sin(a)), 0, llround(-2.5e9 * cos(a))},
                 {(int32_t)lround(cos(a / 2) * 1073741824.0), 0, (int32_t)lround(-sin(a / 2) * 1073741824.0), 0}}};
    assert_true(oracle_scene(scene));
}

/* Largest distance of neighbours' picture points; `in` counts only pairs that both land in the picture. */
static void exhaustive_step(const oracle_scene_t *scene, double *in, double *all)
{
    *in = *all = 0;
    const camera_t *camera = &scene->c.camera;
    for (int32_t j = 0; j < scene->c.corners.panel_height; j++) {
        for (int32_t i = 0; i < scene->c.corners.panel_width; i++) {
            long double here[2], depth;
            oracle_point(&scene->exact, i + 0.5L, j + 0.5L, here, &depth);
            for (int next = 0; next < 2; next++) {
                long double there[2], depth_there;
                const int32_t i2 = i + (next == 0), j2 = j + (next == 1);
                if (i2 >= scene->c.corners.panel_width || j2 >= scene->c.corners.panel_height)
                    continue;
                oracle_point(&scene->exact, i2 + 0.5L, j2 + 0.5L, there, &depth_there);
                const double distance = (double)hypotl(there[0] - here[0], there[1] - here[1]);
                const bool both_in = here[0] >= 0 && here[0] <= camera->width && here[1] >= 0 &&
                                     here[1] <= camera->height && there[0] >= 0 && there[0] <= camera->width &&
                                     there[1] >= 0 && there[1] <= camera->height;
                *all = fmax(*all, distance);
                if (both_in)
                    *in = fmax(*in, distance);
            }
        }
    }
}

static void closed_form_is_just_above_the_exhaustive_step(void **state)
{
    (void)state;
    const double limit[2] = {1.009, 1.017}; /* half a pixel is more of a small panel */
    const int32_t panel[2] = {1920, 480};
    for (int s = 0; s < 2; s++) {
        for (int degrees = 0; degrees <= 60; degrees += 15) {
            oracle_scene_t scene;
            double in, all;
            turned_scene(&scene, degrees, panel[s], 480);
            exhaustive_step(&scene, &in, &all);
            const footprint_step_t step = footprint_step(&scene.homography);
            const double in_ratio = step.in_q16 / 65536.0 / in, all_ratio = step.all_q16 / 65536.0 / all;
            printf("panel %d, %d degrees: k %.4f (exhaustive %.4f, x %.4f), of the whole wall %.4f (x %.4f)\n",
                   panel[s], degrees, step.in_q16 / 65536.0, in, in_ratio, step.all_q16 / 65536.0, all_ratio);
            assert_true(in_ratio > 0.99999 && in_ratio < limit[s]);
            assert_true(all_ratio > 0.99999 && all_ratio < limit[s]);
        }
    }
}

static void a_wall_out_of_view_has_no_step(void **state)
{
    (void)state;
    oracle_scene_t scene;
    turned_scene(&scene, 0, 480, 480);
    scene.c.pose.quaternion_q30[0] = 0; /* half a turn: the wall is behind */
    scene.c.pose.quaternion_q30[2] = 1 << 30;
    assert_true(oracle_scene(&scene));
    const footprint_step_t step = footprint_step(&scene.homography);
    assert_int_equal(step.in_q16, 0);
    assert_int_equal(step.all_q16, FOOTPRINT_MAX_STEP_Q16);
}

static void check_block(uint64_t seed, const oracle_scene_t *scene, const footprint_sides_t *found, const int32_t ij[2])
{
    const long double u = ij[0] + 0.5L, v = ij[1] + 0.5L, *w_row = scene->exact.row[2];
    const long double w = w_row[0] * u + w_row[1] * v + w_row[2];
    long double at[2], depth, sides[2];
    oracle_point(&scene->exact, u, v, at, &depth);
    for (int a = 0; a < 2; a++) {
        const long double *row = scene->exact.row[a];
        sides[a] = hypotl(row[0] - at[a] * w_row[0], row[1] - at[a] * w_row[1]) / w;
    }
    const double width = found->width_q16 / 65536.0, height = found->height_q16 / 65536.0;
    if (fabs(width - (double)sides[0]) > (double)sides[0] * 1e-6 + 1e-4 ||
        fabs(height - (double)sides[1]) > (double)sides[1] * 1e-6 + 1e-4)
        fail_msg("seed %lu, pixel (%d, %d): %f x %f, expected %Lf x %Lf", (unsigned long)seed, ij[0], ij[1], width,
                 height, sides[0], sides[1]);
}

/* Whole blocks only: at the rim the point moves to the nearest lit pixel. */
static void block_sides_are_the_jacobian_s_rows(void **state)
{
    (void)state;
    static grid_t grid;
    static footprint_blocks_t blocks;
    long checked = 0;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        rng_t rng = {seed};
        oracle_scene_t scene;
        oracle_random_case(&scene.c, &rng);
        assert_true(oracle_scene(&scene));
        grid_from_homography(&grid, &scene.homography);
        for (int32_t j = 0; j + FOOTPRINT_BAND <= grid.panel_height; j += 7 * FOOTPRINT_BAND) {
            const int log2 = footprint_block_log2(&grid, j), half = (1 << log2) / 2;
            footprint_blocks(&blocks, &grid, j, log2);
            for (int32_t b = blocks.begin; b < blocks.end; b++) {
                const int32_t ij[2] = {(b << log2) + half, j + (half > 0 ? half - 1 : 0)};
                int32_t x, y;
                if (!grid_point(&grid, ij[0], j, &x, &y) || !grid_point(&grid, ij[0], j + (1 << log2) - 1, &x, &y))
                    continue;
                check_block(seed, &scene, &blocks.block[b], ij);
                checked++;
            }
        }
    }
    assert_true(checked > 10000);
}

/* Over a block depth changes by 1/16 at most, and twice as large a block would break that, or 16 px. */
static void blocks_follow_the_perspective(void **state)
{
    (void)state;
    static grid_t grid;
    long of_size[5] = {0};
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        rng_t rng = {seed};
        oracle_scene_t scene;
        oracle_random_case(&scene.c, &rng);
        assert_true(oracle_scene(&scene));
        grid_from_homography(&grid, &scene.homography);
        const int32_t j = (int32_t)rng_int(&rng, 0, grid.panel_height / FOOTPRINT_BAND - 1) * FOOTPRINT_BAND;
        const long double *w_row = scene.exact.row[2];
        long double fastest = 0;
        for (int32_t row = j; row < j + FOOTPRINT_BAND; row++)
            for (int32_t i = grid.row[row].begin; i < grid.row[row].end; i++)
                fastest = fmaxl(fastest, fmaxl(fabsl(w_row[0]), fabsl(w_row[1])) /
                                             (w_row[0] * (i + 0.5L) + w_row[1] * (row + 0.5L) + w_row[2]));
        const int log2 = footprint_block_log2(&grid, j), size = 1 << log2;
        of_size[log2]++;
        if ((log2 > 0 && size * fastest > 1.0001L / 16) || (log2 < 4 && 2 * size * fastest < 0.9999L / 16))
            fail_msg("seed %lu, row %d: blocks of %d px, depth changes by %.6Lf a pixel", (unsigned long)seed, j, size,
                     fastest);
    }
    printf("blocks of 1, 2, 4, 8, 16 px: %ld %ld %ld %ld %ld times\n", of_size[0], of_size[1], of_size[2], of_size[3],
           of_size[4]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_form_is_just_above_the_exhaustive_step),
        cmocka_unit_test(a_wall_out_of_view_has_no_step),
        cmocka_unit_test(block_sides_are_the_jacobian_s_rows),
        cmocka_unit_test(blocks_follow_the_perspective),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
