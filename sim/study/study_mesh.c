// SPDX-License-Identifier: Apache-2.0
// The mesh evaluation of all methods in one case of the study's room, and in a sweep of cases over the viewing angle.
#include "sim/study/study_mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/files/gray_image.h"
#include "sim/study/study_methods.h"

enum { SETTINGS_LENGTH = 3072 };

static bool fail(char error[FILE_ERROR_LENGTH], const study_mesh_case_t *at, const char *what)
{
    snprintf(error, FILE_ERROR_LENGTH, "%s, %d x %d, finer %d, at %g degrees: %.160s", study_image_name(at->image),
             at->sizes.picture_width, at->sizes.picture_height, at->finer, at->angle_deg, what);
    return false;
}

static bool sample_truths(study_mesh_t *mesh, const study_mesh_case_t *at, char error[FILE_ERROR_LENGTH])
{
    image_t original = {0};
    if (!study_image(at->image, at->sizes.picture_width, at->sizes.picture_height, at->finer, &mesh->picture,
                     at->finer > 1 ? &original : NULL))
        return fail(error, at, "no such picture, or out of memory");
    char reason[FILE_ERROR_LENGTH];
    bool ok = mesh_sample(&mesh->mesh[STUDY_TRUTH_PICTURE], &mesh->exact, &mesh->picture, at->factor, reason);
    if (ok && at->finer > 1)
        ok = mesh_sample(&mesh->mesh[STUDY_TRUTH_ORIGINAL], &mesh->exact, &original, at->factor, reason);
    free(original.data);
    return ok || fail(error, at, reason);
}

bool study_mesh_open(study_mesh_t *mesh, const study_mesh_case_t *at, char error[FILE_ERROR_LENGTH])
{
    study_scene_t scene;
    study_scene(&scene, &at->sizes);
    const pose_t pose = study_pose(at->angle_deg);
    study_mesh_t made = {0};
    if (!homography_from_pose(&made.homography, &scene.camera, &scene.wall, &pose))
        return fail(error, at, "no homography");
    double_homography_from_fixed(&made.exact, &made.homography);
    made.warp = malloc(sizeof *made.warp);
    const bool memory = made.warp != NULL && gray_image(&made.panel, at->sizes.panel_width, at->sizes.panel_height);
    if (!memory || !sample_truths(&made, at, error)) {
        study_mesh_close(&made);
        return memory ? false : fail(error, at, "out of memory");
    }
    *mesh = made;
    return true;
}

void study_mesh_close(study_mesh_t *mesh)
{
    for (int truth = 0; truth < STUDY_TRUTHS; truth++)
        mesh_free(&mesh->mesh[truth]);
    free(mesh->picture.data);
    free(mesh->panel.data);
    free(mesh->warp);
    *mesh = (study_mesh_t){0};
}

void study_mesh_warp(study_mesh_t *mesh, int method)
{
    study_warp_begin(mesh->warp, &warp_methods[method]);
    study_warp_frame(mesh->warp, &mesh->homography, &mesh->picture, &mesh->panel);
}

static double psnr_db(const study_mesh_t *mesh, int truth)
{
    return mesh->mesh[truth].cell != NULL ? mesh_psnr_db(&mesh->mesh[truth], &mesh->panel) : (double)NAN;
}

void study_mesh_measure(study_mesh_run_t *run)
{
    study_mesh_t mesh;
    run->error[0] = '\0';
    if (!study_mesh_open(&mesh, &run->at, run->error))
        return;
    const footprint_step_t step = footprint_step(&mesh.homography);
    study_mesh_result_t *found = &run->found;
    found->k_in = step.in_q16 / 65536.0;
    found->k_all = step.all_q16 / 65536.0;
    found->coverage = mesh_coverage(&mesh.mesh[STUDY_TRUTH_PICTURE]);
    for (int truth = 0; truth < STUDY_TRUTHS; truth++) {
        if (mesh.mesh[truth].cell != NULL)
            mesh_limit(&mesh.mesh[truth], &mesh.panel);
        found->limit_db[truth] = psnr_db(&mesh, truth);
    }
    for (int m = 0; m < WARP_METHODS; m++) {
        if (study_measures(m))
            study_mesh_warp(&mesh, m);
        for (int truth = 0; truth < STUDY_TRUTHS; truth++)
            found->psnr_db[truth][m] = study_measures(m) ? psnr_db(&mesh, truth) : (double)NAN;
    }
    study_mesh_close(&mesh);
}

static void measure_one(void *context, int32_t index)
{
    study_mesh_run_t *run = context;
    study_mesh_measure(&run[index]);
}

bool study_mesh_measure_all(study_t *study, study_mesh_run_t *run, int32_t runs)
{
    study_parallel(study, runs, measure_one, run);
    for (int32_t n = 0; n < runs; n++)
        if (run[n].error[0] != '\0')
            study_fail(study, "%s", run[n].error);
    return !study_failed(study);
}

bool study_mesh_sweep(study_mesh_sweep_t *sweep, study_t *study, const study_mesh_case_t *place, int32_t places,
                      double step_deg)
{
    const int32_t angles = (int32_t)floor(STUDY_MESH_MAX_ANGLE_DEG / step_deg + 1e-9) + 1, count = places * angles;
    study_mesh_run_t *run = study_memory(study, (size_t)count * sizeof *run);
    if (run == NULL)
        return false;
    for (int32_t n = 0; n < count; n++) {
        run[n].at = place[n / angles];
        run[n].at.angle_deg = n % angles * step_deg;
    }
    if (!study_mesh_measure_all(study, run, count)) {
        free(run);
        return false;
    }
    *sweep = (study_mesh_sweep_t){.run = run, .places = places, .angles = angles, .count = count, .step_deg = step_deg};
    return true;
}

study_mesh_sweep_t study_mesh_places(const study_mesh_sweep_t *sweep, int32_t first, int32_t places)
{
    study_mesh_sweep_t part = *sweep;
    part.run += first * sweep->angles;
    part.places = places;
    part.count = places * sweep->angles;
    return part;
}

void study_mesh_section(study_t *study, const char *title, const study_mesh_sweep_t *sweep)
{
    char text[SETTINGS_LENGTH] = "";
    size_t used = 0;
    for (int32_t p = 0; p < sweep->places && used < sizeof text; p++) {
        const study_mesh_case_t *at = &sweep->run[p * sweep->angles].at;
        const study_sizes_t *sizes = &at->sizes;
        char original[64] = "";
        if (at->finer > 1)
            snprintf(original, sizeof original, ", original of %d x %d", sizes->picture_width * at->finer,
                     sizes->picture_height * at->finer);
        used += (size_t)snprintf(text + used, sizeof text - used, "%s %d x %d%s on a projector of %d x %d, S = %d; ",
                                 study_image_name(at->image), sizes->picture_width, sizes->picture_height, original,
                                 sizes->panel_width, sizes->panel_height, at->factor);
    }
    study_section(study, title, "%sviewer at 0 to %g degrees in steps of %g; k over pixels in the picture.", text,
                  sweep->step_deg * (sweep->angles - 1), sweep->step_deg);
}
