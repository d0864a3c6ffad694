// SPDX-License-Identifier: Apache-2.0
// Corner markers -> the wall: its plane, and where on it every projector pixel lands (paper, eq 1 and 2).
#include "warp_fixed/wall_from_corners.h"

#include "warp_fixed/image.h"
#include "warp_fixed/plane_from_points.h"
#include "warp_fixed/real_vector.h"

_Static_assert(4 + WALL_MAX_MARKERS <= PLANE_MAX_POINTS, "corners and markers must fit in one cloud");

/* All measured points, relative to their rounded mean, in micrometres. */
static void cloud_from_measured(cloud_t *cloud, int32_t origin_um[3], const wall_corners_t *measured)
{
    const int32_t *um[PLANE_MAX_POINTS];
    int count = 0;
    for (int c = 0; c < 4; c++)
        if (measured->corner_known[c])
            um[count++] = measured->corner_um[c];
    for (int m = 0; m < measured->marker_count; m++)
        um[count++] = measured->marker[m].um;

    for (int axis = 0; axis < 3; axis++) {
        int64_t sum = 0;
        for (int i = 0; i < count; i++)
            sum += um[i][axis];
        origin_um[axis] = (int32_t)(sum / count);
        for (int i = 0; i < count; i++)
            cloud->at[i][axis] = real_from_int((int64_t)um[i][axis] - origin_um[axis], 0);
    }
    cloud->count = count;
}

/* Sign of the turn a -> b -> c, and whether it is clearly one: more than 10^-6 of the sides' product. */
static int turn(const real_t a[2], const real_t b[2], const real_t c[2])
{
    const real_t ab[2] = {real_sub(b[0], a[0]), real_sub(b[1], a[1])};
    const real_t bc[2] = {real_sub(c[0], b[0]), real_sub(c[1], b[1])};
    const real_t cross = real_sub(real_mul(ab[0], bc[1]), real_mul(ab[1], bc[0]));
    const real_t sides = real_sqrt(real_mul(real_add(real_mul(ab[0], ab[0]), real_mul(ab[1], ab[1])),
                                            real_add(real_mul(bc[0], bc[0]), real_mul(bc[1], bc[1]))));
    if (!real_less(sides, real_mul(real_abs(cross), real_from_int(1000000, 0))))
        return 0;
    return real_sign(cross);
}

/*
 * Homography of the unit square to a quadrilateral (Heckbert 1989, eq 2.14 ff): (s, t) lies at
 * (x0 + s (x1 - x0 + g x1) + t (x3 - x0 + h x3)) / (1 + g s + h t). s is u / width, t is v / height.
 */
static void map_from_quad(real_t map[2][3], real_t gh[2], const real_t xy[4][2])
{
    real_t d1[2], d2[2], sum[2];
    for (int a = 0; a < 2; a++) {
        d1[a] = real_sub(xy[1][a], xy[2][a]);
        d2[a] = real_sub(xy[3][a], xy[2][a]);
        sum[a] = real_add(real_sub(xy[0][a], xy[1][a]), real_sub(xy[2][a], xy[3][a]));
    }
    const real_t det = real_sub(real_mul(d1[0], d2[1]), real_mul(d2[0], d1[1]));
    gh[0] = real_div(real_sub(real_mul(sum[0], d2[1]), real_mul(d2[0], sum[1])), det);
    gh[1] = real_div(real_sub(real_mul(d1[0], sum[1]), real_mul(sum[0], d1[1])), det);
    for (int a = 0; a < 2; a++) {
        map[a][0] = real_add(real_sub(xy[1][a], xy[0][a]), real_mul(gh[0], xy[1][a]));
        map[a][1] = real_add(real_sub(xy[3][a], xy[0][a]), real_mul(gh[1], xy[3][a]));
        map[a][2] = xy[0][a];
    }
}

/* The corners in the plane's frame; an unknown one completes the parallelogram (eq 2). */
static void corners_on_plane(real_t xy[4][2], const plane_t *plane, const cloud_t *cloud, const bool known[4])
{
    int unknown = -1, next = 0;
    for (int c = 0; c < 4; c++) {
        if (known[c])
            plane_coordinates(xy[c], plane, cloud->at[next++]);
        else
            unknown = c;
    }
    if (unknown >= 0)
        for (int a = 0; a < 2; a++)
            xy[unknown][a] =
                real_sub(real_add(xy[(unknown + 1) & 3][a], xy[(unknown + 3) & 3][a]), xy[(unknown + 2) & 3][a]);
}

/* Panel pixels instead of the unit square, world axes instead of the plane's: fills point and weight. */
static void wall_from_map(wall_t *wall, const plane_t *plane, const real_t map[2][3], const real_t gh[2])
{
    const real_t one = real_from_int(1, 0);
    const real_t size[2] = {real_from_int(wall->panel_width, 0), real_from_int(wall->panel_height, 0)};
    const real_t weight[3] = {gh[0], gh[1], one};
    for (int k = 0; k < 3; k++) {
        wall->weight[k] = k < 2 ? real_div(weight[k], size[k]) : one;
        for (int a = 0; a < 3; a++) {
            const real_t in_plane = real_add(real_mul(plane->x[a], map[0][k]), real_mul(plane->y[a], map[1][k]));
            const real_t at = real_add(in_plane, real_mul(plane->mean[a], weight[k]));
            wall->point[a][k] = k < 2 ? real_div(at, size[k]) : at;
        }
    }
}

