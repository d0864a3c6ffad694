// SPDX-License-Identifier: Apache-2.0
// One row of the CSV of wallwarp-eval psnr: exact sums, so that the rows of several walls add up to that of the view.
#include "sim/eval/psnr_row.h"

#include "sim/eval/mesh_psnr.h"

static int32_t larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

void psnr_row_add(psnr_row_t *view, const psnr_row_t *wall)
{
    view->square_error += wall->square_error;
    view->limit_square_error += wall->limit_square_error;
    view->covered += wall->covered;
    view->step.in_q16 = larger(view->step.in_q16, wall->step.in_q16);
    view->step.all_q16 = larger(view->step.all_q16, wall->step.all_q16);
}

void psnr_row_print_header(FILE *out, const psnr_row_t *row)
{
    fprintf(out, "%s%smethod,psnr_db,limit_db,k_in,k_all,coverage\n", row->board != NULL ? "board," : "",
            row->channel != NULL ? "channel," : "");
}

void psnr_row_print(FILE *out, const psnr_row_t *row)
{
    if (row->board != NULL)
        fprintf(out, "%s,", row->board);
    if (row->channel != NULL)
        fprintf(out, "%s,", row->channel);
    fprintf(out, "%s,%.3f,%.3f,%.4f,%.4f,%.4f\n", row->method, mesh_db((double)row->square_error, row->covered),
            mesh_db((double)row->limit_square_error, row->covered), row->step.in_q16 / 65536.0,
            row->step.all_q16 / 65536.0, (double)row->covered / (double)row->samples);
}
