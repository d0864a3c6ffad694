// SPDX-License-Identifier: Apache-2.0
// The frame's homography in double precision, both ways: for evaluation and for the viewer's eye, never for a frame.
#include "sim/eval/double_homography.h"

#include <math.h>

/* Below this share of its rows' lengths, a determinant is rounding error. */
static const double least_determinant = 1e-13;

double double_from_real(real_t real)
{
    return ldexp((double)real.mantissa, real.exponent);
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void double_homography_from_fixed(double_homography_t *out, const homography_t *homography)
{
    *out = (double_homography_t){.panel_width = homography->panel_width,
                                 .panel_height = homography->panel_height,
                                 .picture_width = homography->picture_width,
                                 .picture_height = homography->picture_height};
    const double width = homography->panel_width, height = homography->panel_height;
    const real_t um_per_m = real_from_int(1000000, 0);
    double row[3][3], size = 1.0;
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < 3; k++)
            row[r][k] = double_from_real(real_div(homography->row[r][k], um_per_m));
        /* in units of the panel, so that the determinant's size means something */
        const double of_panel[3] = {row[r][0] * width, row[r][1] * height, row[r][2]};
        size *= sqrt(dot(of_panel, of_panel));
    }
    double column[3][3]; /* of the inverse, but for the determinant */
    for (int r = 0; r < 3; r++)
        cross(column[r], row[(r + 1) % 3], row[(r + 2) % 3]);
    const double determinant = dot(row[0], column[0]);
    if (!(fabs(determinant) * width * height > least_determinant * size))
        return;
    for (int k = 0; k < 3; k++) {
        const double weight = double_from_real(homography->weight[k]);
        for (int r = 0; r < 3; r++) {
            out->panel_from_picture[k][r] = column[r][k] / determinant;
            out->inverse_depth[r] += weight * out->panel_from_picture[k][r];
        }
    }
}

bool double_homography_panel_point(const double_homography_t *homography, const double xy_px[2], double uv_px[2])
{
    const double(*row)[3] = homography->panel_from_picture;
    const double c = row[2][0] * xy_px[0] + row[2][1] * xy_px[1] + row[2][2];
    if (!(c > 0.0))
        return false;
    for (int r = 0; r < 2; r++)
        uv_px[r] = (row[r][0] * xy_px[0] + row[r][1] * xy_px[1] + row[r][2]) / c;
    return true;
}
