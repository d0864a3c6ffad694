// SPDX-License-Identifier: Apache-2.0
// A band of the panel's rows: sides of its blocks, then its pixels, tile by tile.
#include "warp_fixed/warp_band.h"

#include <stddef.h>

#include "warp_fixed/fill_pixels.h"

/*
 * Plain interpolation goes through a tile in one piece, or in halves where the picture is turned: the panel's rows then
 * run down the picture. By the model of an A72's cache (make bench-cache) linear fetches 0.32 lines a pixel at 90
 * degrees in halves, 0.43 in one piece; at 45 degrees 0.261 and 0.265, at 30 and less there is nothing to gain.
 */
enum { TILE_COLUMNS_LOG2 = 6, TILE_COLUMNS = 1 << TILE_COLUMNS_LOG2, HALF_LOG2 = TILE_COLUMNS_LOG2 - 1, BAND_LOG2 = 4 };

_Static_assert((int)WARP_BAND_ROWS == 1 << BAND_LOG2, "the largest blocks are as high as a band");
_Static_assert((int)PATCH_MAX_HEIGHT == (int)WARP_BAND_ROWS, "a patch has a band's rows");
_Static_assert((int)PATCH_MAX_WIDTH == (int)TILE_COLUMNS, "and a tile's columns");
_Static_assert((int)TILE_COLUMNS % (int)GRID_MAX_SPAN == 0, "tiles hold whole spans");

/* Some rows of a band, and their blocks, which share a window each; blocks are whole in a tile. */
typedef struct {
    warp_t *warp;
    const warp_plane_t *plane;
    int number; /* of the plane */
    const warp_target_t *target;
    int32_t row, rows;
    int columns_log2; /* of the blocks */
    const warp_block_t *block;
} rows_t;

/* Some rows of TILE_COLUMNS pixels, and their points: small enough to stay in the first-level cache. */
typedef struct {
    int32_t column;                                         /* of the first pixel */
    bool is_whole;                                          /* all of it is lit */
    int32_t begin[PATCH_MAX_HEIGHT], end[PATCH_MAX_HEIGHT]; /* else: lit columns of each row */
    int32_t x_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH], y_q18[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH];
} tile_t;

/* Weights and level of every lit block of the block row that begins at row j. @return Which blocks these are. */
static share_t choose_blocks(const warp_t *warp, const grid_t *grid, footprint_blocks_t *sides, warp_block_t *block,
                             int32_t j, int size_log2)
{
    footprint_blocks(sides, grid, j, size_log2);
    for (int32_t b = sides->begin; b < sides->end; b++)
        block[b] = (warp_block_t){window_side(warp->resampler, sides->block[b].width_q16),
                                  window_side(warp->resampler, sides->block[b].height_q16)};
    return (share_t){sides->begin, sides->end};
}

static int32_t band_end(const warp_plane_t *plane, int32_t band)
{
    const int32_t end = (band + 1) * WARP_BAND_ROWS, height = plane->panel.height;
    return end < height ? end : height;
}

void warp_band_measure(warp_t *warp, int number, int32_t worker, int32_t band)
{
    warp_plane_t *plane = &warp->plane[number];
    warp_scratch_t *scratch = &warp->scratch[worker];
    const int32_t first_row = band * WARP_BAND_ROWS;
    const int log2 = footprint_block_log2(&plane->grid, first_row);
    warp_block_t *block = log2 == BAND_LOG2 ? plane->block[band] : scratch->block;
    plane->block_log2[band] = (uint8_t)log2;
    for (int32_t j = first_row; j < band_end(plane, band); j += 1 << log2) {
        const share_t lit = choose_blocks(warp, &plane->grid, &scratch->sides, block, j, log2);
        for (int32_t b = lit.begin; b < lit.end; b++)
            scratch->wanted[number][block[b].x.level][block[b].y.level] = true;
    }
}

/* The loops for so many channels of a pixel. */
typedef struct {
    resample_nearest_fn *nearest;
    resample_window_fn *window, *coefficients;
    resample_ls_fn *ls;
} loops_t;

