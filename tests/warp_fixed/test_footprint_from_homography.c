// SPDX-License-Identifier: Apache-2.0
// Step k against the exhaustive search, and the sides of blocks against the float Jacobian.
#include "warp_fixed/footprint_from_homography.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "tests/support/oracle.h"
#include "warp_fixed/grid_row.h"

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

/* Largest distances of neighbours' picture points. */
typedef struct {
    double surely_in, maybe_in; /* without and with points within 10^-6 px of the picture's edge */
    double all;                 /* the limit when part of the panel is behind the viewer */
} exhaustive_t;

/* How far inside the picture a point is; below 0 outside and behind the viewer. */
static long double inside_px(const oracle_scene_t *scene, const long double xy[2], long double depth)
{
    const camera_t *camera = &scene->c.camera;
    if (depth <= 0)
        return -1;
    return fminl(fminl(xy[0], camera->width - xy[0]), fminl(xy[1], camera->height - xy[1]));
}

static exhaustive_t exhaustive_step(const oracle_scene_t *scene)
{
    const double limit = FOOTPRINT_MAX_STEP_Q16 / 65536.0;
    exhaustive_t found = {0, 0, 0};
    for (int32_t j = 0; j < scene->c.corners.panel_height; j++) {
        for (int32_t i = 0; i < scene->c.corners.panel_width; i++) {
            long double here[2], depth;
            oracle_point(&scene->exact, i + 0.5L, j + 0.5L, here, &depth);
            if (depth <= 0)
                found.all = limit;
            for (int next = 0; next < 2; next++) {
                long double there[2], depth_there;
                const int32_t i2 = i + (next == 0), j2 = j + (next == 1);
                if (i2 >= scene->c.corners.panel_width || j2 >= scene->c.corners.panel_height)
                    continue;
                oracle_point(&scene->exact, i2 + 0.5L, j2 + 0.5L, there, &depth_there);
                const double distance = fmin(limit, (double)hypotl(there[0] - here[0], there[1] - here[1]));
                const long double inside = fminl(inside_px(scene, here, depth), inside_px(scene, there, depth_there));
                found.all = fmax(found.all, distance);
                if (inside >= -1e-6L)
                    found.maybe_in = fmax(found.maybe_in, distance);
                if (inside >= 1e-6L)
                    found.surely_in = fmax(found.surely_in, distance);
            }
        }
    }
    return found;
}

/* Within 1/65536 px, 0 where there must be none. */
static bool step_agrees(int32_t found_q16, double least, double most)
{
    return found_q16 >= least * 65536 - 1 && found_q16 <= (most > 0 ? most * 65536 + 1 : 0);
}

static void check_step(const oracle_scene_t *scene, uint64_t seed, const exhaustive_t *expected)
{
    const footprint_step_t step = footprint_step(&scene->homography);
    if (!step_agrees(step.in_q16, expected->surely_in, expected->maybe_in) ||
        !step_agrees(step.all_q16, expected->all, expected->all))
        fail_msg("seed %lu, panel %d x %d: k %.6f, expected %.6f to %.6f; of the whole wall %.6f, expected %.6f",
                 (unsigned long)seed, scene->c.corners.panel_width, scene->c.corners.panel_height,
                 step.in_q16 / 65536.0, expected->surely_in, expected->maybe_in, step.all_q16 / 65536.0, expected->all);
}

/* Panels from one pixel to 480 x 270; every fourth viewer looks anywhere, also away. */
static void random_step_case(oracle_case_t *c, rng_t *rng)
{
    oracle_random_case(c, rng);
    const int64_t most = rng_int(rng, 0, 1) == 0 ? 8 : 77;
    const bool large = rng_int(rng, 0, 39) == 0;
    c->corners.panel_width = large ? 480 : rng_int(rng, 0, 9) == 0 ? 1 : (int32_t)rng_int(rng, 1, most);
    c->corners.panel_height = large ? 270 : rng_int(rng, 0, 9) == 0 ? 1 : (int32_t)rng_int(rng, 1, most);
    if (rng_int(rng, 0, 3) == 0)
        for (int k = 0; k < 4; k++)
            c->pose.quaternion_q30[k] = (int32_t)rng_int(rng, -(1 << 30), 1 << 30) | 1;
}

static void step_is_the_exhaustive_one(void **state)
{
    (void)state;
    long none = 0, part = 0, whole = 0, behind = 0;
    for (uint64_t seed = 1; seed <= 6000; seed++) {
        rng_t rng = {seed};
        oracle_scene_t scene;
        random_step_case(&scene.c, &rng);
        assert_true(oracle_scene(&scene));
        const exhaustive_t expected = exhaustive_step(&scene);
        check_step(&scene, seed, &expected);
        none += expected.maybe_in <= 0;
        part += expected.maybe_in > 0 && expected.maybe_in < expected.all;
        whole += expected.maybe_in > 0 && expected.maybe_in >= expected.all;
        behind += expected.all * 65536 >= FOOTPRINT_MAX_STEP_Q16;
    }
    printf("no pair in the picture %ld times, not the wall's widest %ld, the widest %ld; partly behind %ld\n", none,
           part, whole, behind);
    assert_true(none > 100 && part > 100 && whole > 100 && behind > 100);
}

static void step_of_turned_walls_is_the_exhaustive_one(void **state)
{
    (void)state;
    for (int width = 16; width <= 480; width *= width < 240 ? 15 : 2) {
        for (int degrees = 0; degrees <= 75; degrees += 15) {
            oracle_scene_t scene;
            turned_scene(&scene, degrees, width, 480);
            const exhaustive_t expected = exhaustive_step(&scene);
            check_step(&scene, (uint64_t)degrees, &expected);
        }
    }
}

/* Pixels of 0.7 m, 2.1 m away, one picture pixel wide; the outermost centres on the picture's edge, or past it. */
static void centres_on_the_picture_s_edge_are_in_it(void **state)
{
    (void)state;
    for (int32_t size = 2; size <= 60; size++) {
        const int32_t half_um = 350000 * size;
        oracle_scene_t scene = {
            .c = {.corners = {.panel_width = size,
                              .panel_height = size,
                              .corner_um = {{-half_um, -half_um, 0},
                                            {half_um, -half_um, 0},
                                            {half_um, half_um, 0},
                                            {-half_um, half_um, 0}},
                              .corner_known = {true, true, true, true}},
                  .camera = {size - 1, size - 1, {3000000, 3000000}, {500000LL * (size - 1), 500000LL * (size - 1)}},
                  .pose = {{0, 0, -2100000000}, {1 << 30, 0, 0, 0}}}};
        assert_true(oracle_scene(&scene));
        footprint_step_t step = footprint_step(&scene.homography);
        assert_int_equal(step.in_q16, 65536);
        assert_int_equal(step.all_q16, 65536);

        scene.c.camera.principal_upx[0] += 2; /* one pixel alone in the picture has no step */
        scene.c.camera.principal_upx[1] -= 2;
        assert_true(oracle_scene(&scene));
        step = footprint_step(&scene.homography);
        assert_int_equal(step.in_q16, size == 2 ? 0 : 65536);
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
        cmocka_unit_test(step_is_the_exhaustive_one),
        cmocka_unit_test(step_of_turned_walls_is_the_exhaustive_one),
        cmocka_unit_test(centres_on_the_picture_s_edge_are_in_it),
        cmocka_unit_test(a_wall_out_of_view_has_no_step),
        cmocka_unit_test(block_sides_are_the_jacobian_s_rows),
        cmocka_unit_test(blocks_follow_the_perspective),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
