// SPDX-License-Identifier: Apache-2.0
// What kernels.h says of patch_t: no point is further out than those of the four corners, by more than the slack.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "tests/support/oracle.h"
#include "warp_fixed/kernels.h"

enum { WIDTH = PATCH_MAX_WIDTH, HEIGHT = PATCH_MAX_HEIGHT, ONE = 1 << GRID_FRACTION_BITS };

static grid_t grid;

/* Lit pixels [left, right) of rows [top, bottom), within one tile. */
typedef struct {
    int32_t left, right, top, bottom;
} box_t;

typedef struct {
    uint64_t seed;                 /* of the present case */
    long patches, points, unknown; /* unknown: coordinates further beyond the picture than they are known */
    int32_t worst_q18;
} tally_t;

/* Any nine numbers, of all magnitudes: also maps that no wall and viewer give. */
static void wild_homography(homography_t *homography, rng_t *rng)
{
    static const int bits[3][3] = {{52, 52, 61}, {52, 52, 61}, {40, 40, 44}};
    const int32_t panel[2] = {(int32_t)rng_int(rng, 1, 2000), (int32_t)rng_int(rng, 1, 1200)};
    const int32_t picture[2] = {(int32_t)rng_int(rng, 1, IMAGE_MAX_WIDTH), (int32_t)rng_int(rng, 1, IMAGE_MAX_HEIGHT)};
    int64_t rows_q40[3][3];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            const int down = 64 - bits[r][c] + (int)rng_int(rng, 0, 26);
            rows_q40[r][c] = (int64_t)rng_next(rng) >> down;
        }
    }
    rows_q40[2][2] += (int64_t)rng_int(rng, 0, 1) << 40;
    homography_from_indices(homography, (const int64_t(*)[3])rows_q40, panel, picture);
}

/* @return false when no pixel of the tile's rows is lit in all of them. */
static bool random_box(box_t *box, int32_t row, int32_t column, rng_t *rng)
{
    const int32_t rows = grid.panel_height - row < HEIGHT ? grid.panel_height - row : HEIGHT;
    box->top = row + (int32_t)rng_int(rng, 0, rng_int(rng, 0, 1) ? 0 : rows - 1);
    box->bottom = (int32_t)rng_int(rng, box->top + 1, row + rows);
    box->left = column;
    box->right = column + WIDTH;
    for (int32_t j = box->top; j < box->bottom; j++) {
        box->left = grid.row[j].begin > box->left ? grid.row[j].begin : box->left;
        box->right = grid.row[j].end < box->right ? grid.row[j].end : box->right;
    }
    if (box->left >= box->right)
        return false;
    if (rng_int(rng, 0, 1))
        box->left = (int32_t)rng_int(rng, box->left, box->right - 1);
    if (rng_int(rng, 0, 1))
        box->right = (int32_t)rng_int(rng, box->left + 1, box->right);
    return true;
}

/* A coordinate as far as it is known, along an axis of the picture. */
static int32_t known_point(int32_t point, int32_t size)
{
    return clamp_i32(point, -PATCH_KNOWN_PX * ONE, (size + PATCH_KNOWN_PX) * ONE);
}

/* How far out a point is, beyond the corners. */
static int32_t further_out(int32_t point, const int32_t corner[4])
{
    int32_t least = corner[0], most = corner[0];
    for (int c = 1; c < 4; c++) {
        least = corner[c] < least ? corner[c] : least;
        most = corner[c] > most ? corner[c] : most;
    }
    return point < least ? least - point : point > most ? point - most : 0;
}