static loops_t loops_for(const warp_kernels_t *kernels, image_format_t format)
{
    if (format == IMAGE_GRAY8)
        return (loops_t){kernels->nearest_gray, kernels->window_gray, kernels->coefficients_gray, kernels->ls_gray};
    if (format == IMAGE_UV88)
        return (loops_t){kernels->nearest_chroma, kernels->window_chroma, kernels->coefficients_chroma,
                         kernels->ls_chroma};
    return (loops_t){kernels->nearest_xrgb, kernels->window_xrgb, kernels->coefficients_xrgb, kernels->ls_xrgb};
}

static window_t window_of(const rows_t *rows, const warp_block_t *block)
{
    warp_t *warp = rows->warp;
    const image_t *picture = &rows->plane->picture;
    const window_weights_t *weights =
        &warp->table[rows->plane->filtered ? warp->coefficient_table : warp->texel_table].weights;
    const level_t level = {block->x.level, block->y.level, rows->number};
    window_t window = {
        .x = window_axis(weights, block->x.side),
        .y = window_axis(weights, block->y.side),
        .picture = levels_picture(&warp->levels, picture, level),
        .width = picture->width,
        .height = picture->height,
        .level_x = level.x,
        .level_y = level.y,
    };
    if (rows->plane->filtered)
        window.coefficients = prefilter_coefficients(&warp->prefilter, &window.picture, level);
    return window;
}

static void make_patch(const rows_t *rows, const patch_t *patch, const warp_block_t *block)
{
    warp_t *warp = rows->warp;
    const image_t *picture = &rows->plane->picture;
    const loops_t loops = loops_for(warp->kernels, picture->format);
    if (warp->resampler == WARP_NEAREST) {
        const image_t from =
            rows->plane->filtered ? prefilter_pixels(&warp->prefilter, picture, rows->number) : *picture;
        loops.nearest(patch, &from);
    } else if (warp->resampler == WARP_LS) {
        const ls_surface_t surface = ls_surface(&warp->ls, rows->number);
        loops.ls(patch, &surface);
    } else {
        const window_t window = window_of(rows, block);
        (rows->plane->filtered ? loops.coefficients : loops.window)(patch, &window);
    }
}

/* The lit pixels of a row of the tile between two columns; none when begin >= end. */
typedef struct {
    int32_t begin, end;
} extent_t;

static extent_t extent_of(const tile_t *tile, int32_t r, int32_t first, int32_t last)
{
    if (tile->is_whole)
        return (extent_t){first, last};
    return (extent_t){tile->begin[r] > first ? tile->begin[r] : first, tile->end[r] < last ? tile->end[r] : last};
}

static uint8_t *row_of(const rows_t *rows, int32_t j)
{
    return image_row(&rows->target->image, j - rows->target->first_row);
}

/* The lit pixels of one block: rows of the same extent make one patch. */
static void make_block(const rows_t *rows, const tile_t *tile, int32_t first)
{
    const int32_t last = first + (1 << rows->columns_log2), channels = (int32_t)rows->plane->panel.format;
    for (int32_t r = 0, next; r < rows->rows; r = next) {
        const extent_t lit = extent_of(tile, r, first, last);
        for (next = tile->is_whole ? rows->rows : r + 1; next < rows->rows; next++) {
            const extent_t below = extent_of(tile, next, first, last);
            if (below.begin != lit.begin || below.end != lit.end)
                break;
        }
        if (lit.begin >= lit.end)
            continue;
        const int32_t point = r * PATCH_MAX_WIDTH + lit.begin - tile->column;
        const patch_t patch = {
            .out = row_of(rows, rows->row + r) + (ptrdiff_t)lit.begin * channels,
            .stride = rows->target->image.stride,
            .x_q18 = tile->x_q18 + point,
            .y_q18 = tile->y_q18 + point,
            .width = lit.end - lit.begin,
            .height = next - r,
        };
        make_patch(rows, &patch, &rows->block[first >> rows->columns_log2]);
    }
}

/* The rows of a row of tiles, and their lit columns. */
typedef struct {
    grid_row_cursor_t cursor[PATCH_MAX_HEIGHT];
    int32_t begin[PATCH_MAX_HEIGHT], end[PATCH_MAX_HEIGHT];
    extent_t any, all; /* columns that are lit in one row at least, and in every one */
} lit_rows_t;

