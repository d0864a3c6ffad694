// SPDX-License-Identifier: Apache-2.0
// The paper's geometry in floating point: what the fixed-point geometry is measured against.
#include "tests/support/oracle.h"

#include <math.h>
#include <string.h>

/* x := solution of a x = b by Gaussian elimination with pivots; a and b are destroyed. n <= 8. */
static void solve(long double a[8][8], long double b[8], int n)
{
    for (int column = 0; column < n; column++) {
        int pivot = column;
        for (int r = column + 1; r < n; r++)
            if (fabsl(a[r][column]) > fabsl(a[pivot][column]))
                pivot = r;
        for (int k = 0; k < n; k++) {
            const long double swap = a[column][k];
            a[column][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        const long double swap = b[column];
        b[column] = b[pivot];
        b[pivot] = swap;
        for (int r = 0; r < n; r++) {
            if (r == column)
                continue;
            const long double factor = a[r][column] / a[column][column];
            for (int k = column; k < n; k++)
                a[r][k] -= factor * a[column][k];
            b[r] -= factor * b[column];
        }
    }
    for (int r = 0; r < n; r++)
        b[r] /= a[r][r];
}

/* The direction of least variance: inverse iteration on the covariance, lifted a little off zero. */
static void fit_plane(oracle_wall_t *wall, const wall_corners_t *measured)
{
    long double at[4 + WALL_MAX_MARKERS][3];
    int count = 0;
    for (int c = 0; c < 4; c++)
        if (measured->corner_known[c]) {
            for (int k = 0; k < 3; k++)
                at[count][k] = measured->corner_um[c][k] * 1e-6L;
            count++;
        }
    for (int m = 0; m < measured->marker_count; m++) {
        for (int k = 0; k < 3; k++)
            at[count][k] = measured->marker[m].um[k] * 1e-6L;
        count++;
    }
    memset(wall->through, 0, sizeof(wall->through));
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            wall->through[k] += at[i][k] / count;

    long double n[3] = {0.53L, 0.61L, 0.59L};
    for (int iteration = 0; iteration < 200; iteration++) {
        long double a[8][8] = {{0}}, b[8] = {n[0], n[1], n[2]};
        for (int i = 0; i < count; i++)
            for (int r = 0; r < 3; r++)
                for (int k = 0; k < 3; k++)
                    a[r][k] += (at[i][r] - wall->through[r]) * (at[i][k] - wall->through[k]);
        for (int r = 0; r < 3; r++)
            a[r][r] += 1e-15L;
        solve(a, b, 3);
        const long double length = sqrtl(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
        for (int k = 0; k < 3; k++)
            n[k] = b[k] / length;
    }
    memcpy(wall->normal, n, sizeof(n));
}

void oracle_wall(oracle_wall_t *wall, const wall_corners_t *measured)
{
    fit_plane(wall, measured);
    long double corner[4][3];
    int unknown = -1;
    for (int c = 0; c < 4; c++) {
        if (!measured->corner_known[c]) {
            unknown = c;
            continue;
        }
        long double off = 0;
        for (int k = 0; k < 3; k++)
            off += (measured->corner_um[c][k] * 1e-6L - wall->through[k]) * wall->normal[k];
        for (int k = 0; k < 3; k++)
            corner[c][k] = measured->corner_um[c][k] * 1e-6L - off * wall->normal[k];
    }
    if (unknown >= 0)
        for (int k = 0; k < 3; k++)
            corner[unknown][k] =
                corner[(unknown + 1) & 3][k] + corner[(unknown + 3) & 3][k] - corner[(unknown + 2) & 3][k];

    /* In a frame on the plane, the homography's eight unknowns; then back to the world. */
    long double ex[3], ey[3], length = 0;
    for (int k = 0; k < 3; k++)
        ex[k] = corner[1][k] - corner[0][k];
    for (int k = 0; k < 3; k++)
        length += ex[k] * ex[k];
    for (int k = 0; k < 3; k++)
        ex[k] /= sqrtl(length);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        ey[k] = wall->normal[i] * ex[j] - wall->normal[j] * ex[i];
    }
    const long double w = measured->panel_width, h = measured->panel_height;
    const long double uv[4][2] = {{0, 0}, {w, 0}, {w, h}, {0, h}};
    long double a[8][8] = {{0}}, b[8];
    for (int c = 0; c < 4; c++) {
        long double x = 0, y = 0;
        for (int k = 0; k < 3; k++) {
            x += (corner[c][k] - corner[0][k]) * ex[k];
            y += (corner[c][k] - corner[0][k]) * ey[k];
        }
        const long double u = uv[c][0], v = uv[c][1];
        const long double rows[2][8] = {{u, v, 1, 0, 0, 0, -u * x, -v * x}, {0, 0, 0, u, v, 1, -u * y, -v * y}};
        memcpy(a[2 * c], rows, sizeof(rows));
        b[2 * c] = x;
        b[2 * c + 1] = y;
    }
    solve(a, b, 8);
    const long double weight[3] = {b[6], b[7], 1};
    for (int k = 0; k < 3; k++) {
        wall->weight[k] = weight[k];
        for (int axis = 0; axis < 3; axis++)
            wall->point[axis][k] = ex[axis] * b[k] + ey[axis] * b[3 + k] + corner[0][axis] * weight[k];
    }
}

void oracle_homography(oracle_homography_t *h, const camera_t *camera, const oracle_wall_t *wall, const pose_t *pose)
{
    long double q[4], square = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = pose->quaternion_q30[i] / 1073741824.0L;
        square += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++)
        q[i] /= sqrtl(square);
    const long double w = q[0], x = q[1], y = q[2], z = q[3];
    const long double to_world[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                        {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                        {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    for (int k = 0; k < 3; k++) {
        long double in_camera[3] = {0, 0, 0};
        for (int axis = 0; axis < 3; axis++) {
            const long double from_eye = wall->point[axis][k] - pose->eye_nm[axis] * 1e-9L * wall->weight[k];
            for (int c = 0; c < 3; c++)
                in_camera[c] += to_world[axis][c] * from_eye;
        }
        for (int c = 0; c < 2; c++)
            h->row[c][k] =
                camera->focal_upx[c] * 1e-6L * in_camera[c] + camera->principal_upx[c] * 1e-6L * in_camera[2];
        h->row[2][k] = in_camera[2];
        h->weight[k] = wall->weight[k];
    }
}

void oracle_point(const oracle_homography_t *h, long double u, long double v, long double xy[2], long double *depth)
{
    const long double w = h->row[2][0] * u + h->row[2][1] * v + h->row[2][2];
    for (int c = 0; c < 2; c++)
        xy[c] = (h->row[c][0] * u + h->row[c][1] * v + h->row[c][2]) / w;
    *depth = w / (h->weight[0] * u + h->weight[1] * v + h->weight[2]);
}

double oracle_incidence_deg(const oracle_wall_t *wall, const pose_t *pose, long double u, long double v)
{
    const long double weight = wall->weight[0] * u + wall->weight[1] * v + wall->weight[2];
    long double along = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        const long double ray =
            (wall->point[k][0] * u + wall->point[k][1] * v + wall->point[k][2]) / weight - pose->eye_nm[k] * 1e-9L;
        along += ray * wall->normal[k];
        square += ray * ray;
    }
    return (double)(acosl(fminl(fabsl(along) / sqrtl(square), 1)) * 57.29577951308232L);
}

double oracle_eye_distance_m(const oracle_wall_t *wall, const pose_t *pose)
{
    long double along = 0;
    for (int k = 0; k < 3; k++)
        along += (pose->eye_nm[k] * 1e-9L - wall->through[k]) * wall->normal[k];
    return (double)fabsl(along);
}

bool oracle_scene(oracle_scene_t *scene)
{
    wall_t wall;
    oracle_wall(&scene->wall, &scene->c.corners);
    oracle_homography(&scene->exact, &scene->c.camera, &scene->wall, &scene->c.pose);
    return wall_from_corners(&wall, &scene->c.corners) == WALL_OK &&
           homography_from_pose(&scene->homography, &scene->c.camera, &wall, &scene->c.pose);
}
