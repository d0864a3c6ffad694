// SPDX-License-Identifier: Apache-2.0
// A white rectangle on the study's wall, and how rectangular the viewer sees it.
#include "sim/study/rectangle_view.h"

#include <math.h>
#include <stdlib.h>

#include "sim/eval/viewer_picture.h"
#include "sim/files/gray_image.h"
#include "warp_fixed/fixed.h"

static const double share = 0.28;

/* Memory and maps of one view. */
typedef struct {
    const rectangle_view_t *view;
    double left, top; /* the rectangle begins here, and ends as far from the other edges */
    homography_t tracked;
    double_homography_t tracked_exact, eye_exact;
    image_t picture, panel, seen;
    warp_t *warp;
} work_t;

static rectangle_point_t map(double rows[3][3], rectangle_point_t point)
{
    double value[3];
    for (int r = 0; r < 3; r++)
        value[r] = rows[r][0] * point.x + rows[r][1] * point.y + rows[r][2];
    return (rectangle_point_t){value[0] / value[2], value[1] / value[2]};
}

/* The inverse of a map, but for a factor. */
static void invert(double out[3][3], double in[3][3])
{
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++) {
            const int r1 = (k + 1) % 3, r2 = (k + 2) % 3, k1 = (r + 1) % 3, k2 = (r + 2) % 3;
            out[r][k] = in[r1][k1] * in[r2][k2] - in[r1][k2] * in[r2][k1];
        }
}

/*
 * Where on the panel the firmware puts a picture point: where its grid says that point is. The grid's error there is
 * that of the projector pixel which the point falls in.
 */
static rectangle_point_t put_on_panel(work_t *work, rectangle_point_t point)
{
    double picture_from_panel[3][3];
    const rectangle_point_t exact = map(work->tracked_exact.panel_from_picture, point);
    const int32_t i = (int32_t)exact.x, j = (int32_t)exact.y;
    int32_t x_q18, y_q18;
    if (!grid_point(&work->warp->plane[0].grid, i, j, &x_q18, &y_q18))
        return exact;
    invert(picture_from_panel, work->tracked_exact.panel_from_picture);
    const rectangle_point_t centre = map(picture_from_panel, (rectangle_point_t){i + 0.5, j + 0.5});
    return map(work->tracked_exact.panel_from_picture,
               (rectangle_point_t){point.x - (ldexp(x_q18, -GRID_FRACTION_BITS) - centre.x),
                                   point.y - (ldexp(y_q18, -GRID_FRACTION_BITS) - centre.y)});
}

static rectangle_shape_t from_geometry(work_t *work)
{
    const double left = work->left, top = work->top, right = work->view->width - left,
                 bottom = work->view->height - top;
    rectangle_point_t corner[4] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
    double picture_from_panel[3][3];
    invert(picture_from_panel, work->eye_exact.panel_from_picture);
    for (int n = 0; n < 4; n++) {
        if (work->view->compensated)
            corner[n] = put_on_panel(work, corner[n]);
        corner[n] = map(picture_from_panel, corner[n]);
    }
    return rectangle_shape(corner);
}

/* How much of [begin, begin + 1] lies in [from, to]. */
static double covered(int32_t begin, double from, double to)
{
    return fmax(fmin(begin + 1.0, to) - fmax(begin, from), 0.0);
}

static void draw_rectangle(const work_t *work)
{
    const image_t *picture = &work->picture;
    for (int32_t y = 0; y < picture->height; y++)
        for (int32_t x = 0; x < picture->width; x++)
            image_row(picture, y)[x] = (uint8_t)lround(255.0 * covered(x, work->left, picture->width - work->left) *
                                                       covered(y, work->top, picture->height - work->top));
}

static bool from_view(const work_t *work, rectangle_shape_t *shape)
{
    const viewer_wall_t wall = {work->eye_exact, work->view->compensated ? work->panel : work->picture};
    rectangle_point_t corner[4];
    viewer_picture(&work->seen, &wall, 1, work->view->samples);
    if (!rectangle_find(&work->seen, corner))
        return false;
    *shape = rectangle_shape(corner);
    return true;
}

static bool measure(work_t *work, rectangle_views_t *views)
{
    const rectangle_view_t *view = work->view;
    const study_sizes_t sizes = {view->width, view->height, view->width, view->height};
    study_scene_t scene;
    homography_t eye;
    study_scene(&scene, &sizes);
    if (!homography_from_pose(&work->tracked, &scene.camera, &scene.wall, &view->tracked) ||
        !homography_from_pose(&eye, &scene.camera, &scene.wall, &view->eye))
        return false;
    double_homography_from_fixed(&work->tracked_exact, &work->tracked);
    double_homography_from_fixed(&work->eye_exact, &eye);
    draw_rectangle(work);
    study_warp_begin(work->warp, warp_method_default());
    study_warp_frame(work->warp, &work->tracked, &work->picture, &work->panel);
    views->geometry = from_geometry(work);
    return from_view(work, &views->seen);
}

bool rectangle_view(rectangle_views_t *views, const rectangle_view_t *view)
{
    const int32_t width = view->width, height = view->height;
    work_t work = {.view = view,
                   .left = width * (1.0 - share) / 2.0,
                   .top = height * (1.0 - share) / 2.0,
                   .warp = malloc(sizeof *work.warp)};
    const bool made = work.warp != NULL && gray_image(&work.picture, width, height) &&
                      gray_image(&work.panel, width, height) && gray_image(&work.seen, width, height) &&
                      measure(&work, views);
    free(work.seen.data);
    free(work.panel.data);
    free(work.picture.data);
    free(work.warp);
    return made;
}
