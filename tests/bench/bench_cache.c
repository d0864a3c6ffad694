// SPDX-License-Identifier: Apache-2.0
// Makes one frame of a picture turned about its middle, in tiles; tests/bench/bench_cache.sh counts its cache misses.
//
// usage: bench_cache METHOD ORDER DEGREES    prints how many pixels of the panel are lit
//
// ORDER is `frame` for one warp_frame(), whose walk is the library's, or COLUMNSxROWS: then each tile of the panel is a
// frame of its own, row of tiles by row of tiles; 1920x1 is a walk by rows. Only warp_frame() is between the markers.
// Not for methods that make another picture of the picture first: each tile would.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bench/markers.h"
#include "tests/bench/workload.h"
#include "warp_fixed/warp.h"

static warp_t warp;
static uint8_t picture_bytes[BENCH_PIXELS * 4], panel_bytes[BENCH_PIXELS * 4];

typedef struct {
    int32_t columns, rows;
} tile_size_t;

/* From indices of a tile that begins at panel pixel (i, j) to those of the picture, at the panel's own scale. */
static homography_t turned(double degrees, int32_t i, int32_t j, const image_t *tile)
{
    const double angle = degrees * acos(-1) / 180, c = cos(angle), s = sin(angle);
    const double middle_x = (BENCH_WIDTH - 1) / 2.0, middle_y = (BENCH_HEIGHT - 1) / 2.0;
    const double rows[3][3] = {{c, -s, middle_x + c * (i - middle_x) - s * (j - middle_y)},
                               {s, c, middle_y + s * (i - middle_x) + c * (j - middle_y)},
                               {0, 0, 1}};
    int64_t rows_q40[3][3];
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            rows_q40[r][k] = llround(ldexp(rows[r][k], 40));
    const int32_t panel[2] = {tile->width, tile->height}, picture[2] = {BENCH_WIDTH, BENCH_HEIGHT};
    homography_t homography;
    homography_from_indices(&homography, (const int64_t(*)[3])rows_q40, panel, picture);
    return homography;
}

/* @return lit pixels, or -1 when a tile was refused. */
static int32_t make_tiles(tile_size_t size, double degrees)
{
    const image_t picture = bench_image(picture_bytes, IMAGE_XRGB8888),
                  panel = bench_image(panel_bytes, picture.format);
    int32_t lit = 0;
    for (int32_t j = 0; j < panel.height; j += size.rows) {
        for (int32_t i = 0; i < panel.width; i += size.columns) {
            image_t tile = panel;
            tile.data = image_row(&panel, j) + i * (int32_t)panel.format;
            tile.width = i + size.columns < panel.width ? size.columns : panel.width - i;
            tile.height = j + size.rows < panel.height ? size.rows : panel.height - j;
            const homography_t homography = turned(degrees, i, j, &tile);
            warp_report_t report;
            bench_begin();
            const bool made = warp_frame(&warp, &warp_kernels_neon, &report, &homography, &tile, &picture);
            bench_end();
            if (!made)
                return -1;
            lit += report.lit_pixels;
        }
    }
    return lit;
}

static bool parse_order(const char *text, tile_size_t *size)
{
    *size = (tile_size_t){BENCH_WIDTH, BENCH_HEIGHT};
    if (strcmp(text, "frame") == 0)
        return true;
    char *rest;
    size->columns = (int32_t)strtol(text, &rest, 10);
    if (*rest != 'x')
        return false;
    size->rows = (int32_t)strtol(rest + 1, &rest, 10);
    return *rest == '\0' && size->columns >= 1 && size->columns <= BENCH_WIDTH && size->rows >= 1 &&
           size->rows <= BENCH_HEIGHT;
}

int main(int argc, char **argv)
{
    tile_size_t size;
    char *rest = NULL;
    const double degrees = argc == 4 ? strtod(argv[3], &rest) : 0;
    const warp_method_t *method = argc == 4 ? warp_method_from_name(argv[1]) : NULL;
    if (rest == NULL || *rest != '\0' || method == NULL || !parse_order(argv[2], &size)) {
        fprintf(stderr, "usage: bench_cache METHOD ORDER DEGREES     ORDER: frame, or COLUMNSxROWS\n");
        return 2;
    }
    const image_t picture = bench_image(picture_bytes, IMAGE_XRGB8888);
    const uint8_t black[3] = {0, 0, 0};
    bench_paint(&picture);
    warp_init(&warp, *method, false, black);
    const int32_t lit = make_tiles(size, degrees);
    if (lit < 0) {
        fprintf(stderr, "bench_cache: a tile was not made\n");
        return 1;
    }
    printf("%d\n", lit);
    return 0;
}