static void measure_markers(wall_t *wall, const plane_t *plane, const wall_corners_t *measured)
{
    real_t worst = real_from_int(0, 0);
    for (int m = 0; m < measured->marker_count; m++) {
        const wall_marker_t *marker = &measured->marker[m];
        const real_t uv[3] = {real_from_int(marker->px_q16[0], -16), real_from_int(marker->px_q16[1], -16),
                              real_from_int(1, 0)};
        const real_t weight = vector_dot(wall->weight, uv);
        real_t offset[3];
        for (int a = 0; a < 3; a++) {
            const real_t mapped = real_div(vector_dot(wall->point[a], uv), weight);
            offset[a] = real_sub(real_from_int((int64_t)marker->um[a] - wall->origin_um[a], 0), mapped);
        }
        const real_t x = vector_dot(offset, plane->x), y = vector_dot(offset, plane->y);
        const real_t distance = real_sqrt(real_add(real_mul(x, x), real_mul(y, y)));
        if (real_less(worst, distance))
            worst = distance;
    }
    wall->marker_um = (int32_t)real_to_fixed(worst, 0, INT32_MAX);
}

/* |90 degrees - angle| from its sine, which is the cosine of the angle: asin(x) = x + x^3/6 + 3 x^5/40, x small. */
static int32_t worst_skew_mdeg(const real_t xy[4][2])
{
    real_t worst = real_from_int(0, 0);
    for (int c = 0; c < 4; c++) {
        real_t to_next[2], to_last[2];
        for (int a = 0; a < 2; a++) {
            to_next[a] = real_sub(xy[(c + 1) & 3][a], xy[c][a]);
            to_last[a] = real_sub(xy[(c + 3) & 3][a], xy[c][a]);
        }
        const real_t dot = real_add(real_mul(to_next[0], to_last[0]), real_mul(to_next[1], to_last[1]));
        const real_t squares = real_mul(real_add(real_mul(to_next[0], to_next[0]), real_mul(to_next[1], to_next[1])),
                                        real_add(real_mul(to_last[0], to_last[0]), real_mul(to_last[1], to_last[1])));
        const real_t cosine = real_div(real_abs(dot), real_sqrt(squares));
        if (real_less(worst, cosine))
            worst = cosine;
    }
    const real_t cube = real_mul(worst, real_mul(worst, worst));
    const real_t sine = real_add(worst, real_div(cube, real_from_int(6, 0)));
    return (int32_t)real_to_fixed(real_mul(sine, real_from_int(57296, 0)), 0, 90000);
}

wall_status_t wall_from_corners(wall_t *wall, const wall_corners_t *measured)
{
    int known = 0;
    for (int c = 0; c < 4; c++)
        known += measured->corner_known[c];
    if (measured->panel_width < 1 || measured->panel_width > IMAGE_MAX_WIDTH || measured->panel_height < 1 ||
        measured->panel_height > IMAGE_MAX_HEIGHT || measured->marker_count < 0 ||
        measured->marker_count > WALL_MAX_MARKERS)
        return WALL_BAD_SIZE;
    if (known < 3)
        return WALL_TOO_FEW_CORNERS;

    wall_t result = {.panel_width = measured->panel_width, .panel_height = measured->panel_height};
    cloud_t cloud;
    plane_t plane;
    real_t xy[4][2], map[2][3], gh[2];
    cloud_from_measured(&cloud, result.origin_um, measured);
    if (!plane_from_points(&plane, &cloud))
        return WALL_ON_A_LINE;
    corners_on_plane(xy, &plane, &cloud, measured->corner_known);
    const int first_turn = turn(xy[0], xy[1], xy[2]);
    for (int c = 0; c < 4; c++) {
        const int turned = turn(xy[c], xy[(c + 1) & 3], xy[(c + 2) & 3]);
        if (turned == 0)
            return WALL_ON_A_LINE;
        if (turned != first_turn)
            return WALL_CROSSED;
    }
    map_from_quad(map, gh, (const real_t(*)[2])xy);
    wall_from_map(&result, &plane, (const real_t(*)[3])map, gh);
    plane_residuals(&result.rms_um, &result.worst_um, &plane, &cloud);
    measure_markers(&result, &plane, measured);
    result.skew_mdeg = worst_skew_mdeg((const real_t(*)[2])xy);
    *wall = result;
    return WALL_OK;
}

const char *wall_status_text(wall_status_t status)
{
    switch (status) {
    case WALL_OK:
        return "the wall is a plane";
    case WALL_TOO_FEW_CORNERS:
        return "fewer than three corners are known, expected three or four";
    case WALL_ON_A_LINE:
        return "corners lie on a line or in one place, expected points that span a plane";
    case WALL_CROSSED:
        return "the corners do not go round a convex quadrilateral, "
               "expected top-left, top-right, bottom-right, bottom-left of the projected picture";
    case WALL_BAD_SIZE:
        return "projector size or number of markers out of range";
    }
    return "unknown wall status";
}
