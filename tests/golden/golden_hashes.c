// SPDX-License-Identifier: Apache-2.0
// Prints one line per case, "name hash": the bytes that every compiler, optimisation, CPU and table of loops must make.
//
// usage: golden_hashes LEVEL        the name of a table of loops (kernels.h), as scalar
//
// The reference is hashes.txt beside this file. No library, no file, no float: it runs wherever warp_fixed does.
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "warp_fixed/warp.h"

enum { PICTURE_WIDTH = 250, PICTURE_HEIGHT = 141, PANEL_WIDTH = 222, PANEL_HEIGHT = 125 };

typedef struct {
    const char *name;
    pose_t pose;
} viewpoint_t;

/* 2.5 m from a wall of 4 m x 2.25 m: straight, from 40 degrees rolled by 10, grazing, and close with roll 100. */
static const viewpoint_t viewpoints[4] = {
    {"straight", {{0, 0, -2500000000}, {1073741824, 0, 0, 0}}},
    {"turned", {{1606969024, 0, -1915111108}, {1005144571, 32007280, -365842660, 87938280}}},
    {"grazing", {{2462019383, 150000000, -434120444}, {822533959, 0, -690188097, 0}}},
    {"close", {{300000000, -200000000, -400000000}, {690188097, 30000000, 20000000, 822533959}}},
};

static const warp_kernels_t *kernels;
static warp_t warp;
static uint8_t picture_bytes[PICTURE_WIDTH * PICTURE_HEIGHT * 4], panel_bytes[PANEL_WIDTH * PANEL_HEIGHT * 4];

/* FNV-1a, 64 bits. */
static uint64_t hash_of(const void *bytes, size_t count)
{
    const uint8_t *byte = bytes;
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ byte[i]) * 0x100000001b3u;
    return hash;
}

/* Edges, ramps and noise. */
static void paint(void)
{
    uint32_t noise = 1;
    for (int y = 0; y < PICTURE_HEIGHT; y++) {
        for (int x = 0; x < PICTURE_WIDTH; x++) {
            for (int c = 0; c < 4; c++) {
                noise = noise * 1664525u + 1013904223u;
                const int pattern = (x / 16 + y / 16) % 3;
                const int level = pattern == 0   ? (int)(noise >> 24)
                                  : pattern == 1 ? (x * 5 + y * 3 + c * 40) % 256
                                                 : ((x ^ y) & 1) * 255;
                picture_bytes[(y * PICTURE_WIDTH + x) * 4 + c] = (uint8_t)level;
            }
        }
    }
}

static void print_frame(const viewpoint_t *viewpoint, const warp_method_t *method, image_format_t format)
{
    const wall_corners_t corners = {
        .panel_width = PANEL_WIDTH,
        .panel_height = PANEL_HEIGHT,
        .corner_um = {{-2000000, -1125000, 0}, {2000000, -1125000, 0}, {1950000, 1125000, 0}, {-2000000, 1105000, 0}},
        .corner_known = {true, true, true, true}};
    const camera_t camera = {PICTURE_WIDTH, PICTURE_HEIGHT, {156250000, 156666667}, {125000000, 70500000}};
    const uint8_t border[3] = {1, 2, 3};
    const image_t picture = {picture_bytes, PICTURE_WIDTH, PICTURE_HEIGHT, PICTURE_WIDTH * (int32_t)format, format};
    const image_t panel = {panel_bytes, PANEL_WIDTH, PANEL_HEIGHT, PANEL_WIDTH * (int32_t)format, format};
    wall_t wall;
    homography_t homography;
    warp_report_t report;
    memset(panel_bytes, 0, sizeof(panel_bytes));
    warp_init(&warp, *method, false, border);
    const bool made = wall_from_corners(&wall, &corners) == WALL_OK &&
                      homography_from_pose(&homography, &camera, &wall, &viewpoint->pose) &&
                      warp_frame(&warp, kernels, &report, &homography, &panel, &picture);
    printf("%s/%s/%s %016" PRIx64 " k_in %" PRId32 " k_all %" PRId32 " lit %" PRId32 "%s\n", viewpoint->name,
           method->name, format == IMAGE_GRAY8 ? "gray" : "xrgb", hash_of(panel_bytes, sizeof(panel_bytes)),
           report.k_in_q16, report.k_all_q16, report.lit_pixels, made ? "" : " NOT MADE");
}

/* Luma and chroma: cut from the same bytes, to where the panel's bytes go. */
static picture_t picture_in(uint8_t *bytes, picture_format_t format, int32_t width, int32_t height)
{
    const int32_t stride = format == PICTURE_NV12 ? width : format == PICTURE_XRGB8888 ? 4 * width : 2 * width;
    return (picture_t){.format = format,
                       .width = width,
                       .height = height,
                       .data = {bytes, bytes + stride * height},
                       .stride = {stride, width}};
}

