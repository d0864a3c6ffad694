// SPDX-License-Identifier: Apache-2.0
// Does one piece of the frame's work, once, between the two markers; tests/bench/bench_arm.sh counts its instructions.
//
// usage: bench_arm CASE FORMAT POSE KERNELS    prints over how many pixels the work is to be divided
//
// Picture and panel are 1920 x 1080; the poses are two homographies that others have been measured with. What is
// between the markers:
//   grid            grid_from_homography(), then grid_block() and the points of every lit pixel, stored;
//   gauss, kaiser   prefilter_coefficients() of the picture with 7 taps, known before. Kaiser's filter is never as
//   short as
//                   that: it is given weights by hand, negative ones among them;
//   all others      warp_frame() of the method. bench_arm.sh leaves parts of it out, but not for frame:*.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/rng.h"
#include "tests/bench/markers.h"
#include "warp_fixed/warp.h"

enum { WIDTH = 1920, HEIGHT = 1080, SEVEN_TAPS_RADIUS = 3, SEVEN_TAPS_K_Q16 = 3 << 16 };

typedef struct {
    const char *name;
    double rows[3][3]; /* from panel index to picture index */
} bench_pose_t;

static const bench_pose_t poses[] = {
    {"strong",
     {{3.7348841250231346, 0.6585608410613063, -1563.3322761774},
      {0.045488238090270985, 2.3351236094295453, -73.443630957592021},
      {0.00082195784183178625, 0.00014493334451484484, 1}}},
    {"mild",
     {{1.184834322588556, -0.0093641519771932857, -53.656841584462413},
      {-0.0055509479337247343, 1.0899434500322718, 0.2924260259089646},
      {0.000068934240459625438, -0.000040289870583368484, 1}}},
};

typedef struct {
    const char *name;
    image_format_t format;
} bench_format_t;

static const bench_format_t formats[] = {{"gray", IMAGE_GRAY8}, {"xrgb", IMAGE_XRGB8888}};

typedef struct {
    const char *name;
    const char *method;   /* of the frame; NULL: */
    warp_filter_t filter; /* the prefilter alone, or for WARP_FILTER_NONE the grid */
} bench_case_t;

static const bench_case_t cases[] = {
    {"grid", NULL, WARP_FILTER_NONE},
    {"nearest", "none+nearest", WARP_FILTER_NONE},
    {"linear", "none+linear", WARP_FILTER_NONE},
    {"cubic", "none+cubic", WARP_FILTER_NONE},
    {"spline", "none+spline", WARP_FILTER_NONE},
    {"area", "area", WARP_FILTER_NONE},
    {"mean+cubic", "mean+cubic", WARP_FILTER_NONE},
    {"mean+spline", "mean+spline", WARP_FILTER_NONE},
    {"ls", "ls", WARP_FILTER_NONE},
    {"gauss", NULL, WARP_FILTER_GAUSS},
    {"kaiser", NULL, WARP_FILTER_KAISER},
    {"frame:area", "area", WARP_FILTER_NONE},
    {"frame:mean+cubic", "mean+cubic", WARP_FILTER_NONE},
};

static warp_t warp;
static uint8_t picture_bytes[WIDTH * HEIGHT * 4], panel_bytes[WIDTH * HEIGHT * 4];
static int32_t points_x_q18[WIDTH * HEIGHT], points_y_q18[WIDTH * HEIGHT];

/* The entry of that name in a table whose entries begin with a name, or the end of the program. */
static const void *find(const char *what, const char *name, const void *table, size_t count, size_t size)
{
    const char *entry_name;
    for (size_t i = 0; i < count; i++) {
        const char *entry = (const char *)table + i * size;
        memcpy(&entry_name, entry, sizeof entry_name);
        if (strcmp(entry_name, name) == 0)
            return entry;
    }
    fprintf(stderr, "bench_arm: there is no %s '%s'\n", what, name);
    exit(2);
}

static homography_t homography_of_pose(const bench_pose_t *pose)
{
    const int32_t size[2] = {WIDTH, HEIGHT};
    int64_t rows_q40[3][3];
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            rows_q40[r][k] = llround(ldexp(pose->rows[r][k], 40));
    homography_t homography;
    homography_from_indices(&homography, (const int64_t(*)[3])rows_q40, size, size);
    return homography;
}

