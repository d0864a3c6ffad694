// SPDX-License-Identifier: Apache-2.0
// One picture on one wall from one angle, with every method, seen through each model of pixels and wall.
#include "sim/study/intensity_see.h"

#include <stdlib.h>
#include <string.h>

#include "sim/eval/double_view.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/eval/pixel_view.h"
#include "sim/files/gray_image.h"

const intensity_model_t intensity_models[INTENSITY_MODELS] = {
    {"ideal", 1.0, 0.0, 1.0, 0.0},         {"dark gap", 0.85, 0.0, 1.0, 0.0},
    {"bright middle", 1.0, 1.0, 1.0, 0.0}, {"gap and bright middle", 0.85, 0.5, 1.0, 0.0},
    {"shining wall", 1.0, 0.0, 0.4, 1.6},  {"shining wall and both", 0.85, 0.5, 0.4, 1.6},
};
const double intensity_exponent = 6.0, intensity_projector_m[3] = {0.0, -1.0, -6.0};

/* Each row's panel. */
typedef struct {
    warp_t *warp;
    image_t panel[INTENSITY_ROWS];
} bench_t;

static bool bench_open(bench_t *bench, const intensity_place_t *place)
{
    const wall_t *wall = &place->scene->wall;
    *bench = (bench_t){.warp = malloc(sizeof *bench->warp)};
    bool made = bench->warp != NULL;
    for (int32_t row = 0; made && row <= place->methods; row++)
        made = gray_image(&bench->panel[row], wall->panel_width, wall->panel_height);
    return made;
}

static void bench_close(bench_t *bench)
{
    for (int32_t row = 0; row < INTENSITY_ROWS; row++)
        free(bench->panel[row].data);
    free(bench->warp);
}

static bool fill_panels(bench_t *bench, const intensity_place_t *place, const homography_t *homography,
                        const double_homography_t *seen)
{
    char error[FILE_ERROR_LENGTH];
    mesh_t mesh;
    if (!mesh_sample(&mesh, seen, place->picture, INTENSITY_FACTOR, error))
        return false;
    mesh_limit(&mesh, &bench->panel[place->methods]);
    mesh_free(&mesh);
    for (int32_t m = 0; m < place->methods; m++) {
        study_warp_begin(bench->warp, place->method[m]);
        study_warp_frame(bench->warp, homography, place->picture, &bench->panel[m]);
    }
    return true;
}

static pixel_model_t model_of(const intensity_model_t *of)
{
    pixel_model_t model = {.profile = {of->fill, of->falloff},
                           .screen = {.diffuse = of->diffuse, .lobe = of->lobe, .exponent = intensity_exponent}};
    memcpy(model.screen.projector_m, intensity_projector_m, sizeof intensity_projector_m);
    return model;
}

static bool see(intensity_seen_t *seen, const bench_t *bench, const intensity_place_t *place,
                const double_homography_t *homography, const intensity_model_t *of)
{
    const pixel_model_t model = model_of(of);
    const pose_t pose = study_pose(place->angle_deg);
    double_view_t eye;
    pixel_view_t view;
    double_view(&eye, &place->scene->camera, &pose);
    if (!pixel_view(&view, homography, &place->scene->wall, eye.eye_m, &model, INTENSITY_FACTOR))
        return false;
    seen->gain = view.mean_gain;
    for (int32_t row = 0; row <= place->methods; row++) {
        const pixel_psnr_t psnr = pixel_view_psnr(&view, &bench->panel[row], place->picture);
        seen->eye_db[row] = psnr.eye;
        seen->fine_db[row] = psnr.fine;
        seen->uneven_db[row] = psnr.uneven;
    }
    pixel_view_free(&view);
    return true;
}

bool intensity_see(intensity_seen_t *seen, const intensity_place_t *place)
{
    const pose_t pose = study_pose(place->angle_deg);
    homography_t homography;
    double_homography_t inverse;
    bench_t bench;
    bool made = bench_open(&bench, place) &&
                homography_from_pose(&homography, &place->scene->camera, &place->scene->wall, &pose);
    if (made) {
        double_homography_from_fixed(&inverse, &homography);
        made = fill_panels(&bench, place, &homography, &inverse);
    }
    for (int32_t model = 0; made && model < INTENSITY_MODELS; model++)
        made = see(&seen[model], &bench, place, &inverse, &intensity_models[model]);
    bench_close(&bench);
    return made;
}
