// SPDX-License-Identifier: Apache-2.0
// One row of the CSV of wallwarp-eval psnr: exact sums, so that the rows of several walls add up to that of the view.
#ifndef SIM_EVAL_PSNR_ROW_H
#define SIM_EVAL_PSNR_ROW_H

#include <stdint.h>
#include <stdio.h>

#include "warp_fixed/footprint_from_homography.h"

typedef struct {
    const char *board;   /**< NULL for a table without this column */
    const char *channel; /**< NULL for a table without this column */
    const char *method;
    int64_t square_error, limit_square_error; /**< over the covered samples */
    int64_t covered, samples;
    footprint_step_t step;
} psnr_row_t;

/**
 * Add a wall's samples and errors to the row of the whole view; k becomes the larger one.
 *
 * @param view  Its names and number of samples are left as they are.
 */
void psnr_row_add(psnr_row_t *view, const psnr_row_t *wall);

/** Print the header of a table whose rows are like this one. */
void psnr_row_print_header(FILE *out, const psnr_row_t *row);

/** Print "[BOARD,][CHANNEL,]METHOD,psnr_db,limit_db,k_in,k_all,coverage". */
void psnr_row_print(FILE *out, const psnr_row_t *row);

#endif
