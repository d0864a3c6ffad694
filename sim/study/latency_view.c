// SPDX-License-Identifier: Apache-2.0
// What the eye sees of a wall that was corrected for another pose, against the picture.
#include "sim/study/latency_view.h"

#include <stdlib.h>
#include <string.h>

#include "sim/eval/viewer_picture.h"
#include "sim/files/gray_image.h"

enum { LOOKS = 4, WHITE = 255 };

/* One viewer before one wall, and pictures to work in. */
typedef struct {
    warp_t *warp;
    homography_t made_for;
    viewer_wall_t wall;
    image_t white, lit, seen; /* of the picture's size */
} bench_t;

static bool bench_open(bench_t *bench, const study_scene_t *scene)
{
    const int32_t width = scene->camera.width, height = scene->camera.height;
    *bench = (bench_t){.warp = malloc(sizeof *bench->warp)};
    if (bench->warp == NULL || !gray_image(&bench->white, width, height) || !gray_image(&bench->lit, width, height) ||
        !gray_image(&bench->seen, width, height) ||
        !gray_image(&bench->wall.shown, scene->wall.panel_width, scene->wall.panel_height))
        return false;
    memset(bench->white.data, WHITE, (size_t)width * (size_t)height);
    return true;
}

static void bench_close(bench_t *bench)
{
    free(bench->wall.shown.data);
    free(bench->seen.data);
    free(bench->lit.data);
    free(bench->white.data);
    free(bench->warp);
}

static void see(const bench_t *bench, const image_t *picture, const image_t *seen)
{
    study_warp_frame(bench->warp, &bench->made_for, picture, &bench->wall.shown);
    viewer_picture(seen, &bench->wall, 1, LOOKS);
}

/* Where a white picture is seen white, the wall shows picture and nothing else. */
static void add_squares(latency_square_t *sum, const bench_t *bench, const image_t *picture)
{
    for (int32_t y = 0; y < picture->height; y++)
        for (int32_t x = 0; x < picture->width; x++) {
            if (image_row(&bench->lit, y)[x] != WHITE)
                continue;
            const int32_t off = image_row(&bench->seen, y)[x] - image_row(picture, y)[x];
            sum->square += off * off;
            sum->pixels++;
        }
}

bool latency_view_add(latency_square_t *sum, const study_scene_t *scene, const image_t *picture,
                      const pose_t *corrected, const pose_t *eye)
{
    bench_t bench;
    homography_t seen_from;
    const bool made = bench_open(&bench, scene) &&
                      homography_from_pose(&bench.made_for, &scene->camera, &scene->wall, corrected) &&
                      homography_from_pose(&seen_from, &scene->camera, &scene->wall, eye);
    if (made) {
        double_homography_from_fixed(&bench.wall.homography, &seen_from);
        study_warp_begin(bench.warp, warp_method_default());
        see(&bench, &bench.white, &bench.lit);
        see(&bench, picture, &bench.seen);
        add_squares(sum, &bench, picture);
    }
    bench_close(&bench);
    return made;
}