/* Squares, ramps and noise; the same always. */
static void paint(uint8_t *bytes, int32_t channels)
{
    rng_t rng = {1};
    for (int32_t y = 0; y < HEIGHT; y++) {
        for (int32_t x = 0; x < WIDTH * channels; x++) {
            const int32_t square = (x / 64 + y / 16) % 3;
            const int64_t noise = rng_int(&rng, 0, 255);
            *bytes++ = (uint8_t)(square == 0 ? noise : square == 1 ? (x + 3 * y) % 256 : 255 * ((x + y) & 1));
        }
    }
}

static void run_grid(const warp_kernels_t *kernels, const homography_t *homography)
{
    grid_t *grid = &warp.grid;
    bench_begin();
    grid_from_homography(grid, homography);
    for (int32_t j = 0; j < HEIGHT; j++) {
        for (int32_t begin = grid->row[j].begin; begin < grid->row[j].end;) {
            const int32_t end = grid_block_end(grid, j, begin);
            const grid_quadratic_t block = grid_block(grid, j, begin, end);
            kernels->grid_points(&points_x_q18[j * WIDTH + begin], &points_y_q18[j * WIDTH + begin], &block,
                                 end - begin);
            begin = end;
        }
    }
    bench_end();
}

/* The filter is given as the one of the last k, so that none is designed. */
static bool run_prefilter(const warp_kernels_t *kernels, const image_t *picture, warp_filter_t filter)
{
    prefilter_t *prefilter = &warp.prefilter;
    prefilter->kind = (prefilter_kind_t){filter, SEVEN_TAPS_K_Q16, false};
    fir_design(&prefilter->fir, WARP_FILTER_GAUSS, SEVEN_TAPS_K_Q16, false);
    if (prefilter->fir.radius != SEVEN_TAPS_RADIUS)
        return false;
    if (filter == WARP_FILTER_KAISER) {
        const int16_t weight[] = {6398, 4608, 768, -383};
        memcpy(prefilter->fir.weight, weight, sizeof weight);
    }
    if (!prefilter_begin(prefilter, filter, SEVEN_TAPS_K_Q16, false))
        return false;
    bench_begin();
    const coefficients_t filtered = prefilter_coefficients(prefilter, kernels, picture, 0, 0);
    bench_end();
    return filtered.width == picture->width;
}

static bool run_frame(const warp_kernels_t *kernels, const homography_t *homography, const image_t *picture,
                      const char *method)
{
    const uint8_t border[3] = {0, 0, 0};
    image_t panel = *picture;
    panel.data = panel_bytes;
    warp_report_t report = {0};
    warp_init(&warp, *warp_method_from_name(method), false, border);
    bench_begin();
    const bool made = warp_frame(&warp, kernels, &report, homography, &panel, picture);
    bench_end();
    fprintf(stderr, "bench_arm: %.1f %% of the panel is lit\n", 100.0 * report.lit_pixels / (WIDTH * HEIGHT));
    return made;
}

int main(int argc, char **argv)
{
    if (argc != 5) {
        fprintf(stderr, "usage: bench_arm CASE FORMAT POSE KERNELS\n");
        return 2;
    }
    const bench_case_t *work = find("case", argv[1], cases, sizeof cases / sizeof *cases, sizeof *cases);
    const bench_format_t *format = find("format", argv[2], formats, sizeof formats / sizeof *formats, sizeof *formats);
    const bench_pose_t *pose = find("pose", argv[3], poses, sizeof poses / sizeof *poses, sizeof *poses);
    const warp_kernels_t *kernels = warp_kernels_from_name(argv[4]);
    if (kernels == NULL) {
        fprintf(stderr, "bench_arm: no kernels are called %s\n", argv[4]);
        return 2;
    }

    const int32_t channels = (int32_t)format->format;
    const image_t picture = {picture_bytes, WIDTH, HEIGHT, WIDTH * channels, format->format};
    const homography_t homography = homography_of_pose(pose);
    paint(picture_bytes, channels);
    bool made = true;
    if (work->method != NULL)
        made = run_frame(kernels, &homography, &picture, work->method);
    else if (work->filter != WARP_FILTER_NONE)
        made = run_prefilter(kernels, &picture, work->filter);
    else
        run_grid(kernels, &homography);
    if (!made) {
        fprintf(stderr, "bench_arm: the work was not done\n");
        return 1;
    }
    printf("%d\n", WIDTH * HEIGHT);
    return 0;
}
