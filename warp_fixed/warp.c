// SPDX-License-Identifier: Apache-2.0
// One corrected frame: homography + picture -> what the projector must show.
#include "warp_fixed/warp.h"

#include <stddef.h>

#include "warp_fixed/fill_pixels.h"
#include "warp_fixed/fixed.h"

enum { TILE_ROWS_LOG2 = 4, TILE_COLUMNS_LOG2 = 6, TILE_COLUMNS = 1 << TILE_COLUMNS_LOG2 };

_Static_assert(1 << TILE_ROWS_LOG2 == (int)PATCH_MAX_HEIGHT, "a patch has a tile's rows");
_Static_assert((int)TILE_COLUMNS == (int)PATCH_MAX_WIDTH, "and its columns");
_Static_assert((int)FOOTPRINT_BAND == (int)PATCH_MAX_HEIGHT, "tiles hold whole blocks");
_Static_assert((int)TILE_COLUMNS % (int)GRID_MAX_SPAN == 0, "tiles hold whole spans");

/* What the rows of one frame share. */
typedef struct {
    warp_t *warp;
    const warp_kernels_t *kernels;
    const image_t *panel;
    image_t picture;             /* as it came, or filtered for WARP_NEAREST; unset for WARP_LS */
    bool filtered;               /* windows are of coefficients */
    ls_surface_t surface;        /* for WARP_LS only */
    int rows_log2, columns_log2; /* of the present blocks, which share a window; blocks are whole in a tile */
} frame_t;

/* Some rows of TILE_COLUMNS pixels, and their points: small enough to stay in the first-level cache. */
typedef struct {
    int32_t row, column;                                    /* of the first pixel */
    int32_t begin[PATCH_MAX_HEIGHT], end[PATCH_MAX_HEIGHT]; /* lit columns of each row */
    int32_t x_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH], y_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH];
} tile_t;

static void fill_border(const warp_t *warp, const image_t *panel, int32_t j, int32_t begin, int32_t end)
{
    uint8_t *out = image_row(panel, j) + begin * (int32_t)panel->format;
    fill_pixels(out, warp->border, panel->format, end - begin);
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
    frame->filtered =
        warp->filters && prefilter_begin(&warp->prefilter, warp->method.filter, k_q16, warp_splines(warp->resampler));
    if (frame->filtered && warp->resampler == WARP_NEAREST)
        frame->picture = prefilter_pixels(&warp->prefilter, frame->kernels, picture);
    levels_begin(&warp->levels);
}

/* Weights and level of every lit block of the block row that begins at row j. */
static void choose_blocks(frame_t *frame, int32_t j)
{
    warp_t *warp = frame->warp;
    footprint_blocks(&warp->blocks, &warp->grid, j, frame->rows_log2);
    for (int32_t b = warp->blocks.begin; b < warp->blocks.end; b++) {
        const footprint_sides_t sides = warp->blocks.block[b];
        warp->block[b] = (warp_block_t){window_side(warp->resampler, sides.width_q16),
                                        window_side(warp->resampler, sides.height_q16)};
    }
}