static void find_lit_rows(lit_rows_t *lit, const rows_t *rows)
{
    const int32_t width = rows->plane->panel.width;
    lit->any = (extent_t){width, 0};
    lit->all = (extent_t){0, width};
    for (int32_t r = 0; r < rows->rows; r++) {
        lit->cursor[r] = grid_row_cursor(&rows->plane->grid, rows->row + r);
        const grid_row_t row = lit->cursor[r].row;
        const bool is_lit = row.begin < row.end;
        lit->begin[r] = is_lit ? row.begin : 0;
        lit->end[r] = is_lit ? row.end : 0;
        lit->all.begin = lit->begin[r] > lit->all.begin ? lit->begin[r] : lit->all.begin;
        lit->all.end = lit->end[r] < lit->all.end ? lit->end[r] : lit->all.end;
        if (!is_lit)
            continue;
        lit->any.begin = row.begin < lit->any.begin ? row.begin : lit->any.begin;
        lit->any.end = row.end > lit->any.end ? row.end : lit->any.end;
    }
}

static void fill_borders(const rows_t *rows, const lit_rows_t *lit)
{
    const warp_plane_t *plane = rows->plane;
    const image_format_t format = plane->panel.format;
    for (int32_t r = 0; r < rows->rows; r++) {
        uint8_t *out = row_of(rows, rows->row + r);
        fill_pixels(out, plane->border, format, lit->begin[r]);
        fill_pixels(out + lit->end[r] * (int32_t)format, plane->border, format, plane->panel.width - lit->end[r]);
    }
}

static void tile_points(tile_t *tile, const rows_t *rows, const lit_rows_t *lit)
{
    const int32_t first = tile->column, last = first + TILE_COLUMNS;
    grid_points_fn *points = rows->warp->kernels->grid_points;
    const int32_t height = rows->rows;
    tile->is_whole = lit->all.begin <= first && lit->all.end >= last;
    if (tile->is_whole) {
        for (int32_t r = 0, at = 0; r < height; r++, at += PATCH_MAX_WIDTH)
            points(tile->x_q18 + at, tile->y_q18 + at, &lit->cursor[r], first, last);
        return;
    }
    for (int32_t r = 0; r < height; r++) {
        const int32_t begin = lit->begin[r] > first ? lit->begin[r] : first;
        const int32_t end = lit->end[r] < last ? lit->end[r] : last, at = r * PATCH_MAX_WIDTH + begin - first;
        tile->begin[r] = begin;
        tile->end[r] = end;
        if (begin < end)
            points(tile->x_q18 + at, tile->y_q18 + at, &lit->cursor[r], begin, end);
    }
}

/* One row of blocks, tile by tile. */
static void make_rows(const rows_t *rows)
{
    lit_rows_t lit;
    tile_t tile;
    find_lit_rows(&lit, rows);
    fill_borders(rows, &lit);
    for (tile.column = lit.any.begin & -TILE_COLUMNS; tile.column < lit.any.end; tile.column += TILE_COLUMNS) {
        tile_points(&tile, rows, &lit);
        for (int32_t column = 0; column < TILE_COLUMNS; column += 1 << rows->columns_log2)
            make_block(rows, &tile, tile.column + column);
    }
}

void warp_band_draw(warp_t *warp, int number, int32_t worker, int32_t band, const warp_target_t *target)
{
    /* Plain interpolation has no sides: blocks of side 0. */
    static const warp_block_t plain[IMAGE_MAX_WIDTH >> HALF_LOG2];
    const warp_plane_t *plane = &warp->plane[number];
    const bool averages = warp_averages(warp->resampler);
    const int log2 = averages ? plane->block_log2[band] : BAND_LOG2;
    warp_scratch_t *scratch = &warp->scratch[worker];
    rows_t rows = {.warp = warp,
                   .plane = plane,
                   .number = number,
                   .target = target,
                   .columns_log2 = log2,
                   .block = log2 == BAND_LOG2 ? plane->block[band] : scratch->block};
    if (!averages) {
        rows.columns_log2 = plane->is_turned ? HALF_LOG2 : TILE_COLUMNS_LOG2;
        rows.block = plain;
    }
    for (int32_t j = band * WARP_BAND_ROWS, end = band_end(plane, band); j < end; j += 1 << log2) {
        if (rows.block == scratch->block)
            (void)choose_blocks(warp, &plane->grid, &scratch->sides, scratch->block, j, log2);
        rows.row = j;
        rows.rows = 1 << log2 < end - j ? 1 << log2 : end - j;
        make_rows(&rows);
    }
}
