// SPDX-License-Identifier: Apache-2.0
// Does one piece of the frame's work, once, between the two markers; tests/bench/bench_arm.sh counts its instructions.
//
// usage: bench_arm CASE FORMAT POSE KERNELS    prints over how many pixels the work is to be divided
//
// Picture and poses are those of workload.h. What is between the markers:
//   grid            grid_from_homography(), then the points of every lit pixel, 64 columns at a time, stored;
//   gauss, kaiser   prefilter_make_coefficients() of the picture with 7 taps, known before;
//   all others      a frame of the method, as the firmware makes most of them: without step k where the method has no
//                   filter, for its status needs it ten times a second only. bench_arm.sh leaves parts of the frame
//                   out, but not for frame:*.
// FORMAT nv12 is luma and chroma of picture and panel, all per pixel of the luma. bench_arm.sh counts gray, xrgb and
// nv12; yuyv and uyvy go to a panel of yuyv, yuyv-xrgb, nv12-xrgb, rgb888 and bgr888 to one of xrgb, for counts of
// one's own of whole frames.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bench/markers.h"
#include "tests/bench/workload.h"
#include "warp_fixed/homography_of_chroma.h"
#include "warp_fixed/warp.h"

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
static uint8_t picture_bytes[BENCH_PIXELS * 4], panel_bytes[BENCH_PIXELS * 4];
static int32_t points_x_q18[BENCH_PIXELS], points_y_q18[BENCH_PIXELS];

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

/* Of picture and panel. */
typedef struct {
    const char *name;
    picture_format_t picture, panel;
} formats_t;

static const formats_t formats[] = {
    {"gray", PICTURE_GRAY8, PICTURE_GRAY8},        {"xrgb", PICTURE_XRGB8888, PICTURE_XRGB8888},
    {"nv12", PICTURE_NV12, PICTURE_NV12},          {"nv12-xrgb", PICTURE_NV12, PICTURE_XRGB8888},
    {"yuyv", PICTURE_YUYV, PICTURE_YUYV},          {"uyvy", PICTURE_UYVY, PICTURE_YUYV},
    {"yuyv-xrgb", PICTURE_YUYV, PICTURE_XRGB8888}, {"rgb888", PICTURE_RGB888, PICTURE_XRGB8888},
    {"bgr888", PICTURE_BGR888, PICTURE_XRGB8888},
};

/* A picture or panel in `bytes`. */
static picture_t picture_in(uint8_t *bytes, picture_format_t format)
{
    static const int32_t pixel_bytes[PICTURE_FORMATS] = {4, 1, 3, 3, 2, 2, 1};
    return (picture_t){.format = format,
                       .width = BENCH_WIDTH,
                       .height = BENCH_HEIGHT,
                       .data = {bytes, bytes + BENCH_PIXELS},
                       .stride = {BENCH_WIDTH * pixel_bytes[format], BENCH_WIDTH}};
}

static int planes_of(const picture_t *picture)
{
    return picture_is_yuv(picture->format) ? 2 : 1;
}

/* The bytes of a picture that is no planes as a gray one's. */
static void paint(const picture_t *picture)
{
    const image_t bytes = {picture->data[0], picture->stride[0], picture->height, picture->stride[0], IMAGE_GRAY8};
    const bool is_planes =
        picture->format == PICTURE_GRAY8 || picture->format == PICTURE_XRGB8888 || picture->format == PICTURE_NV12;
    if (!is_planes)
        bench_paint(&bytes);
    for (int p = 0; is_planes && p < planes_of(picture); p++) {
        const image_t plane = picture_plane(picture, p);
        bench_paint(&plane);
    }
}

static void run_grid(const warp_kernels_t *kernels, const homography_t *homography, int planes)
{
    homography_t plane[2] = {*homography};
    homography_of_chroma(&plane[1], homography, (chroma_log2_t){1, 1}, (chroma_log2_t){1, 1});
    bench_begin();
    for (int p = 0; p < planes; p++) {
        grid_t *grid = &warp.plane[p].grid;
        grid_from_homography(grid, &plane[p]);
        for (int32_t j = 0; j < plane[p].panel_height; j++) {
            const grid_row_cursor_t row = grid_row_cursor(grid, j);
            int32_t *x_q18 = &points_x_q18[j * BENCH_WIDTH], *y_q18 = &points_y_q18[j * BENCH_WIDTH];
            for (int32_t begin = row.row.begin; begin < row.row.end;) {
                const int32_t end = grid_row_tile_end(row.row, begin);
                kernels->grid_points(x_q18 + begin, y_q18 + begin, &row, begin, end);
                begin = end;
            }
        }
    }
    bench_end();
}

static bool run_prefilter(const warp_kernels_t *kernels, const picture_t *picture, warp_filter_t filter)
{
    if (!bench_seven_taps(&warp.prefilter, filter))
        return false;
    bench_begin();
    for (int p = 0; p < planes_of(picture); p++) {
        const image_t plane = picture_plane(picture, p);
        prefilter_make_coefficients(&warp.prefilter, kernels, &plane, (level_t){0, 0, p}, only_worker);
    }
    bench_end();
    return true;
}

static bool run_frame(const warp_kernels_t *kernels, const homography_t *homography, const picture_t *picture,
                      const picture_t *panel, const char *method)
{
    const uint8_t border[3] = {0, 0, 0};
    warp_report_t report = {0};
    warp_init(&warp, *warp_method_from_name(method), false, border);
    bench_begin();
    const bool made = warp_plan(&warp, kernels, &report, homography, panel, picture);
    for (warp_step_t step = WARP_MEASURE; made && step <= WARP_DRAW; step++)
        if (warp_needs(&warp, step))
            warp_work(&warp, step, only_worker);
    bench_end();
    fprintf(stderr, "bench_arm: %.1f %% of the panel is lit\n", 100.0 * report.lit_pixels / BENCH_PIXELS);
    return made;
}

int main(int argc, char **argv)
{
    if (argc != 5) {
        fprintf(stderr, "usage: bench_arm CASE FORMAT POSE KERNELS\n");
        return 2;
    }
    const bench_case_t *work = find("case", argv[1], cases, sizeof cases / sizeof *cases, sizeof *cases);
    const bench_pose_t *pose = find("pose", argv[3], bench_poses, BENCH_POSES, sizeof *bench_poses);
    const warp_kernels_t *kernels = warp_kernels_from_name(argv[4]);
    if (kernels == NULL) {
        fprintf(stderr, "bench_arm: no kernels are called %s\n", argv[4]);
        return 2;
    }

    const formats_t *format = find("format", argv[2], formats, sizeof formats / sizeof *formats, sizeof *formats);
    const picture_t picture = picture_in(picture_bytes, format->picture);
    const picture_t panel = picture_in(panel_bytes, format->panel);
    const homography_t homography = bench_homography(pose->rows);
    paint(&picture);
    bool made = true;
    if (work->method != NULL)
        made = run_frame(kernels, &homography, &picture, &panel, work->method);
    else if (work->filter != WARP_FILTER_NONE)
        made = run_prefilter(kernels, &picture, work->filter);
    else
        run_grid(kernels, &homography, planes_of(&picture));
    if (!made) {
        fprintf(stderr, "bench_arm: the work was not done\n");
        return 1;
    }
    printf("%d\n", BENCH_PIXELS);
    return 0;
}
