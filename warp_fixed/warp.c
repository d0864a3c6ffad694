// SPDX-License-Identifier: Apache-2.0
// One corrected frame: homography + picture -> what the projector must show.
#include "warp_fixed/warp.h"

#include <stddef.h>

#include "warp_fixed/warp_band.h"
#include "warp_fixed/warp_convert.h"

bool warp_needs(const warp_t *warp, warp_step_t step)
{
    const bool averages = warp_averages(warp->resampler), fits = warp->resampler == WARP_LS;
    switch (step) {
    case WARP_TAKE:
        return warp->any_lit && warp_converts(warp);
    case WARP_MEASURE:
    case WARP_REDUCE:
        return warp->any_lit && averages;
    case WARP_FILTER:
        return warp->plane[0].filtered || (warp->planes == 2 && warp->plane[1].filtered);
    case WARP_FIT_ROWS:
    case WARP_FIT_COLUMNS:
        return warp->any_lit && fits;
    case WARP_DRAW:
        return true;
    }
    return false;
}

/* Does a block of any worker's bands read that level? */
static bool is_wanted(const warp_t *warp, level_t level)
{
    bool wanted = false;
    for (int32_t w = 0; w < WORKERS_MAX; w++)
        wanted |= warp->scratch[w].wanted[level.plane][level.x][level.y];
    return wanted;
}

static void reduce(warp_t *warp, int plane, worker_t worker)
{
    for (level_t level = {0, 0, plane}; level.x < LEVELS; level.x++)
        for (level.y = 0; level.y < LEVELS; level.y++)
            if (is_wanted(warp, level))
                levels_make(&warp->levels, &warp->plane[plane].picture, level, worker);
}

static void filter(warp_t *warp, int plane, worker_t worker)
{
    const image_t *picture = &warp->plane[plane].picture;
    if (warp->resampler == WARP_NEAREST) {
        prefilter_make_pixels(&warp->prefilter, warp->kernels, picture, plane, worker);
        return;
    }
    for (level_t level = {0, 0, plane}; level.x < LEVELS; level.x++) {
        for (level.y = 0; level.y < LEVELS; level.y++) {
            const image_t reduced = levels_picture(&warp->levels, picture, level);
            if (is_wanted(warp, level))
                prefilter_make_coefficients(&warp->prefilter, warp->kernels, &reduced, level, worker);
        }
    }
}

/* The first unit of a worker: where the units before cost nearest to what the workers before it should do. */
static int32_t first_unit(const warp_t *warp, worker_t worker)
{
    const int32_t *cost = warp->cost_before;
    const int64_t target = (int64_t)cost[warp->units] * worker.index / worker.count;
    int32_t unit = 0;
    while (unit < warp->units && (int64_t)cost[unit] + cost[unit + 1] <= 2 * target)
        unit++;
    return unit;
}

/* Bands of a plane in a unit. */
static share_t bands_of(const warp_t *warp, int plane, int32_t unit)
{
    const int32_t each = plane == 0 ? warp->unit_bands : 1, bands = warp->plane[plane].bands;
    return (share_t){unit * each, (unit + 1) * each < bands ? (unit + 1) * each : bands};
}

static void draw_unit(warp_t *warp, int32_t worker, int32_t unit)
{
    for (int plane = 0; plane < warp->planes; plane++) {
        const share_t bands = bands_of(warp, plane, unit);
        const warp_target_t target = warp_target(warp, plane, worker, bands.begin * WARP_BAND_ROWS);
        for (int32_t band = bands.begin; band < bands.end; band++)
            warp_band_draw(warp, plane, worker, band, &target);
    }
    if (warp->plane[0].panel.data == NULL)
        warp_pack(warp, worker, unit * warp->unit_bands * WARP_BAND_ROWS);
}

static void measure_unit(warp_t *warp, int32_t worker, int32_t unit)
{
    for (int plane = 0; plane < warp->planes; plane++) {
        const share_t bands = bands_of(warp, plane, unit);
        for (int32_t band = bands.begin; band < bands.end; band++)
            warp_band_measure(warp, plane, worker, band);
    }
}

/* One plane's share of the steps that make what bands read. */
static void work_on_plane(warp_t *warp, warp_step_t step, int plane, worker_t worker)
{
    const image_t *picture = &warp->plane[plane].picture;
    if (step == WARP_REDUCE)
        reduce(warp, plane, worker);
    else if (step == WARP_FILTER && warp->plane[plane].filtered)
        filter(warp, plane, worker);
    else if (step == WARP_FIT_ROWS)
        ls_fit_rows(&warp->ls, warp->kernels, plane, picture, worker);
    else if (step == WARP_FIT_COLUMNS)
        ls_fit_columns(&warp->ls, warp->kernels, plane, picture, worker);
}

void warp_work(warp_t *warp, warp_step_t step, worker_t worker)
{
    const worker_t next = {worker.index + 1, worker.count};
    const share_t units = {first_unit(warp, worker), first_unit(warp, next)};
    if (step == WARP_TAKE)
        warp_take(warp, worker);
    for (int plane = 0; plane < warp->planes; plane++)
        work_on_plane(warp, step, plane, worker);
    for (int32_t unit = units.begin; unit < units.end; unit++) {
        if (step == WARP_MEASURE)
            measure_unit(warp, worker.index, unit);
        else if (step == WARP_DRAW)
            draw_unit(warp, worker.index, unit);
    }
}

bool warp_frame(warp_t *warp, const warp_kernels_t *kernels, warp_report_t *report, const homography_t *homography,
                const image_t *panel, const image_t *picture)
{
    const picture_t to = picture_from_image(panel), from = picture_from_image(picture);
    if (!warp_plan(warp, kernels, report, homography, &to, &from))
        return false;
    if (report != NULL)
        warp_report_step(warp, report);
    for (warp_step_t step = WARP_MEASURE; step <= WARP_DRAW; step++)
        if (warp_needs(warp, step))
            warp_work(warp, step, only_worker);
    return true;
}