static window_t window_of(const frame_t *frame, const warp_block_t *block)
{
    warp_t *warp = frame->warp;
    const window_weights_t *weights =
        &warp->table[frame->filtered ? warp->coefficient_table : warp->texel_table].weights;
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

static void make_patch(const frame_t *frame, const patch_t *patch, const warp_block_t *block)
{
    const warp_kernels_t *kernels = frame->kernels;
    const bool gray = frame->panel->format == IMAGE_GRAY8;
    if (frame->warp->resampler == WARP_NEAREST) {
        (gray ? kernels->nearest_gray : kernels->nearest_xrgb)(patch, &frame->picture);
    } else if (frame->warp->resampler == WARP_LS) {
        (gray ? kernels->ls_gray : kernels->ls_xrgb)(patch, &frame->surface);
    } else {
        const window_t window = window_of(frame, block);
        if (frame->filtered)
            (gray ? kernels->coefficients_gray : kernels->coefficients_xrgb)(patch, &window);
        else
            (gray ? kernels->window_gray : kernels->window_xrgb)(patch, &window);
    }
}

/* The lit pixels of a row of the tile between two columns; none when begin >= end. */
typedef struct {
    int32_t begin, end;
} extent_t;

static extent_t extent_of(const tile_t *tile, int32_t r, int32_t first, int32_t last)
{
    return (extent_t){tile->begin[r] > first ? tile->begin[r] : first, tile->end[r] < last ? tile->end[r] : last};
}

/* The lit pixels of one block: rows of the same extent make one patch. */
static void make_block(const frame_t *frame, const tile_t *tile, int32_t rows, int32_t first)
{
    const int32_t last = first + (1 << frame->columns_log2), channels = (int32_t)frame->panel->format;
    for (int32_t r = 0, next; r < rows; r = next) {
        const extent_t lit = extent_of(tile, r, first, last);
        for (next = r + 1; next < rows; next++) {
            const extent_t below = extent_of(tile, next, first, last);
            if (below.begin != lit.begin || below.end != lit.end)
                break;
        }
        if (lit.begin >= lit.end)
            continue;
        const int32_t point = r * PATCH_MAX_WIDTH + lit.begin - tile->column;
        const patch_t patch = {
            .out = image_row(frame->panel, tile->row + r) + (ptrdiff_t)lit.begin * channels,
            .stride = frame->panel->stride,
            .x_q18 = tile->x_q18 + point,
            .y_q18 = tile->y_q18 + point,
            .width = lit.end - lit.begin,
            .height = next - r,
        };
        make_patch(frame, &patch, &frame->warp->block[first >> frame->columns_log2]);
    }
}

static void tile_points(tile_t *tile, const warp_kernels_t *kernels, const grid_row_cursor_t *row, int32_t rows)
{
    for (int32_t r = 0; r < rows; r++) {
        const grid_row_t lit = row[r].row;
        const int32_t begin = lit.begin > tile->column ? lit.begin : tile->column;
        const int32_t end = lit.end < tile->column + TILE_COLUMNS ? lit.end : tile->column + TILE_COLUMNS;
        const int32_t at = r * PATCH_MAX_WIDTH + begin - tile->column;
        tile->begin[r] = begin;
        tile->end[r] = end;
        if (begin < end)
            kernels->grid_points(tile->x_q18 + at, tile->y_q18 + at, &row[r], begin, end);
    }
}

/* One row of blocks, tile by tile. */
static void make_rows(const frame_t *frame, int32_t j, int32_t rows)
{
    int32_t first = frame->panel->width, last = 0;
    grid_row_cursor_t cursor[PATCH_MAX_HEIGHT];
    for (int32_t r = 0; r < rows; r++) {
        cursor[r] = grid_row_cursor(&frame->warp->grid, j + r);
        const grid_row_t row = cursor[r].row;
        fill_border(frame->warp, frame->panel, j + r, 0, row.begin);
        fill_border(frame->warp, frame->panel, j + r, row.end, frame->panel->width);
        if (row.begin < row.end) {
            first = row.begin < first ? row.begin : first;
            last = row.end > last ? row.end : last;
        }
    }
    tile_t tile;
    tile.row = j;
    for (tile.column = first & -TILE_COLUMNS; tile.column < last; tile.column += TILE_COLUMNS) {
        tile_points(&tile, frame->kernels, cursor, rows);
        for (int32_t column = 0; column < TILE_COLUMNS; column += 1 << frame->columns_log2)
            make_block(frame, &tile, rows, tile.column + column);
    }
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

    /* Plain interpolation has no sides: one block to a tile, of side 0. */
    frame_t frame = {.warp = warp,
                     .kernels = kernels,
                     .panel = panel,
                     .rows_log2 = TILE_ROWS_LOG2,
                     .columns_log2 = TILE_COLUMNS_LOG2};
    for (int b = 0; b < IMAGE_MAX_WIDTH / TILE_COLUMNS; b++)
        warp->block[b] = (warp_block_t){{0, 0}, {0, 0}};
    const bool averages = warp_averages(warp->resampler);
    if (lit > 0)
        prepare_picture(&frame, picture, k_q16);
    for (int32_t j = 0; j < panel->height; j += 1 << frame.rows_log2) {
        if (averages && j % FOOTPRINT_BAND == 0)
            frame.rows_log2 = frame.columns_log2 = footprint_block_log2(&warp->grid, j);
        if (averages)
            choose_blocks(&frame, j);
        const int32_t rows_left = panel->height - j, rows = 1 << frame.rows_log2;
        make_rows(&frame, j, rows < rows_left ? rows : rows_left);
    }
    if (report != NULL)
        *report = (warp_report_t){step.in_q16, step.all_q16, lit, warp->resampler};
    return true;
}
