// SPDX-License-Identifier: Apache-2.0
// Where the eye sees content that was drawn, or corrected, for another pose: how far from where it should be.
#include "sim/study/latency_error.h"

#include <math.h>

#include "sim/eval/double_homography.h"
#include "sim/eval/double_view.h"

typedef struct {
    const study_scene_t *scene;
    double_view_t drawn, corrected, eye;
    double_homography_t seen; /* of the eye */
    double_wall_t wall;
    double content_m;
} trace_t;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The wall point that the eye sees at a picture point. */
static bool wall_seen_at(const trace_t *trace, const double xy[2], double point_m[3])
{
    double uv[2];
    if (!double_homography_panel_point(&trace->seen, xy, uv) || !(uv[0] >= 0.0 && uv[1] >= 0.0) ||
        uv[0] > trace->seen.panel_width || uv[1] > trace->seen.panel_height)
        return false;
    double_wall_point(&trace->wall, uv, point_m);
    return true;
}

/* From the eye to the content along a ray of the drawn pose. The study's walls stand in the world's xy plane. */
static bool towards_content(const trace_t *trace, const double ray[3], double direction[3])
{
    const double to_wall = trace->wall.origin_m[2] - trace->drawn.eye_m[2];
    const double along = (to_wall + copysign(trace->content_m, to_wall)) / ray[2];
    if (!(along > 0.0))
        return false;
    for (int i = 0; i < 3; i++)
        direction[i] = isinf(along) ? ray[i] : trace->drawn.eye_m[i] + along * ray[i] - trace->eye.eye_m[i];
    return true;
}

static bool project(const double_view_t *view, const double direction[3], double xy[2])
{
    double point_m[3];
    for (int i = 0; i < 3; i++)
        point_m[i] = view->eye_m[i] + direction[i];
    return double_view_project(view, point_m, xy);
}

static void add_point(latency_error_t *error, const trace_t *trace, const double xy[2])
{
    const camera_t *camera = &trace->scene->camera;
    double wall_m[3], shows[2], ray[3], direction[3], true_xy[2], seen_ray[3];
    if (!wall_seen_at(trace, xy, wall_m) || !double_view_project(&trace->corrected, wall_m, shows) || shows[0] < 0.0 ||
        shows[1] < 0.0 || shows[0] > camera->width || shows[1] > camera->height)
        return;
    double_view_ray(&trace->drawn, shows, ray);
    if (!towards_content(trace, ray, direction) || !project(&trace->eye, direction, true_xy))
        return;
    double_view_ray(&trace->eye, xy, seen_ray);
    double cross = 0.0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        cross = hypot(cross, seen_ray[j] * direction[k] - seen_ray[k] * direction[j]);
    }
    const double deg = atan2(cross, dot(seen_ray, direction)) * 180.0 / M_PI;
    const double px = hypot(true_xy[0] - xy[0], true_xy[1] - xy[1]);
    error->px += px;
    error->deg += deg;
    error->worst_px = fmax(error->worst_px, px);
    error->worst_deg = fmax(error->worst_deg, deg);
    error->points++;
}

void latency_error_add(latency_error_t *error, const study_scene_t *scene, const latency_poses_t *poses)
{
    trace_t trace = {.scene = scene, .content_m = poses->content_m};
    homography_t homography;
    if (!homography_from_pose(&homography, &scene->camera, &scene->wall, &poses->eye))
        return;
    double_homography_from_fixed(&trace.seen, &homography);
    double_view(&trace.drawn, &scene->camera, &poses->drawn);
    double_view(&trace.corrected, &scene->camera, &poses->corrected);
    double_view(&trace.eye, &scene->camera, &poses->eye);
    double_wall(&trace.wall, &scene->wall);
    for (int y = 0; y < LATENCY_POINTS_Y; y++)
        for (int x = 0; x < LATENCY_POINTS_X; x++)
            add_point(error, &trace,
                      (const double[2]){(x + 0.5) * scene->camera.width / LATENCY_POINTS_X,
                                        (y + 0.5) * scene->camera.height / LATENCY_POINTS_Y});
}

double latency_mean_px(const latency_error_t *error)
{
    return error->px / (double)error->points;
}

double latency_mean_deg(const latency_error_t *error)
{
    return error->deg / (double)error->points;
}
