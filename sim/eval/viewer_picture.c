// SPDX-License-Identifier: Apache-2.0
// What the viewer's eye sees of the lit walls.
#include "sim/eval/viewer_picture.h"

#include <assert.h>
#include <stddef.h>

/* A linear function along a row of looks: start + k step at look k. */
typedef struct {
    double start, step;
} line_t;

/* One wall along one row of looks: it shows its pixel (x / w, y / w). Looks outside [begin, end) miss it. */
typedef struct {
    line_t x, y, w, inverse_depth;
    const image_t *shown;
    int32_t begin, end;
} wall_row_t;

typedef struct {
    wall_row_t wall[VIEWER_MAX_WALLS];
    int32_t count;
} look_row_t;

typedef struct {
    const image_t *out;
    const viewer_wall_t *walls;
    int32_t wall_count, samples;
} view_t;

static double at(line_t line, int32_t k)
{
    return line.start + k * line.step;
}

/* Along row `row` of looks, form . (x, y, 1) in the camera's picture points, times scale. */
static line_t line_of(const view_t *view, const double_homography_t *h, const double form[3], double scale, int32_t row)
{
    const double look_width = (double)h->picture_width / (view->out->width * view->samples);
    const double look_height = (double)h->picture_height / (view->out->height * view->samples);
    const double step = form[0] * look_width * scale;
    return (line_t){(form[1] * (row + 0.5) * look_height + form[2]) * scale + 0.5 * step, step};
}

/* Narrow the wall's looks to those where line >= 0, and a look more on either side: look_at() is exact. */
static void clip(wall_row_t *wall, line_t line)
{
    const double zero = -line.start / line.step;
    if (line.step > 0.0 && zero > wall->begin)
        wall->begin = zero < wall->end ? (int32_t)zero : wall->end;
    else if (line.step < 0.0 && zero < wall->end - 1)
        wall->end = zero > wall->begin ? (int32_t)zero + 2 : wall->begin;
}

static wall_row_t wall_row(const view_t *view, const viewer_wall_t *wall, int32_t row)
{
    const double_homography_t *h = &wall->homography;
    wall_row_t out = {
        .x = line_of(view, h, h->panel_from_picture[0], (double)wall->shown.width / h->panel_width, row),
        .y = line_of(view, h, h->panel_from_picture[1], (double)wall->shown.height / h->panel_height, row),
        .w = line_of(view, h, h->panel_from_picture[2], 1.0, row),
        .inverse_depth = line_of(view, h, h->inverse_depth, 1.0, row),
        .shown = &wall->shown,
        .begin = 0,
        .end = view->out->width * view->samples,
    };
    const double width = wall->shown.width, height = wall->shown.height;
    clip(&out, out.w);
    clip(&out, out.x);
    clip(&out, out.y);
    clip(&out, (line_t){width * out.w.start - out.x.start, width * out.w.step - out.x.step});
    clip(&out, (line_t){height * out.w.start - out.y.start, height * out.w.step - out.y.step});
    return out;
}

/* The wall's pixel at look k, or NULL. */
static const uint8_t *look_at(const wall_row_t *wall, int32_t k)
{
    const image_t *shown = wall->shown;
    const double w = at(wall->w, k);
    if (!(w > 0.0))
        return NULL;
    const double x = at(wall->x, k) / w, y = at(wall->y, k) / w;
    if (!(x >= 0.0 && y >= 0.0 && x < shown->width && y < shown->height))
        return NULL;
    return image_row(shown, (int32_t)y) + (int32_t)x * (int32_t)shown->format;
}

/* The nearest wall's pixel at look k, or NULL. */
static const uint8_t *look(const look_row_t *row, int32_t k)
{
    const uint8_t *seen = NULL;
    double nearest = 0.0; /* the largest inverse depth */
    for (int32_t n = 0; n < row->count; n++) {
        const wall_row_t *wall = &row->wall[n];
        if (k < wall->begin || k >= wall->end)
            continue;
        const uint8_t *pixel = look_at(wall, k);
        const double inverse_depth = at(wall->inverse_depth, k);
        if (pixel != NULL && (seen == NULL || inverse_depth > nearest)) {
            seen = pixel;
            nearest = inverse_depth;
        }
    }
    return seen;
}

/* sum[] has a number for each channel of the row's pixels. */
static void add_looks(const view_t *view, int32_t row, int32_t *sum)
{
    static const uint8_t background[4] = {VIEWER_BACKGROUND, VIEWER_BACKGROUND, VIEWER_BACKGROUND, 0};
    const int32_t channels = (int32_t)view->out->format;
    look_row_t looks = {.count = 0};
    for (int32_t n = 0; n < view->wall_count; n++) {
        const wall_row_t wall = wall_row(view, &view->walls[n], row);
        if (wall.begin < wall.end)
            looks.wall[looks.count++] = wall;
    }
    for (int32_t x = 0; x < view->out->width; x++)
        for (int32_t s = 0; s < view->samples; s++) {
            const uint8_t *seen = look(&looks, x * view->samples + s);
            if (seen == NULL)
                seen = background;
            for (int32_t channel = 0; channel < channels; channel++)
                sum[x * channels + channel] += seen[channel];
        }
}

void viewer_picture(const image_t *out, const viewer_wall_t *walls, int32_t wall_count, int32_t samples)
{
    assert(wall_count <= VIEWER_MAX_WALLS && samples >= 1 && samples <= VIEWER_MAX_SAMPLES);
    const view_t view = {out, walls, wall_count, samples};
    const int32_t values = out->width * (int32_t)out->format, looks = samples * samples;
    for (int32_t y = 0; y < out->height; y++) {
        int32_t sum[IMAGE_MAX_WIDTH * IMAGE_XRGB8888] = {0};
        for (int32_t s = 0; s < samples; s++)
            add_looks(&view, y * samples + s, sum);
        uint8_t *pixels = image_row(out, y);
        for (int32_t n = 0; n < values; n++)
            pixels[n] = (uint8_t)((2 * sum[n] + looks) / (2 * looks));
    }
}
