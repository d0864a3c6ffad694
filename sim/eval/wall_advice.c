// SPDX-License-Identifier: Apache-2.0
// What methods do on one wall for a viewer who walks: range of k, gap to the limit, cost.
#include "sim/eval/wall_advice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/leaves_picture.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/eval/method_cost.h"
#include "sim/eval/wall_place.h"
#include "sim/eval/warp_once.h"

/* Nearer to a wall's plane the grid's precision is not promised. */
static const double least_distance_mm = 300.0;

/* Projector pixels smaller than this need finer samples, or most of them have one at most. */
static const double fine_k = 0.5;
enum { FINE_FACTOR = 16 };

typedef struct {
    pose_t pose;
    int32_t k_q16;
} seen_t;

static int by_k(const void *a, const void *b)
{
    const seen_t *first = a, *second = b;
    return (first->k_q16 > second->k_q16) - (first->k_q16 < second->k_q16);
}

/* Sort one place in: it goes to seen[], or counts as one that is left out. */
static void survey_place(wall_advice_t *advice, seen_t *seen, const wall_place_t *place, const advice_walk_t *walk,
                         const double eye_mm[3])
{
    const room_board_t *board = advice->board;
    const double distance_mm = wall_place_distance_mm(place, eye_mm);
    if (fabs(distance_mm) < least_distance_mm) {
        advice->too_near++;
        return;
    }
    const pose_t pose = wall_place_look(place, eye_mm, walk->up);
    homography_t homography;
    footprint_step_t step = {.in_q16 = 0};
    if (homography_from_pose(&homography, walk->camera, &board->wall, &pose))
        step = footprint_step(&homography);
    if (step.in_q16 == 0) {
        advice->unseen++;
        return;
    }
    advice->from_behind += distance_mm < 0.0;
    seen[advice->places++] = (seen_t){pose, board->step_all ? step.all_q16 : step.in_q16};
}

bool wall_advice_survey(wall_advice_t *advice, const room_board_t *board, const advice_walk_t *walk)
{
    seen_t *seen = calloc((size_t)walk->eyes, sizeof *seen);
    if (seen == NULL)
        return false;
    wall_place_t place;
    wall_place(&place, &board->wall);
    advice->board = board;
    advice->too_near = advice->unseen = advice->from_behind = advice->places = 0;
    for (int32_t e = 0; e < walk->eyes; e++)
        survey_place(advice, seen, &place, walk, walk->eye_mm[e]);
    qsort(seen, (size_t)advice->places, sizeof *seen, by_k);
    const int32_t at[ADVICE_VIEWS] = {0, advice->places / 2, advice->places - 1};
    for (int v = 0; advice->places > 0 && v < ADVICE_VIEWS; v++) {
        advice->pose[v] = seen[at[v]].pose;
        advice->k[v] = seen[at[v]].k_q16 / 65536.0;
    }
    free(seen);
    return true;
}

const warp_method_t *wall_advice_auto(double k)
{
    const bool spline = warp_resampler_for_step(WARP_MEAN_CUBIC, (int32_t)lround(k * 65536.0)) == WARP_MEAN_SPLINE;
    return warp_method_from_name(spline ? "mean+spline" : "mean+cubic");
}

/* One view of the wall, made smaller. */
typedef struct {
    warp_once_t once;
    mesh_t own, finer;
    double own_limit_db, finer_limit_db;
    method_cost_place_t cost;
} view_t;

typedef struct {
    view_t view[ADVICE_VIEWS];
    image_t picture, original, panel;
} scene_t;

static int32_t scaled(int32_t pixels, double scale)
{
    return (int32_t)fmax(1.0, floor(pixels * scale + 0.5));
}

static camera_t small_camera(const camera_t *camera, double scale)
{
    const int32_t size[2] = {camera->width, camera->height};
    const int32_t small[2] = {scaled(size[0], scale), scaled(size[1], scale)};
    camera_t out = {.width = small[0], .height = small[1]};
    for (int a = 0; a < 2; a++) {
        const double by = (double)small[a] / size[a];
        out.focal_upx[a] = llround((double)camera->focal_upx[a] * by);
        out.principal_upx[a] = llround((double)camera->principal_upx[a] * by);
    }
    return out;
}

/* The largest weight of all columns (or rows) that fall into each of the small picture: some is LS_WEIGHT_ONE still. */
static void small_weights(uint16_t *small, int32_t small_size, const uint16_t *weight, int32_t size)
{
    memset(small, 0, (size_t)small_size * sizeof *small);
    for (int32_t i = 0; i < size; i++) {
        uint16_t *into = &small[(int64_t)i * small_size / size];
        *into = weight[i] > *into ? weight[i] : *into;
    }
}

/* The same wall under a projector of fewer pixels: it was a wall before, so it is one now. Markers may keep their
 * pixels: only where they are in the room bears on the map. */
static wall_t small_wall(const room_board_t *board, double scale)
{
    wall_corners_t corners = board->corners;
    corners.panel_width = scaled(corners.panel_width, scale);
    corners.panel_height = scaled(corners.panel_height, scale);
    wall_t wall = board->wall;
    (void)wall_from_corners(&wall, &corners);
    return wall;
}

