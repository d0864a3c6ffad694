// SPDX-License-Identifier: Apache-2.0
// The points of rows of random grids: mild and steep perspective, turned, beside the picture, depth near 0.
#include <math.h>

#include "tests/kernels/check.h"

enum { GRIDS = 400, ROWS = 12, MAX_PANEL = 1920, MAX_PICTURE = 4096 };

static grid_t grid;

static int32_t random_size(rng_t *rng, int32_t limit)
{
    const int32_t most = limit >> rng_int(rng, 0, 6);
    return (int32_t)rng_int(rng, most / 2, most);
}

static void random_grid(rng_t *rng)
{
    const int32_t panel[2] = {random_size(rng, MAX_PANEL), random_size(rng, MAX_PANEL)};
    const int32_t picture[2] = {random_size(rng, MAX_PICTURE), random_size(rng, IMAGE_MAX_HEIGHT)};
    const double q40 = 1099511627776.0;
    const double zoom = exp2(rng_double(rng, -3, rng_int(rng, 0, 5) == 0 ? 9 : 1.5)) * picture[0] / panel[0];
    const double turn = rng_int(rng, 0, 3) == 0 ? 0 : rng_double(rng, -3.2, 3.2);
    const double a = zoom * cos(turn), b = zoom * sin(turn);
    const double tilt = exp2(-rng_double(rng, 0, rng_int(rng, 0, 2) == 0 ? 30 : 5));
    const double g = rng_double(rng, -2, 2) * tilt / panel[0], h = rng_double(rng, -2, 2) * tilt / panel[1];
    const double x = rng_double(rng, 0, 1) * picture[0], y = rng_double(rng, 0, 1) * picture[1];
    const double rows[3][3] = {{a, -b, x - a * panel[0] / 2 + b * panel[1] / 2},
                               {b, a, y - b * panel[0] / 2 - a * panel[1] / 2},
                               {g, h, 1 - g * panel[0] / 2 - h * panel[1] / 2}};
    int64_t rows_q40[3][3];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            rows_q40[r][c] = (int64_t)(rows[r][c] * q40);
    homography_t homography;
    homography_from_indices(&homography, (const int64_t(*)[3])rows_q40, panel, picture);
    grid_from_homography(&grid, &homography);
}

static void check_row(const warp_kernels_t *tested, const grid_row_cursor_t *row)
{
    static outputs_t x, y;
    for (int32_t begin = row->row.begin; begin < row->row.end;) {
        const int32_t end = grid_row_tile_end(row->row, begin);
        const size_t size = (size_t)(end - begin) * sizeof(int32_t);
        outputs_begin(&x, size);
        outputs_begin(&y, size);
        warp_kernels_scalar.grid_points(x.expected, y.expected, row, begin, end);
        tested->grid_points(x.found, y.found, row, begin, end);
        outputs_compare(&x);
        outputs_compare(&y);
        begin = end;
    }
}

void check_grid_points(const warp_kernels_t *tested)
{
    for (uint64_t seed = 1; seed <= GRIDS; seed++) {
        rng_t rng = {seed};
        random_grid(&rng);
        for (int n = 0; n < ROWS; n++) {
            const int32_t j = (int32_t)rng_int(&rng, 0, grid.panel_height - 1);
            const grid_row_cursor_t row = grid_row_cursor(&grid, j);
            check_case("grid_points, seed %d, row %d, blocks of 2^%d, fits 32 bits: %d", (int)seed, j,
                       row.row.span_log2, row.row.fits_32);
            check_row(tested, &row);
        }
    }
}
