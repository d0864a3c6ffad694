// SPDX-License-Identifier: Apache-2.0
// What the eye sees of a wall that was corrected for another pose, against the picture.
#include "sim/study/latency_view.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/viewer_picture.h"

enum { LOOKS = 4, WHITE = 255 };

static image_t gray_image(uint8_t *data, int32_t width, int32_t height)
{
    return (image_t){.data = data, .width = width, .height = height, .stride = width, .format = IMAGE_GRAY8};
}

/* One viewer before one wall, and pictures to work in. */
typedef struct {
    warp_t *warp;
    uint8_t *memory;
    homography_t made_for;
    viewer_wall_t wall;
    image_t white, lit, seen; /* of the picture's size */
} bench_t;

static bool bench_open(bench_t *bench, const study_scene_t *scene)
{
    const int32_t width = scene->camera.width, height = scene->camera.height;
    const int32_t panel_width = scene->wall.panel_width, panel_height = scene->wall.panel_height;
    const size_t pixels = (size_t)width * (size_t)height;
    bench->warp = malloc(sizeof *bench->warp);
    bench->memory = malloc(3 * pixels + (size_t)panel_width * (size_t)panel_height);
    if (bench->warp == NULL || bench->memory == NULL)
        return false;
    bench->white = gray_image(bench->memory, width, height);
    bench->lit = gray_image(bench->memory + pixels, width, height);
    bench->seen = gray_image(bench->memory + 2 * pixels, width, height);
    bench->wall.shown = gray_image(bench->memory + 3 * pixels, panel_width, panel_height);
    memset(bench->white.data, WHITE, pixels);
    return true;
}

static void see(const bench_t *bench, const image_t *picture, const image_t *seen)
{
    const bool made =
        warp_frame(bench->warp, &warp_kernels_scalar, NULL, &bench->made_for, &bench->wall.shown, picture);
    assert(made);
    (void)made;
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
    static const uint8_t black[3] = {0, 0, 0};
    bench_t bench;
    homography_t seen_from;
    const bool made = bench_open(&bench, scene) &&
                      homography_from_pose(&bench.made_for, &scene->camera, &scene->wall, corrected) &&
                      homography_from_pose(&seen_from, &scene->camera, &scene->wall, eye);
    if (made) {
        double_homography_from_fixed(&bench.wall.homography, &seen_from);
        warp_init(bench.warp, *warp_method_default(), false, black);
        see(&bench, &bench.white, &bench.lit);
        see(&bench, picture, &bench.seen);
        add_squares(sum, &bench, picture);
    }
    free(bench.warp);
    free(bench.memory);
    return made;
}

double latency_psnr_db(const latency_square_t *sum)
{
    if (!(sum->square > 0.0))
        return HUGE_VAL;
    return 10.0 * log10(255.0 * 255.0 * (double)sum->pixels / sum->square);
}
