// SPDX-License-Identifier: Apache-2.0
// One method watched by a walking viewer, frame by frame.
#include "sim/study/flicker_watch.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/viewer_picture.h"
#include "sim/files/gray_image.h"

const double flicker_watch_hz = 60.0, flicker_watch_margin_px = 3.0;

/* What the eye sees of one frame, and in covered 0 where no wall is. */
typedef struct {
    image_t picture, covered;
} seen_t;

typedef struct {
    warp_t *warp;
    image_t panel;
    seen_t now, before;
} bench_t;

static bool seen_open(seen_t *seen, const camera_t *camera)
{
    return gray_image(&seen->picture, camera->width, camera->height) &&
           gray_image(&seen->covered, camera->width, camera->height);
}

static void seen_close(seen_t *seen)
{
    free(seen->picture.data);
    free(seen->covered.data);
}

static bool bench_open(bench_t *bench, const study_scene_t *scene)
{
    *bench = (bench_t){.warp = malloc(sizeof *bench->warp)};
    return bench->warp != NULL && gray_image(&bench->panel, scene->wall.panel_width, scene->wall.panel_height) &&
           seen_open(&bench->now, &scene->camera) && seen_open(&bench->before, &scene->camera);
}

static void bench_close(bench_t *bench)
{
    seen_close(&bench->before);
    seen_close(&bench->now);
    free(bench->panel.data);
    free(bench->warp);
}

static void see(bench_t *bench, const flicker_watch_t *watch, const pose_t *pose)
{
    homography_t homography;
    viewer_wall_t wall = {.shown = bench->panel};
    const bool made = homography_from_pose(&homography, &watch->scene->camera, &watch->scene->wall, pose);
    assert(made);
    (void)made;
    study_warp_frame(bench->warp, &homography, watch->picture, &bench->panel);
    double_homography_from_fixed(&wall.homography, &homography);
    viewer_picture(&bench->now.picture, &wall, 1, watch->looks);
    memset(bench->now.covered.data, 1, (size_t)watch->picture->width * (size_t)watch->picture->height);
    flicker_mask(bench->now.covered.data, &wall.homography, flicker_watch_margin_px);
}

/* Both frames must be covered; where the earlier one was is not needed again. */
static void add_change(flicker_sums_t *sums, bench_t *bench)
{
    const ptrdiff_t pixels = (ptrdiff_t)bench->now.picture.width * bench->now.picture.height;
    for (ptrdiff_t n = 0; n < pixels; n++)
        bench->before.covered.data[n] &= bench->now.covered.data[n];
    flicker_add_change(sums, &bench->before.picture, &bench->now.picture, bench->before.covered.data);
}

bool flicker_watch(flicker_sums_t *sums, const flicker_watch_t *watch)
{
    bench_t bench;
    const bool opened = bench_open(&bench, watch->scene);
    if (opened) {
        *sums = (flicker_sums_t){0};
        study_warp_begin(bench.warp, watch->method);
    }
    for (int32_t frame = 0; opened && frame < watch->frames; frame++) {
        const pose_t pose = study_walk_pose(&watch->walk, (frame - watch->frames / 2) / flicker_watch_hz);
        see(&bench, watch, &pose);
        flicker_add_sharpness(sums, &bench.now.picture, watch->picture, bench.now.covered.data);
        if (frame > 0)
            add_change(sums, &bench);
        const seen_t oldest = bench.before;
        bench.before = bench.now;
        bench.now = oldest;
    }
    bench_close(&bench);
    return opened;
}
