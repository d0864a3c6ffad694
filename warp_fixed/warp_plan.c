// SPDX-License-Identifier: Apache-2.0
// The plan of a frame: planes and their homographies, grids, filters, and how the bands are dealt.
#include <stddef.h>

#include "warp_fixed/color.h"
#include "warp_fixed/grid_row.h"
#include "warp_fixed/homography_of_chroma.h"
#include "warp_fixed/warp.h"
#include "warp_fixed/warp_convert.h"

static bool formats_fit(picture_format_t panel, picture_format_t picture)
{
    if (picture_is_yuv(picture))
        return panel == PICTURE_XRGB8888 || panel == PICTURE_YUYV || panel == PICTURE_NV12;
    return panel == (picture == PICTURE_GRAY8 ? PICTURE_GRAY8 : PICTURE_XRGB8888);
}

static bool pictures_fit(const homography_t *homography, const picture_t *panel, const picture_t *picture)
{
    return picture_is_valid(panel) && picture_is_valid(picture) && formats_fit(panel->format, picture->format) &&
           panel->width == homography->panel_width && panel->height == homography->panel_height &&
           picture->width == homography->picture_width && picture->height == homography->picture_height &&
           !(picture_is_yuv(picture->format) && panel->width % 2 != 0) &&
           !(picture->format == PICTURE_NV12 && panel->format == PICTURE_XRGB8888 && panel->height % 2 != 0);
}

/* Chroma of a panel that has none is warped in the picture's kind. */
static picture_format_t chroma_format(const picture_t *panel, const picture_t *picture)
{
    return picture_is_yuv(panel->format) ? panel->format : picture->format;
}

/* The border's colour in each plane. */
static void plan_borders(warp_t *warp)
{
    uint8_t yuv[3];
    color_yuv_from_bgr(yuv, warp->border, warp->picture.matrix);
    for (int channel = 0; channel < 4; channel++)
        warp->plane[0].border[channel] = warp->border[channel];
    if (warp->planes == 2) {
        warp->plane[0].border[0] = yuv[0];
        warp->plane[1].border[0] = yuv[1];
        warp->plane[1].border[1] = yuv[2];
    }
}

/* Where planes are read and written, and by which homography. */
static void plan_planes(warp_t *warp, const homography_t *homography, homography_t *chroma)
{
    const picture_t *panel = &warp->panel, *picture = &warp->picture;
    const picture_format_t format = chroma_format(panel, picture);
    warp->planes = picture_is_yuv(picture->format) ? 2 : 1;
    warp->unit_bands = warp->planes == 2 ? 1 << picture_chroma_rows_log2(format) : 1;
    for (int p = 0; p < warp->planes; p++) {
        const picture_t as_planes = {.format = warp->planes == 2 ? format : panel->format,
                                     .width = panel->width,
                                     .height = panel->height,
                                     .data = {panel->data[0], panel->data[1]},
                                     .stride = {panel->stride[0], panel->stride[1]}};
        warp->plane[p].panel = picture_plane(&as_planes, p);
        if (warp->planes == 2 && panel->format != PICTURE_NV12)
            warp->plane[p].panel.data = NULL;
        warp->plane[p].picture = warp_converted_plane(warp, p);
    }
    if (warp->planes == 2)
        homography_of_chroma(chroma, homography, (chroma_log2_t){1, picture_chroma_rows_log2(format)},
                             (chroma_log2_t){1, picture_chroma_rows_log2(picture->format)});
}

/* Units, and what they cost: a lit pixel some 16 times what an unlit one does. @return Lit pixels of plane 0. */
static int32_t plan_units(warp_t *warp)
{
    const warp_plane_t *plane = &warp->plane[0];
    const int32_t unit_rows = warp->unit_bands * WARP_BAND_ROWS, height = plane->panel.height;
    int32_t lit = 0;
    warp->units = (height + unit_rows - 1) / unit_rows;
    for (int32_t j = 0; j < height; j++) {
        if (j % unit_rows == 0)
            warp->cost_before[j / unit_rows] = 16 * lit + j * plane->panel.width;
        lit += plane->grid.row[j].end - plane->grid.row[j].begin;
    }
    warp->cost_before[warp->units] = 16 * lit + height * plane->panel.width;
    return lit;
}

static bool any_lit(const warp_plane_t *plane)
{
    int32_t lit = 0;
    for (int32_t j = 0; j < plane->panel.height; j++)
        lit += plane->grid.row[j].end - plane->grid.row[j].begin;
    return lit > 0;
}

