// SPDX-License-Identifier: Apache-2.0
// One method watched by a walking viewer, frame by frame.
#include "sim/study/flicker_watch.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/viewer_picture.h"

const double flicker_watch_hz = 60.0, flicker_watch_margin_px = 3.0;

/* What the eye sees of one frame; in covered, a byte for each pixel, 0 where no wall is. */
typedef struct {
    image_t picture;
    uint8_t *covered;
} seen_t;

typedef struct {
    warp_t *warp;
    uint8_t *memory; /* of all pictures */
    image_t panel;
    seen_t now, before;
} bench_t;

static image_t gray_image(uint8_t *data, int32_t width, int32_t height)
{
    return (image_t){.data = data, .width = width, .height = height, .stride = width, .format = IMAGE_GRAY8};
}

static bool bench_open(bench_t *bench, const study_scene_t *scene)
{
    const int32_t width = scene->camera.width, height = scene->camera.height;
    const int32_t panel_width = scene->wall.panel_width, panel_height = scene->wall.panel_height;
    const size_t pixels = (size_t)width * (size_t)height;
    warp_t *warp = malloc(sizeof *warp);
    uint8_t *memory = malloc(4 * pixels + (size_t)panel_width * (size_t)panel_height);
    if (warp == NULL || memory == NULL) {
        free(warp);
        free(memory);
        return false;
    }
    *bench = (bench_t){.warp = warp,
                       .memory = memory,
                       .now = {gray_image(memory, width, height), memory + pixels},
                       .before = {gray_image(memory + 2 * pixels, width, height), memory + 3 * pixels},
                       .panel = gray_image(memory + 4 * pixels, panel_width, panel_height)};
    return true;
}

static void bench_close(bench_t *bench)
{
    free(bench->warp);
    free(bench->memory);
}

static void see(bench_t *bench, const flicker_watch_t *watch, const pose_t *pose)
{
    homography_t homography;
    viewer_wall_t wall = {.shown = bench->panel};
    bool made = homography_from_pose(&homography, &watch->scene->camera, &watch->scene->wall, pose);
    made = made && warp_frame(bench->warp, &warp_kernels_scalar, NULL, &homography, &bench->panel, watch->picture);
    assert(made);
    (void)made;
    double_homography_from_fixed(&wall.homography, &homography);
    viewer_picture(&bench->now.picture, &wall, 1, watch->looks);
    memset(bench->now.covered, 1, (size_t)watch->picture->width * (size_t)watch->picture->height);
    flicker_mask(bench->now.covered, &wall.homography, flicker_watch_margin_px);
}

/* Both frames must be covered; where the earlier one was is not needed again. */
static void add_change(flicker_sums_t *sums, bench_t *bench)
{
    const ptrdiff_t pixels = (ptrdiff_t)bench->now.picture.width * bench->now.picture.height;
    for (ptrdiff_t n = 0; n < pixels; n++)
        bench->before.covered[n] &= bench->now.covered[n];
    flicker_add_change(sums, &bench->before.picture, &bench->now.picture, bench->before.covered);
}

bool flicker_watch(flicker_sums_t *sums, const flicker_watch_t *watch)
{
    static const uint8_t black[3] = {0, 0, 0};
    bench_t bench;
    if (!bench_open(&bench, watch->scene))
        return false;
    *sums = (flicker_sums_t){0};
    warp_init(bench.warp, *watch->method, false, black);
    for (int32_t frame = 0; frame < watch->frames; frame++) {
        const pose_t pose = flicker_walk_pose(&watch->walk, (frame - watch->frames / 2) / flicker_watch_hz);
        see(&bench, watch, &pose);
        flicker_add_sharpness(sums, &bench.now.picture, watch->picture, bench.now.covered);
        if (frame > 0)
            add_change(sums, &bench);
        const seen_t oldest = bench.before;
        bench.before = bench.now;
        bench.now = oldest;
    }
    bench_close(&bench);
    return true;
}
