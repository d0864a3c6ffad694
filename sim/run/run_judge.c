// SPDX-License-Identifier: Apache-2.0
// How good a shown wall is: PSNR seen from the viewer's eye, against the truth and against the limit of any method.
#include "sim/run/run_judge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sim/eval/mesh_psnr.h"
#include "sim/files/pixel.h"

enum { USUAL_FACTOR = 4, FINER_FACTOR = 8, MUCH_FINER_FACTOR = 16, MUCH_FINER = 3 };

static bool luma_copy(image_t *gray, const image_t *colour)
{
    *gray = (image_t){.width = colour->width, .height = colour->height, .stride = colour->width, .format = IMAGE_GRAY8};
    gray->data = malloc((size_t)gray->stride * (size_t)gray->height);
    if (gray->data == NULL)
        return false;
    for (int32_t y = 0; y < gray->height; y++) {
        const uint8_t *from = image_row(colour, y);
        uint8_t *to = image_row(gray, y);
        for (int32_t x = 0; x < gray->width; x++)
            to[x] = luma_from_rgb(from[4 * x + 2], from[4 * x + 1], from[4 * x]);
    }
    return true;
}

/* @return Whether the panel is that many times as fine as the picture, or more, along an axis. */
static bool is_finer(const run_judge_t *wall, int32_t times, int32_t more)
{
    return wall->shown->width >= times * wall->picture->width + more ||
           wall->shown->height >= times * wall->picture->height + more;
}

/* Samples per picture pixel, a multiple of q. */
static int32_t factor_for(const run_judge_t *wall, int32_t q)
{
    const int32_t wanted = is_finer(wall, MUCH_FINER, 0) ? MUCH_FINER_FACTOR
                           : is_finer(wall, 1, 1)        ? FINER_FACTOR
                                                         : USUAL_FACTOR;
    return (wanted + q - 1) / q * q;
}

typedef struct {
    const double_homography_t *homography;
    const image_t *truth, *panel, *limit; /* limit: scratch of the panel's size */
    int32_t factor;
} trial_t;

/* One truth: its PSNR as that kind, the limit as the next one. */
static bool try_truth(const trial_t *trial, run_psnr_t *psnr, run_db_t kind, char error[FILE_ERROR_LENGTH])
{
    mesh_t mesh;
    if (!mesh_sample(&mesh, trial->homography, trial->truth, trial->factor, error))
        return false;
    psnr->db[kind] = mesh_psnr_db(&mesh, trial->panel);
    mesh_limit(&mesh, trial->limit);
    psnr->db[kind + 1] = mesh_psnr_db(&mesh, trial->limit);
    psnr->coverage = mesh_coverage(&mesh);
    mesh_free(&mesh);
    return true;
}

static bool judge(run_psnr_t *psnr, const run_judge_t *wall, const image_t gray[3], char error[FILE_ERROR_LENGTH])
{
    double_homography_t homography;
    double_homography_from_fixed(&homography, wall->homography);
    trial_t trial = {.homography = &homography, .panel = &gray[0], .limit = &gray[2]};
    run_psnr_t found = *psnr;
    found.db[RUN_DB_ORIGINAL_PSNR] = (double)NAN;
    found.db[RUN_DB_ORIGINAL_LIMIT] = (double)NAN;
    if (wall->original != NULL) {
        trial.truth = wall->original;
        trial.factor = factor_for(wall, wall->original->width / wall->picture->width);
        if (!try_truth(&trial, &found, RUN_DB_ORIGINAL_PSNR, error))
            return false;
    }
    trial.truth = &gray[1];
    trial.factor = factor_for(wall, 1);
    if (!try_truth(&trial, &found, RUN_DB_PSNR, error))
        return false;
    *psnr = found;
    return true;
}

bool run_judge(run_psnr_t *psnr, const run_judge_t *wall, char error[FILE_ERROR_LENGTH])
{
    image_t gray[3] = {{.data = NULL}, {.data = NULL}, {.data = NULL}}; /* shown, picture, limit */
    bool ok =
        luma_copy(&gray[0], wall->shown) && luma_copy(&gray[1], wall->picture) && luma_copy(&gray[2], wall->shown);
    if (!ok)
        snprintf(error, FILE_ERROR_LENGTH, "judging: out of memory");
    ok = ok && judge(psnr, wall, gray, error);
    for (int i = 0; i < 3; i++)
        free(gray[i].data);
    return ok;
}
