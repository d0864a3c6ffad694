// SPDX-License-Identifier: Apache-2.0
// One piece of work, done in each of the ways that are timed beside one another.
#include "tests/bench/x86_work.h"

#include <math.h>
#include <string.h>

#include "firmware/warp_steps.h"

enum { BORDER_PX = 2 };

/*
 * How near OpenCV's pictures are: it rounds points to 1/32 px, weights of the blur to 1/256, and its cubic kernel is
 * that of a = -3/4, not -1/2.
 */
const x86_case_t x86_cases[X86_CASES] = {
    {"nearest", "none+nearest", OPENCV_NEAREST, "nearest", 30},
    {"linear", "none+linear", OPENCV_LINEAR, "linear", 35},
    {"cubic", "none+cubic", OPENCV_CUBIC, "cubic", 28},
    {"area", "area", OPENCV_LINEAR, "linear", 0},
    {"mean+cubic", "mean+cubic", OPENCV_CUBIC, "cubic", 0},
    {"mean+spline", "mean+spline", OPENCV_CUBIC, "cubic", 0},
    {"gauss", NULL, OPENCV_GAUSSIAN_BLUR, "GaussianBlur", 40},
};

bool x86_prepare(const x86_job_t *job)
{
    if (job->work->method == NULL)
        return bench_seven_taps(&job->warp->prefilter, WARP_FILTER_GAUSS);
    const warp_method_t *method = warp_method_from_name(job->work->method);
    if (method == NULL)
        return false;
    const uint8_t black[3] = {0, 0, 0};
    warp_init(job->warp, *method, false, black);
    return true;
}

typedef struct {
    const x86_job_t *job;
    const warp_kernels_t *kernels;
} filtering_t;

static void filter_part(void *context, int32_t part, int32_t parts)
{
    const filtering_t *filtering = context;
    prefilter_make_pixels(&filtering->job->warp->prefilter, filtering->kernels, &filtering->job->picture, 0,
                          (worker_t){part, parts});
}

static image_t do_ours(const x86_job_t *job, const warp_kernels_t *kernels)
{
    if (job->work->method == NULL) {
        filtering_t filtering = {job, kernels};
        hal_workers_run(job->workers, filter_part, &filtering);
        return prefilter_pixels(&job->warp->prefilter, &job->picture, 0);
    }
    const picture_t panel = picture_from_image(&job->panel), picture = picture_from_image(&job->picture);
    if (!warp_plan(job->warp, kernels, NULL, &job->homography, &panel, &picture))
        return (image_t){.data = NULL};
    warp_steps_run(job->warp, job->workers);
    return job->panel;
}

static image_t do_opencv(const x86_job_t *job)
{
    if (job->work->opencv == OPENCV_GAUSSIAN_BLUR)
        opencv_gaussian_blur(bench_seven_taps_sigma(), &job->panel, &job->picture);
    else
        opencv_warp_perspective(job->work->opencv, job->pose->rows, &job->panel, &job->picture);
    return job->panel;
}

image_t x86_do(const x86_job_t *job, x86_way_t way)
{
    switch (way) {
    case X86_NEON:
        return do_ours(job, &warp_kernels_neon);
    case X86_SCALAR:
        return do_ours(job, &warp_kernels_scalar);
    case X86_OPENCV:
        return do_opencv(job);
    case X86_MEMCPY:
    case X86_WAYS:
        break;
    }
    memcpy(job->panel.data, job->picture.data, (size_t)job->picture.height * (size_t)job->picture.stride);
    return job->panel;
}

/* Does pixel (i, j) of the outcome come from the picture alone? */
static bool is_inside(const x86_job_t *job, int32_t i, int32_t j)
{
    if (job->work->method == NULL)
        return true;
    double at[3];
    for (int r = 0; r < 3; r++)
        at[r] = job->pose->rows[r][0] * i + job->pose->rows[r][1] * j + job->pose->rows[r][2];
    const double x = at[0] / at[2], y = at[1] / at[2];
    return at[2] > 0 && x >= BORDER_PX && x <= job->picture.width - 1 - BORDER_PX && y >= BORDER_PX &&
           y <= job->picture.height - 1 - BORDER_PX;
}

double x86_psnr_db(const x86_job_t *job, const image_t *one, const image_t *other)
{
    const int32_t channels = (int32_t)one->format;
    int64_t squares = 0, bytes = 0;
    for (int32_t j = 0; j < one->height; j++) {
        const uint8_t *a = image_row(one, j), *b = image_row(other, j);
        for (int32_t i = 0; i < one->width; i++) {
            if (!is_inside(job, i, j))
                continue;
            for (int32_t byte = i * channels; byte < (i + 1) * channels; byte++)
                squares += (a[byte] - b[byte]) * (a[byte] - b[byte]);
            bytes += channels;
        }
    }
    return 10 * log10(255.0 * 255.0 * (double)bytes / (double)squares);
}
