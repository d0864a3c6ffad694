// SPDX-License-Identifier: Apache-2.0
// One corrected frame: homography + picture -> what the projector must show.
#include "warp_fixed/warp.h"

#include <stddef.h>

#include "warp_fixed/fixed.h"

enum { WHOLE_ROW_LOG2 = 12 };

_Static_assert(IMAGE_MAX_WIDTH <= 1 << WHOLE_ROW_LOG2, "one block must hold a row");

/* What the rows of one frame share. */
typedef struct {
    warp_t *warp;
    const warp_kernels_t *kernels;
    const image_t *panel;
    image_t picture;      /* as it came, or filtered for WARP_NEAREST; unset for WARP_LS */
    bool filtered;        /* windows are of coefficients */
    ls_surface_t surface; /* for WARP_LS only */
    int block_log2;       /* of the present rows' blocks */
} frame_t;

void warp_init(warp_t *warp, warp_method_t method, bool step_all, const uint8_t border[3])
{
    warp->method = method;
    warp->step_all = step_all;
    for (int channel = 0; channel < 3; channel++)
        warp->border[channel] = border[2 - channel];
    warp->border[3] = 0;
    warp->resampler = method.resampler;
    const bool is_auto = method.resampler == WARP_AUTO;
    const warp_resampler_t of_coefficients = is_auto ? WARP_MEAN_SPLINE : method.resampler;
    const warp_resampler_t of_texels = is_auto ? WARP_MEAN_CUBIC : method.resampler;
    if (!warp_splines(of_texels))
        window_weights_init(&warp->texel_weights, of_texels, false);
    if (warp_splines(of_coefficients) || method.filter != WARP_FILTER_NONE)
        window_weights_init(&warp->coefficient_weights, of_coefficients, true);
    if (method.resampler == WARP_LS)
        ls_init(&warp->ls);
    else
        prefilter_init(&warp->prefilter);
}

void warp_set_ls_weights(warp_t *warp, const ls_weights_t *weights)
{
    if (warp->method.resampler == WARP_LS)
        ls_set_weights(&warp->ls, weights);
}

static void fill_border(const warp_t *warp, const image_t *panel, int32_t j, int32_t begin, int32_t end)
{
    const int32_t channels = (int32_t)panel->format;
    uint8_t *out = image_row(panel, j) + begin * channels;
    for (int32_t i = begin; i < end; i++)
        for (int32_t channel = 0; channel < channels; channel++)
            *out++ = warp->border[channel];
}

/* What the resampler reads; smaller levels and coefficients are made when a block asks for them. */
static void prepare_picture(frame_t *frame, const image_t *picture, int32_t k_q16)
{
    warp_t *warp = frame->warp;
    if (warp->resampler == WARP_LS) {
        frame->surface = ls_fit(&warp->ls, frame->kernels, picture, k_q16);
        return;
    }
    frame->picture = *picture;
    frame->filtered = prefilter_begin(&warp->prefilter, warp->method.filter, k_q16, warp_splines(warp->resampler));
    if (frame->filtered && warp->resampler == WARP_NEAREST)
        frame->picture = prefilter_pixels(&warp->prefilter, frame->kernels, picture);
    levels_begin(&warp->levels);
}

/* Weights and level of every lit block of the block row that begins at row j. */
static void choose_blocks(frame_t *frame, int32_t j)
{
    warp_t *warp = frame->warp;
    footprint_blocks(&warp->blocks, &warp->grid, j, frame->block_log2);
    for (int32_t b = warp->blocks.begin; b < warp->blocks.end; b++) {
        const footprint_sides_t sides = warp->blocks.block[b];
        warp->block[b] = (warp_block_t){window_side(warp->resampler, sides.width_q16),
                                        window_side(warp->resampler, sides.height_q16)};
    }
}

static window_t window_of(const frame_t *frame, const warp_block_t *block)
{
    warp_t *warp = frame->warp;
    const window_weights_t *weights = frame->filtered ? &warp->coefficient_weights : &warp->texel_weights;
    const int level_x = block->x.level, level_y = block->y.level;
    window_t window = {
        .x = window_axis(weights, block->x.side),
        .y = window_axis(weights, block->y.side),
        .picture = levels_picture(&warp->levels, &frame->picture, level_x, level_y),
        .width = frame->picture.width,
        .height = frame->picture.height,
        .level_x = level_x,
        .level_y = level_y,
    };
    if (frame->filtered)
        window.coefficients =
            prefilter_coefficients(&warp->prefilter, frame->kernels, &window.picture, level_x, level_y);
    return window;
}