static void check_axis(tally_t *tally, const int32_t *points, const box_t *box, int32_t size, char axis)
{
    const int32_t width = box->right - box->left, height = box->bottom - box->top;
    const int32_t right = width - 1, below = (height - 1) * WIDTH;
    const int32_t corner[4] = {known_point(points[0], size), known_point(points[right], size),
                               known_point(points[below], size), known_point(points[below + right], size)};
    for (int32_t r = 0; r < height; r++) {
        for (int32_t k = 0; k < width; k++) {
            const int32_t point = points[r * WIDTH + k], known = known_point(point, size);
            const int32_t out_q18 = further_out(known, corner);
            tally->unknown += known != point;
            tally->worst_q18 = out_q18 > tally->worst_q18 ? out_q18 : tally->worst_q18;
            if (out_q18 > PATCH_SLACK_Q18)
                fail_msg("seed %lu, pixel (%d, %d), %c %.4f: %.4f px further out than the corners of columns %d to %d, "
                         "rows %d to %d",
                         (unsigned long)tally->seed, box->left + k, box->top + r, axis, (double)point / ONE,
                         (double)out_q18 / ONE, box->left, box->right - 1, box->top, box->bottom - 1);
        }
    }
    tally->points += width * height;
}

/* A patch of the tile that begins at this pixel, its points made as warp.c makes them. */
static void check_tile(tally_t *tally, int32_t row, int32_t column, rng_t *rng)
{
    int32_t x[HEIGHT * WIDTH], y[HEIGHT * WIDTH];
    box_t box;
    if (!random_box(&box, row, column, rng))
        return;
    for (int32_t j = box.top; j < box.bottom; j++) {
        const grid_row_cursor_t cursor = grid_row_cursor(&grid, j);
        const int32_t begin = cursor.row.begin > column ? cursor.row.begin : column;
        const int32_t end = cursor.row.end < column + WIDTH ? cursor.row.end : column + WIDTH;
        const int32_t at = (j - box.top) * WIDTH;
        int32_t row_x[WIDTH], row_y[WIDTH];
        warp_kernels_scalar.grid_points(row_x, row_y, &cursor, begin, end);
        memcpy(x + at, row_x + box.left - begin, (size_t)(box.right - box.left) * sizeof *x);
        memcpy(y + at, row_y + box.left - begin, (size_t)(box.right - box.left) * sizeof *y);
    }
    check_axis(tally, x, &box, grid.picture_width, 'x');
    check_axis(tally, y, &box, grid.picture_height, 'y');
    tally->patches++;
}

/* Where a homography lights anything: a tile there, else none. */
static void check_homography(tally_t *tally, const homography_t *homography, int tiles, rng_t *rng)
{
    grid_from_homography(&grid, homography);
    for (int n = 0; n < tiles; n++) {
        const int32_t j = (int32_t)rng_int(rng, 0, grid.panel_height - 1);
        const grid_row_t row = grid.row[j];
        if (row.begin < row.end)
            check_tile(tally, j & -HEIGHT, (int32_t)rng_int(rng, row.begin, row.end - 1) & -WIDTH, rng);
    }
}

static void print_tally(const tally_t *tally, const char *what)
{
    printf("%s: %ld patches, %ld coordinates, %ld of them unknown, %.5f px out at worst, %.5f allowed\n", what,
           tally->patches, tally->points, tally->unknown, tally->worst_q18 / (double)ONE,
           PATCH_SLACK_Q18 / (double)ONE);
}

static void patches_of_walls_keep_between_their_corners(void **state)
{
    (void)state;
    tally_t tally = {0};
    for (uint64_t seed = 1; seed <= 1500; seed++) {
        rng_t rng = {seed};
        oracle_scene_t scene;
        tally.seed = seed;
        oracle_random_case(&scene.c, &rng);
        assert_true(oracle_scene(&scene));
        check_homography(&tally, &scene.homography, 8, &rng);
    }
    print_tally(&tally, "walls");
    assert_true(tally.patches > 3000);
}

static void patches_of_wild_maps_keep_between_their_corners(void **state)
{
    (void)state;
    tally_t tally = {0};
    for (uint64_t seed = 1; seed <= 60000; seed++) {
        rng_t rng = {seed};
        homography_t homography;
        tally.seed = seed;
        wild_homography(&homography, &rng);
        check_homography(&tally, &homography, 4, &rng);
    }
    print_tally(&tally, "wild maps");
    assert_true(tally.patches > 3000);
    assert_true(tally.unknown > 3000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patches_of_walls_keep_between_their_corners),
        cmocka_unit_test(patches_of_wild_maps_keep_between_their_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