static void print_yuv(const viewpoint_t *viewpoint, const warp_method_t *method, picture_format_t from,
                      picture_format_t to)
{
    static const char *const names[PICTURE_FORMATS] = {"xrgb", "gray", "rgb", "bgr", "yuyv", "uyvy", "nv12"};
    enum { WIDTH = PICTURE_WIDTH, HEIGHT = PICTURE_HEIGHT - 1, TO_HEIGHT = PANEL_HEIGHT - 1 };
    const wall_corners_t corners = {
        .panel_width = PANEL_WIDTH,
        .panel_height = TO_HEIGHT,
        .corner_um = {{-2000000, -1125000, 0}, {2000000, -1125000, 0}, {1950000, 1125000, 0}, {-2000000, 1105000, 0}},
        .corner_known = {true, true, true, true}};
    const camera_t camera = {WIDTH, HEIGHT, {156250000, 156666667}, {125000000, 70000000}};
    const uint8_t border[3] = {1, 2, 3};
    const picture_t picture = picture_in(picture_bytes, from, WIDTH, HEIGHT);
    const picture_t panel = picture_in(panel_bytes, to, PANEL_WIDTH, TO_HEIGHT);
    wall_t wall;
    homography_t homography;
    memset(panel_bytes, 0, sizeof(panel_bytes));
    warp_init(&warp, *method, false, border);
    const bool made = wall_from_corners(&wall, &corners) == WALL_OK &&
                      homography_from_pose(&homography, &camera, &wall, &viewpoint->pose) &&
                      warp_plan(&warp, kernels, NULL, &homography, &panel, &picture);
    for (warp_step_t step = WARP_MEASURE; made && step <= WARP_DRAW; step++)
        if (warp_needs(&warp, step))
            warp_work(&warp, step, only_worker);
    printf("%s/%s/%s to %s %016" PRIx64 "%s\n", viewpoint->name, method->name, names[from], names[to],
           hash_of(panel_bytes, sizeof(panel_bytes)), made ? "" : " NOT MADE");
}

/* Least-squares fits: interpolated, at the guard, and far from both. */
static void print_fits(void)
{
    static ls_t ls;
    const image_t picture = {picture_bytes, PICTURE_WIDTH, PICTURE_HEIGHT, PICTURE_WIDTH * 4, IMAGE_XRGB8888};
    ls_init(&ls);
    for (int32_t k_q16 = 1 << 16; k_q16 < 2000000; k_q16 = k_q16 * 3 / 2 + 1) {
        const ls_surface_t surface = ls_fit(&ls, kernels, &picture, k_q16);
        const size_t count = (size_t)surface.x->coefficients * (size_t)surface.y->coefficients * 4;
        printf("fit, k %" PRId32 " %016" PRIx64 "\n", k_q16, hash_of(surface.coefficients, count * sizeof(int32_t)));
    }
}

/* Those of the first sides, by phase, without what pads the rows. */
static void print_weights(void)
{
    enum { COUNT = PHASES * 256 };
    static int16_t weight[COUNT];
    static window_weights_t weights;
    window_weights_init(&weights, WARP_AREA, false);
    for (int32_t side = 0, at = 0; at < COUNT; side++) {
        const window_axis_t axis = window_axis(&weights, (uint16_t)side);
        for (int32_t phase = 0; phase < PHASES && at < COUNT; phase++)
            for (int32_t t = 0; t < axis.taps && at < COUNT; t++)
                weight[at++] = axis.second[((phase + axis.lead) & (PHASES - 1)) * axis.row + t];
    }
    printf("weights/area %016" PRIx64 "\n", hash_of(weight, sizeof weight));
}

int main(int argc, char **argv)
{
    kernels = warp_kernels_from_name(argc == 2 ? argv[1] : "");
    if (kernels == NULL) {
        fprintf(stderr, "golden_hashes: expected scalar or neon\n");
        return 2;
    }
    paint();
    for (int v = 0; v < 4; v++) {
        for (int m = 0; m < WARP_METHODS; m++) {
            print_frame(&viewpoints[v], &warp_methods[m], IMAGE_GRAY8);
            print_frame(&viewpoints[v], &warp_methods[m], IMAGE_XRGB8888);
        }
    }
    for (int m = 0; m < WARP_METHODS; m++) {
        print_yuv(&viewpoints[1], &warp_methods[m], PICTURE_NV12, PICTURE_NV12);
        print_yuv(&viewpoints[2], &warp_methods[m], PICTURE_UYVY, PICTURE_YUYV);
        print_yuv(&viewpoints[3], &warp_methods[m], PICTURE_YUYV, PICTURE_XRGB8888);
    }
    print_weights();
    for (warp_filter_t filter = WARP_FILTER_GAUSS; filter <= WARP_FILTER_BUTTER; filter++) {
        for (int32_t k_q16 = 70000; k_q16 < 4000000; k_q16 += 700000) {
            static fir_t fir;
            memset(&fir, 0, sizeof(fir));
            fir_design(&fir, filter, k_q16, filter == WARP_FILTER_KAISER);
            printf("filter %d, k %" PRId32 " %016" PRIx64 "\n", (int)filter, k_q16, hash_of(&fir, sizeof fir));
        }
    }
    print_fits();
    return 0;
}