/* The mean area of the lit pixels' footprints, as the side of a square. */
static double mean_side_px(const mesh_t *mesh, int32_t factor)
{
    int64_t lit = 0;
    for (int64_t p = 0; p < (int64_t)mesh->panel_width * mesh->panel_height; p++)
        lit += mesh->cell[p].count > 0;
    return lit == 0 ? 0.0 : sqrt((double)mesh->covered / (double)lit) / factor;
}

static double limit_db(const mesh_t *mesh, const image_t *panel)
{
    mesh_limit(mesh, panel);
    return mesh_psnr_db(mesh, panel);
}

static bool open_view(scene_t *scene, advice_view_t v, const wall_advice_t *advice, warp_t *warp)
{
    view_t *view = &scene->view[v];
    warp_once_t *once = &view->once;
    once->warp = warp;
    double_homography_t homography;
    char error[FILE_ERROR_LENGTH];
    const int32_t factor = advice->k[v] < fine_k ? FINE_FACTOR : ADVICE_FINER;
    if (!homography_from_pose(&once->homography, &once->camera, &once->board.wall, &advice->pose[v]))
        return false;
    double_homography_from_fixed(&homography, &once->homography);
    if (!mesh_sample(&view->own, &homography, &scene->picture, factor, error) ||
        !mesh_sample(&view->finer, &homography, &scene->original, factor, error))
        return false;
    view->own_limit_db = limit_db(&view->own, &scene->panel);
    view->finer_limit_db = limit_db(&view->finer, &scene->panel);
    view->cost = (method_cost_place_t){.k = advice->k[v],
                                       .side_px = mean_side_px(&view->own, factor),
                                       .picture_per_panel =
                                           (double)once->camera.width * once->camera.height /
                                           (once->board.wall.panel_width * (double)once->board.wall.panel_height)};
    return true;
}

static bool open_scene(scene_t *scene, const wall_advice_t *advice, const camera_t *camera, warp_t *warp)
{
    const wall_t *wall = &advice->board->wall;
    const double most = fmax((double)camera->width * camera->height, (double)wall->panel_width * wall->panel_height);
    const double scale = fmin(1.0, sqrt(ADVICE_PIXELS / most));
    warp_once_t *once = &scene->view[0].once;
    once->camera = small_camera(camera, scale);
    once->board = *advice->board;
    once->kernels = warp_kernels_best();
    once->board.wall = small_wall(advice->board, scale);
    small_weights(once->board.ls_weights.x, once->camera.width, advice->board->ls_weights.x, camera->width);
    small_weights(once->board.ls_weights.y, once->camera.height, advice->board->ls_weights.y, camera->height);
    once->homography.panel_width = once->board.wall.panel_width;
    once->homography.panel_height = once->board.wall.panel_height;
    for (int v = 1; v < ADVICE_VIEWS; v++)
        scene->view[v].once = *once;
    bool ok = warp_once_panel(once, IMAGE_GRAY8, &scene->panel) &&
              leaves_picture(once->camera.width, once->camera.height, ADVICE_FINER, &scene->picture, &scene->original);
    for (int v = 0; ok && v < ADVICE_VIEWS; v++)
        ok = open_view(scene, (advice_view_t)v, advice, warp);
    return ok;
}

static void close_scene(scene_t *scene)
{
    for (int v = 0; v < ADVICE_VIEWS; v++) {
        mesh_free(&scene->view[v].own);
        mesh_free(&scene->view[v].finer);
    }
    free(scene->picture.data);
    free(scene->original.data);
    free(scene->panel.data);
    free(scene);
}

/* How far below the limit; see advice_exact_db. */
static double gap(double limit, double psnr)
{
    return fmax(fmin(limit, advice_exact_db) - psnr, 0.0);
}

static bool measure_method(wall_advice_t *advice, scene_t *scene, int32_t m)
{
    double own = 0.0, finer = 0.0, cost = 0.0;
    for (int v = 0; v < ADVICE_VIEWS; v++) {
        view_t *view = &scene->view[v];
        if (!warp_once(&view->once, &warp_methods[m], &scene->panel, &scene->picture))
            return false;
        own += gap(view->own_limit_db, mesh_psnr_db(&view->own, &scene->panel));
        finer += gap(view->finer_limit_db, mesh_psnr_db(&view->finer, &scene->panel));
        const bool is_auto = warp_methods[m].resampler == WARP_AUTO;
        cost += method_cost(is_auto ? wall_advice_auto(view->cost.k)->name : warp_methods[m].name, &view->cost);
    }
    advice->gap_db[m] = own / ADVICE_VIEWS;
    advice->gap_original_db[m] = finer / ADVICE_VIEWS;
    advice->cost[m] = cost / ADVICE_VIEWS;
    return true;
}

bool wall_advice_measure(wall_advice_t *advice, const camera_t *camera, advice_progress_fn *progress, void *context)
{
    if (advice->places == 0)
        return true;
    scene_t *scene = calloc(1, sizeof *scene);
    warp_t *warp = malloc(sizeof *warp);
    bool ok = scene != NULL && warp != NULL && open_scene(scene, advice, camera, warp);
    for (int32_t m = 0; ok && m < WARP_METHODS; m++) {
        if (progress != NULL)
            progress(context, advice, m);
        ok = measure_method(advice, scene, m);
    }
    if (scene != NULL)
        close_scene(scene);
    free(warp);
    return ok;
}
