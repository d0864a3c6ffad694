// SPDX-License-Identifier: Apache-2.0
// One piece of work, done in each of the ways that are timed beside one another.
#ifndef TESTS_BENCH_X86_WORK_H
#define TESTS_BENCH_X86_WORK_H

#include <stdbool.h>

#include "hal/hal_workers.h"
#include "tests/bench/opencv.h"
#include "tests/bench/workload.h"
#include "warp_fixed/warp.h"

typedef struct {
    const char *name;
    const char *method;   /**< of the frame; NULL: the 7-tap Gaussian of the picture alone */
    opencv_work_t opencv; /**< what it is timed beside */
    const char *opencv_name;
    double at_least_db; /**< OpenCV's picture is that near to ours; 0 where it has no such method */
} x86_case_t;

enum { X86_CASES = 7 };

extern const x86_case_t x86_cases[X86_CASES];

typedef enum { X86_NEON, X86_OPENCV, X86_MEMCPY, X86_SCALAR, X86_WAYS } x86_way_t;

/** A case, a pose and a picture. */
typedef struct {
    const x86_case_t *work;
    const bench_pose_t *pose;
    homography_t homography;
    image_t picture, panel;
    warp_t *warp;
    hal_workers_t *workers; /**< ours; OpenCV has its own threads */
} x86_job_t;

/** Make job->warp ready for the job's case. @return false when there is no such method or filter. */
bool x86_prepare(const x86_job_t *job);

/**
 * Do the work once, in the panel or in job->warp.
 *
 * @return A view of the outcome, until the next call; its data is NULL when the work was refused.
 */
image_t x86_do(const x86_job_t *job, x86_way_t way);

/**
 * How near two outcomes of a job are to one another, dB; infinity when they are the same.
 *
 * Of warped pictures only pixels count whose point is 2 px or more within the picture: there is no border in them.
 */
double x86_psnr_db(const x86_job_t *job, const image_t *one, const image_t *other);

#endif
