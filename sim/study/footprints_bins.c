// SPDX-License-Identifier: Apache-2.0
// The error of a panel, summed up by how large its pixels are in the viewer's picture.
#include "sim/study/footprints_bins.h"

#include <math.h>
#include <string.h>

static const double smallest_log2 = -6.0, bins_per_octave = 2.0;

double footprints_bin_area(int bin)
{
    return exp2(smallest_log2 + bin / bins_per_octave);
}

static int bin_of(double area)
{
    const double bin = floor((log2(area) - smallest_log2) * bins_per_octave);
    return (int)fmin(fmax(bin, 0.0), FOOTPRINTS_BINS - 1.0);
}

/* The inverse of m, the matrix from picture to panel, is adj(m) / det(m). A map (a / c, b / c) has the Jacobian
   determinant det / c^3; that of the inverse, with c = (last row of the inverse) . (u, v, 1), is 1 / (det(m) c^3). */
double footprints_area(const double_homography_t *homography, int32_t i, int32_t j)
{
    const double(*m)[3] = homography->panel_from_picture;
    const double row[3] = {m[1][0] * m[2][1] - m[1][1] * m[2][0], m[0][1] * m[2][0] - m[0][0] * m[2][1],
                           m[0][0] * m[1][1] - m[0][1] * m[1][0]};
    const double det = m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]) +
                       m[2][1] * (m[0][2] * m[1][0] - m[0][0] * m[1][2]) + m[2][2] * row[2];
    const double c = (row[0] * (i + 0.5) + row[1] * (j + 0.5) + row[2]) / det;
    return fabs(1.0 / (det * c * c * c));
}

void footprints_bins(footprints_bin_t bin[FOOTPRINTS_BINS], const mesh_t *mesh, const double_homography_t *homography,
                     const image_t *panel)
{
    memset(bin, 0, FOOTPRINTS_BINS * sizeof bin[0]);
    for (int32_t j = 0; j < mesh->panel_height; j++) {
        const mesh_cell_t *cell = &mesh->cell[(int64_t)j * mesh->panel_width];
        const uint8_t *shown = image_row(panel, j);
        for (int32_t i = 0; i < mesh->panel_width; i++) {
            if (cell[i].count == 0)
                continue;
            footprints_bin_t *own = &bin[bin_of(footprints_area(homography, i, j))];
            const double off = (double)(shown[i] * cell[i].count - cell[i].sum);
            own->pixels++;
            own->samples += cell[i].count;
            own->error += off * off / (double)cell[i].count;
        }
    }
}

footprints_bin_t footprints_bins_sum(const footprints_bin_t bin[FOOTPRINTS_BINS], double from, double to)
{
    footprints_bin_t sum = {0};
    for (int b = 0; b < FOOTPRINTS_BINS; b++) {
        if (footprints_bin_area(b) < from || footprints_bin_area(b) >= to)
            continue;
        sum.pixels += bin[b].pixels;
        sum.samples += bin[b].samples;
        sum.error += bin[b].error;
    }
    return sum;
}