/* Along the lit part of the middle lit row: how far down the picture does it go for each pixel along it? */
static bool is_turned(const grid_t *grid)
{
    int32_t first = 0, last = grid->panel_height - 1;
    while (first < last && grid->row[first].begin >= grid->row[first].end)
        first++;
    while (last > first && grid->row[last].begin >= grid->row[last].end)
        last--;
    const int32_t j = (first + last) / 2;
    int32_t x[2], y[2];
    if (!grid_point(grid, grid->row[j].begin, j, &x[0], &y[0]) ||
        !grid_point(grid, grid->row[j].end - 1, j, &x[1], &y[1]))
        return false;
    const int64_t along = (int64_t)x[1] - x[0], down = (int64_t)y[1] - y[0];
    /* tan 30 degrees is a little below 15 / 26 */
    return 26 * (down < 0 ? -down : down) > 15 * (along < 0 ? -along : along);
}

/* The step along each axis of the present frame's chroma. */
static chroma_step_t plan_chroma_step(const warp_t *warp, int32_t k_q16)
{
    const int panel = picture_chroma_rows_log2(chroma_format(&warp->panel, &warp->picture));
    const int picture = picture_chroma_rows_log2(warp->picture.format);
    return chroma_step(&warp->homography, k_q16, warp->step.pixel, (chroma_log2_t){1, panel},
                       (chroma_log2_t){1, picture});
}

/* The filters, or the axes to fit, of this frame's step. */
static void plan_pictures(warp_t *warp, int32_t k_q16)
{
    const bool filters = warp->any_lit && warp->filters, splines = warp_splines(warp->resampler);
    const warp_filter_t filter = warp->method.filter;
    chroma_step_t step = {k_q16, k_q16};
    const bool fits = warp->resampler == WARP_LS;
    for (int32_t w = 0; w < WORKERS_MAX; w++)
        for (int n = 0; n < PICTURE_MAX_PLANES * LEVELS * LEVELS; n++)
            warp->scratch[w].wanted[n / (LEVELS * LEVELS)][n / LEVELS % LEVELS][n % LEVELS] = false;
    for (int p = 0; p < warp->planes; p++) {
        warp->scratch[0].wanted[p][0][0] = !warp_averages(warp->resampler);
        if (p == 1 && warp->step_known)
            step = plan_chroma_step(warp, k_q16);
        if (warp->any_lit && fits)
            ls_begin(&warp->ls, p, &warp->plane[p].picture, &warp->plane[0].picture, step);
        warp->plane[p].filtered = filters && (p == 0 ? prefilter_begin(&warp->prefilter, filter, k_q16, splines)
                                                     : prefilter_begin_chroma(&warp->prefilter, filter, step, splines));
    }
}

/* @return The step that the frame is made for; 0 for methods that do not need it. */
static int32_t plan_step(warp_t *warp, const homography_t *homography)
{
    warp->homography = *homography;
    warp->step_known = warp->filters || warp->method.resampler == WARP_LS;
    warp->step = warp->step_known ? footprint_step(homography) : (footprint_step_t){.in_q16 = 0};
    return warp->step_all ? warp->step.all_q16 : warp->step.in_q16;
}

void warp_report_step(const warp_t *warp, warp_report_t *report)
{
    const footprint_step_t step = warp->step_known ? warp->step : footprint_step(&warp->homography);
    report->k_in_q16 = step.in_q16;
    report->k_all_q16 = step.all_q16;
}

bool warp_plan(warp_t *warp, const warp_kernels_t *kernels, warp_report_t *report, const homography_t *homography,
               const picture_t *panel, const picture_t *picture)
{
    if (!pictures_fit(homography, panel, picture))
        return false;

    const int32_t k_q16 = plan_step(warp, homography);
    if (warp->method.resampler == WARP_AUTO)
        warp->resampler = warp_resampler_for_step(warp->resampler, k_q16);
    warp->kernels = kernels;
    warp->panel = *panel;
    warp->picture = *picture;
    homography_t chroma;
    plan_planes(warp, homography, &chroma);
    plan_borders(warp);
    warp->any_lit = false;
    for (int p = 0; p < warp->planes; p++) {
        warp_plane_t *plane = &warp->plane[p];
        plane->bands = (plane->panel.height + WARP_BAND_ROWS - 1) / WARP_BAND_ROWS;
        grid_from_homography(&plane->grid, p == 0 ? homography : &chroma);
        warp->any_lit |= any_lit(plane);
        plane->is_turned = is_turned(&plane->grid);
    }
    const int32_t lit = plan_units(warp);
    plan_pictures(warp, k_q16);
    if (report != NULL)
        *report = (warp_report_t){warp->step.in_q16, warp->step.all_q16, lit, warp->resampler};
    return true;
}
