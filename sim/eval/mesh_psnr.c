// SPDX-License-Identifier: Apache-2.0
// The paper's mesh evaluation: how well what a wall shows, seen from the viewer's eye, matches the true picture.
#include "sim/eval/mesh_psnr.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* One row of samples: (a, b, c) of sample k is at_start + (k + 1/2) step. */
typedef struct {
    double at_start[3];
    double step[3];
} sample_row_t;

static sample_row_t sample_row(const double_homography_t *homography, double y, int32_t factor)
{
    sample_row_t row;
    for (int r = 0; r < 3; r++) {
        row.step[r] = homography->panel_from_picture[r][0] / factor;
        row.at_start[r] = homography->panel_from_picture[r][1] * y + homography->panel_from_picture[r][2];
    }
    return row;
}

/* `per` samples lie in each of the row's true pixels. */
static void add_row(mesh_t *mesh, const sample_row_t *row, const uint8_t *truth, int32_t truth_width, int32_t per)
{
    const double width = mesh->panel_width, height = mesh->panel_height;
    int64_t covered = 0, sum_of_squares = 0;
    for (int32_t x = 0; x < truth_width; x++) {
        const int64_t value = truth[x];
        for (int32_t k = 0; k < per; k++) {
            const double at = (double)x * per + k + 0.5;
            const double c = row->at_start[2] + at * row->step[2];
            if (!(c > 0.0))
                continue;
            const double u = (row->at_start[0] + at * row->step[0]) / c;
            const double v = (row->at_start[1] + at * row->step[1]) / c;
            if (!(u >= 0.0 && u < width && v >= 0.0 && v < height))
                continue;
            mesh_cell_t *cell = &mesh->cell[(int64_t)(int32_t)v * mesh->panel_width + (int32_t)u];
            cell->count++;
            cell->sum += value;
            covered++;
            sum_of_squares += value * value;
        }
    }
    mesh->covered += covered;
    mesh->sum_of_squares += sum_of_squares;
}

static bool sizes_fit(const double_homography_t *homography, const image_t *truth, int32_t factor,
                      char error[FILE_ERROR_LENGTH])
{
    const int32_t width = homography->picture_width, height = homography->picture_height;
    const int32_t finer = truth->width / width;
    if (factor < 1 || factor > MESH_MAX_FACTOR) {
        snprintf(error, FILE_ERROR_LENGTH, "factor %d, expected 1 to %d", factor, MESH_MAX_FACTOR);
        return false;
    }
    if (finer < 1 || truth->width != finer * width || truth->height != finer * height) {
        snprintf(error, FILE_ERROR_LENGTH, "%d x %d pixels, expected a whole multiple of the picture's %d x %d",
                 truth->width, truth->height, width, height);
        return false;
    }
    if (factor % finer != 0) {
        snprintf(error, FILE_ERROR_LENGTH,
                 "factor %d, expected a multiple of %d: the original is %d times as fine as the picture", factor, finer,
                 finer);
        return false;
    }
    return true;
}

bool mesh_sample(mesh_t *mesh, const double_homography_t *homography, const image_t *truth, int32_t factor,
                 char error[FILE_ERROR_LENGTH])
{
    if (!sizes_fit(homography, truth, factor, error))
        return false;
    const size_t cells = (size_t)homography->panel_width * (size_t)homography->panel_height;
    mesh_t made = {.panel_width = homography->panel_width,
                   .panel_height = homography->panel_height,
                   .samples = (int64_t)homography->picture_width * homography->picture_height * factor * factor,
                   .cell = calloc(cells, sizeof *made.cell)};
    if (made.cell == NULL) {
        snprintf(error, FILE_ERROR_LENGTH, "out of memory for %zu projector pixels", cells);
        return false;
    }
    const int32_t per = factor / (truth->width / homography->picture_width);
    for (int32_t y = 0; y < homography->picture_height * factor; y++) {
        const sample_row_t row = sample_row(homography, (y + 0.5) / factor, factor);
        add_row(&made, &row, image_row(truth, y / per), truth->width, per);
    }
    *mesh = made;
    return true;
}

void mesh_free(mesh_t *mesh)
{
    free(mesh->cell);
    mesh->cell = NULL;
}

/* The sum of (truth - shown)^2 is that of truth^2 - 2 truth shown + shown^2; at most 2^36 samples: exact. */
double mesh_psnr_db(const mesh_t *mesh, const image_t *panel)
{
    int64_t error = mesh->sum_of_squares;
    for (int32_t j = 0; j < mesh->panel_height; j++) {
        const mesh_cell_t *cell = &mesh->cell[(int64_t)j * mesh->panel_width];
        const uint8_t *shown = image_row(panel, j);
        for (int32_t i = 0; i < mesh->panel_width; i++)
            error += shown[i] * (shown[i] * cell[i].count - 2 * cell[i].sum);
    }
    if (error == 0)
        return HUGE_VAL;
    return 10.0 * log10(255.0 * 255.0 * (double)mesh->covered / (double)error);
}

static uint8_t mean_of(const mesh_cell_t *cell)
{
    if (cell->count == 0)
        return 0;
    return (uint8_t)((2 * cell->sum + cell->count) / (2 * cell->count));
}

void mesh_limit(const mesh_t *mesh, const image_t *panel)
{
    for (int32_t j = 0; j < mesh->panel_height; j++) {
        const mesh_cell_t *cell = &mesh->cell[(int64_t)j * mesh->panel_width];
        uint8_t *best = image_row(panel, j);
        for (int32_t i = 0; i < mesh->panel_width; i++)
            best[i] = mean_of(&cell[i]);
    }
}

double mesh_coverage(const mesh_t *mesh)
{
    return (double)mesh->covered / (double)mesh->samples;
}
