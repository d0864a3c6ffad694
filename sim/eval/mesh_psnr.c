// SPDX-License-Identifier: Apache-2.0
// The paper's mesh evaluation: how well what a wall shows, seen from the viewer's eye, matches the true picture.
#include "sim/eval/mesh_psnr.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One wall along a row of samples: the form of a, b, c or 1 / depth at sample k is at_start + (k + 1/2) step. */
typedef struct {
    mesh_t *mesh;
    double at_start[4];
    double step[4];
} wall_row_t;

/* All walls along a row of samples; `per` samples lie in each of the row's true pixels. */
typedef struct {
    wall_row_t wall[MESH_MAX_WALLS];
    int32_t walls;
    const uint8_t *truth;
    int32_t truth_width, truth_pixel, per;
} sample_row_t;

static wall_row_t wall_row(mesh_t *mesh, const double_homography_t *homography, double y, int32_t factor)
{
    wall_row_t row = {.mesh = mesh};
    for (int r = 0; r < 4; r++) {
        const double *form = r < 3 ? homography->panel_from_picture[r] : homography->inverse_depth;
        row.step[r] = form[0] / factor;
        row.at_start[r] = form[1] * y + form[2];
    }
    return row;
}

/* The wall's pixel under a sample, or NULL. */
static mesh_cell_t *cell_at(const wall_row_t *row, double at)
{
    const mesh_t *mesh = row->mesh;
    const double c = row->at_start[2] + at * row->step[2];
    if (!(c > 0.0))
        return NULL;
    const double u = (row->at_start[0] + at * row->step[0]) / c;
    const double v = (row->at_start[1] + at * row->step[1]) / c;
    if (!(u >= 0.0 && u < mesh->panel_width && v >= 0.0 && v < mesh->panel_height))
        return NULL;
    return &mesh->cell[(int64_t)(int32_t)v * mesh->panel_width + (int32_t)u];
}

/* Give one sample to the nearest wall in its way. */
static void add_sample(const sample_row_t *row, double at, int64_t value)
{
    mesh_cell_t *seen = NULL;
    mesh_t *owner = NULL;
    double nearest = 0.0; /* the largest inverse depth */
    for (int32_t n = 0; n < row->walls; n++) {
        const wall_row_t *wall = &row->wall[n];
        mesh_cell_t *cell = cell_at(wall, at);
        if (cell == NULL)
            continue;
        const double inverse_depth = wall->at_start[3] + at * wall->step[3];
        if (seen == NULL || inverse_depth > nearest) {
            seen = cell;
            owner = wall->mesh;
            nearest = inverse_depth;
        }
    }
    if (seen == NULL)
        return;
    seen->count++;
    seen->sum += value;
    owner->covered++;
    owner->sum_of_squares += value * value;
}

static void add_row(const sample_row_t *row)
{
    for (int32_t x = 0; x < row->truth_width; x++) {
        const int64_t value = row->truth[(int64_t)x * row->truth_pixel];
        for (int32_t k = 0; k < row->per; k++)
            add_sample(row, (double)x * row->per + k + 0.5, value);
    }
}

image_t mesh_channel(const image_t *image, int byte)
{
    image_t channel = *image;
    channel.data += byte;
    return channel;
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

static bool make_mesh(mesh_t *mesh, const double_homography_t *homography, int32_t factor,
                      char error[FILE_ERROR_LENGTH])
{
    const size_t cells = (size_t)homography->panel_width * (size_t)homography->panel_height;
    *mesh = (mesh_t){.panel_width = homography->panel_width,
                     .panel_height = homography->panel_height,
                     .samples = (int64_t)homography->picture_width * homography->picture_height * factor * factor,
                     .cell = calloc(cells, sizeof *mesh->cell)};
    if (mesh->cell == NULL)
        snprintf(error, FILE_ERROR_LENGTH, "out of memory for %zu projector pixels", cells);
    return mesh->cell != NULL;
}

bool mesh_sample_walls(mesh_t *mesh, const double_homography_t *homography, int32_t walls, const image_t *truth,
                       int32_t factor, char error[FILE_ERROR_LENGTH])
{
    assert(walls >= 1 && walls <= MESH_MAX_WALLS);
    if (!sizes_fit(homography, truth, factor, error))
        return false;
    mesh_t made[MESH_MAX_WALLS] = {{.cell = NULL}};
    bool ok = true;
    for (int32_t n = 0; ok && n < walls; n++)
        ok = make_mesh(&made[n], &homography[n], factor, error);
    if (!ok) {
        for (int32_t n = 0; n < walls; n++)
            mesh_free(&made[n]);
        return false;
    }
    const int32_t per = factor / (truth->width / homography->picture_width);
    for (int32_t y = 0; y < homography->picture_height * factor; y++) {
        sample_row_t row = {.walls = walls,
                            .truth = image_row(truth, y / per),
                            .truth_width = truth->width,
                            .truth_pixel = (int32_t)truth->format,
                            .per = per};
        for (int32_t n = 0; n < walls; n++)
            row.wall[n] = wall_row(&made[n], &homography[n], (y + 0.5) / factor, factor);
        add_row(&row);
    }
    memcpy(mesh, made, (size_t)walls * sizeof *mesh);
    return true;
}

bool mesh_sample(mesh_t *mesh, const double_homography_t *homography, const image_t *truth, int32_t factor,
                 char error[FILE_ERROR_LENGTH])
{
    return mesh_sample_walls(mesh, homography, 1, truth, factor, error);
}

void mesh_free(mesh_t *mesh)
{
    free(mesh->cell);
    mesh->cell = NULL;
}

/* The sum of (truth - shown)^2 is that of truth^2 - 2 truth shown + shown^2; at most 2^36 samples: exact. */
int64_t mesh_square_error(const mesh_t *mesh, const image_t *panel)
{
    int64_t error = mesh->sum_of_squares;
    for (int32_t j = 0; j < mesh->panel_height; j++) {
        const mesh_cell_t *cell = &mesh->cell[(int64_t)j * mesh->panel_width];
        const uint8_t *shown = image_row(panel, j);
        for (int32_t i = 0; i < mesh->panel_width; i++, shown += panel->format)
            error += *shown * (*shown * cell[i].count - 2 * cell[i].sum);
    }
    return error;
}

double mesh_db(double square_error, int64_t samples)
{
    if (!(square_error > 0.0))
        return HUGE_VAL;
    return 10.0 * log10(255.0 * 255.0 * (double)samples / square_error);
}

double mesh_psnr_db(const mesh_t *mesh, const image_t *panel)
{
    return mesh_db((double)mesh_square_error(mesh, panel), mesh->covered);
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
        for (int32_t i = 0; i < mesh->panel_width; i++, best += panel->format)
            *best = mean_of(&cell[i]);
    }
}

double mesh_coverage(const mesh_t *mesh)
{
    return (double)mesh->covered / (double)mesh->samples;
}