/* Resample pixels [begin, end) of row j, whose points are x and y; the pieces of each footprint block in turn. */
static void resample(const frame_t *frame, int32_t j, int32_t begin, int32_t end, const int32_t *x, const int32_t *y)
{
    const warp_kernels_t *kernels = frame->kernels;
    const bool gray = frame->panel->format == IMAGE_GRAY8;
    uint8_t *row = image_row(frame->panel, j);
    const int32_t channels = (int32_t)frame->panel->format;
    if (frame->warp->resampler == WARP_NEAREST) {
        resample_nearest_fn *nearest = gray ? kernels->nearest_gray : kernels->nearest_xrgb;
        nearest(row + begin * channels, &frame->picture, x, y, end - begin);
        return;
    }
    if (frame->warp->resampler == WARP_LS) {
        resample_ls_fn *evaluate = gray ? kernels->ls_gray : kernels->ls_xrgb;
        evaluate(row + begin * channels, &frame->surface, x, y, end - begin);
        return;
    }
    resample_window_fn *weigh = gray ? kernels->window_gray : kernels->window_xrgb;
    if (frame->filtered)
        weigh = gray ? kernels->coefficients_gray : kernels->coefficients_xrgb;
    for (int32_t i = begin; i < end;) {
        const int32_t block = i >> frame->block_log2, block_end = (block + 1) << frame->block_log2;
        const int32_t piece_end = block_end < end ? block_end : end;
        const window_t window = window_of(frame, &frame->warp->block[block]);
        weigh(row + i * channels, &window, x + (i - begin), y + (i - begin), piece_end - i);
        i = piece_end;
    }
}

static void make_row(const frame_t *frame, int32_t j)
{
    const grid_t *grid = &frame->warp->grid;
    const grid_row_t *row = &grid->row[j];
    int32_t x_q18[GRID_MAX_SPAN], y_q18[GRID_MAX_SPAN];
    fill_border(frame->warp, frame->panel, j, 0, row->begin);
    for (int32_t begin = row->begin; begin < row->end;) {
        const int32_t end = grid_block_end(grid, j, begin);
        const grid_quadratic_t block = grid_block(grid, j, begin, end);
        frame->kernels->grid_points(x_q18, y_q18, &block, end - begin);
        resample(frame, j, begin, end, x_q18, y_q18);
        begin = end;
    }
    fill_border(frame->warp, frame->panel, j, row->end, frame->panel->width);
}

static int32_t lit_pixels(const grid_t *grid, int32_t rows)
{
    int32_t lit = 0;
    for (int32_t j = 0; j < rows; j++)
        lit += grid->row[j].end - grid->row[j].begin;
    return lit;
}

static bool image_fits(const image_t *image, int32_t width, int32_t height, image_format_t format)
{
    return image->width == width && image->height == height && image->format == format && width >= 1 && height >= 1 &&
           width <= IMAGE_MAX_WIDTH && height <= IMAGE_MAX_HEIGHT;
}

bool warp_frame(warp_t *warp, const warp_kernels_t *kernels, warp_report_t *report, const homography_t *homography,
                const image_t *panel, const image_t *picture)
{
    if (!image_fits(panel, homography->panel_width, homography->panel_height, panel->format) ||
        !image_fits(picture, homography->picture_width, homography->picture_height, panel->format))
        return false;

    const footprint_step_t step = footprint_step(homography);
    const int32_t k_q16 = warp->step_all ? step.all_q16 : step.in_q16;
    if (warp->method.resampler == WARP_AUTO)
        warp->resampler = warp_resampler_for_step(warp->resampler, k_q16);
    grid_from_homography(&warp->grid, homography);
    const int32_t lit = lit_pixels(&warp->grid, panel->height);

    /* Plain interpolation has no sides: one block, of side 0, serves every row. */
    frame_t frame = {.warp = warp, .kernels = kernels, .panel = panel, .block_log2 = WHOLE_ROW_LOG2};
    warp->block[0] = (warp_block_t){{0, 0}, {0, 0}};
    const bool averages = warp_averages(warp->resampler);
    if (lit > 0)
        prepare_picture(&frame, picture, k_q16);
    for (int32_t j = 0; j < panel->height; j++) {
        if (averages && j % FOOTPRINT_BAND == 0)
            frame.block_log2 = footprint_block_log2(&warp->grid, j);
        if (averages && j % (1 << frame.block_log2) == 0)
            choose_blocks(&frame, j);
        make_row(&frame, j);
    }
    if (report != NULL)
        *report = (warp_report_t){step.in_q16, step.all_q16, lit, warp->resampler};
    return true;
}
