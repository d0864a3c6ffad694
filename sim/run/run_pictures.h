// SPDX-License-Identifier: Apache-2.0
// Two threads that make and write the pictures of a run while the boards go on; a bounded queue before them.
#ifndef SIM_RUN_RUN_PICTURES_H
#define SIM_RUN_RUN_PICTURES_H

#include <stdbool.h>

#include "sim/run/run_draw.h"
#include "sim/run/run_record.h"
#include "warp_fixed/picture.h"

typedef struct run_pictures run_pictures_t;

enum { RUN_PICTURES_THREADS = 2, RUN_PICTURES_JOBS = 6 };

/**
 * Start the threads. What is in the files never depends on them.
 *
 * @param config  Must outlive the threads, with all it points to.
 * @return NULL with the reason in error: no memory.
 */
run_pictures_t *run_pictures_start(const run_draw_config_t *config, char error[FILE_ERROR_LENGTH]);

/** @return Whether run_pictures_borrow() would return at once. */
bool run_pictures_ready(run_pictures_t *pictures);

/**
 * A free job, to be filled in and submitted: shown and picture are images of the right sizes, with any contents. Waits
 * for one.
 *
 * @return NULL when a job has failed; run_pictures_finish() then tells why.
 */
run_job_t *run_pictures_borrow(run_pictures_t *pictures);

/** Hand the borrowed job to the threads. */
void run_pictures_submit(run_pictures_t *pictures, run_job_t *job);

/**
 * Wait until every submitted job is done, end the threads and free everything. NULL is allowed, and is a success.
 *
 * @param[in,out] record  The judged walls are added to it, in order.
 * @param[out]    error   On failure: what failed first.
 */
bool run_pictures_finish(run_pictures_t *pictures, run_record_t *record, char error[FILE_ERROR_LENGTH]);

/** Copy the pixels of a picture of the same size, any format but GRAY8, to XRGB8888; a NULL one is black. */
void run_pictures_copy(const image_t *to, const picture_t *from);

#endif
