// SPDX-License-Identifier: Apache-2.0
// The mesh evaluation with uneven pixels and walls: how well the seen light matches the true picture.
#include "sim/eval/pixel_view.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "sim/eval/double_view.h"
#include "sim/eval/mesh_psnr.h"

/* What the samples are traced with. */
typedef struct {
    const double_homography_t *homography;
    const double *eye_m;
    const pixel_model_t *model;
    double_wall_t wall;
    double normal[3];
    double sample_px; /* of the picture */
} trace_t;

static void normal_of(const double_wall_t *wall, int32_t width, int32_t height, double normal[3])
{
    double p[3][3], a[3], b[3];
    double_wall_point(wall, (const double[2]){0.0, 0.0}, p[0]);
    double_wall_point(wall, (const double[2]){width, 0.0}, p[1]);
    double_wall_point(wall, (const double[2]){0.0, height}, p[2]);
    for (int i = 0; i < 3; i++) {
        a[i] = p[1][i] - p[0][i];
        b[i] = p[2][i] - p[0][i];
    }
    for (int i = 0; i < 3; i++)
        normal[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Light over the sample's own width on the panel, so that the gaps between pixels do not beat with the samples. */
static double profile_along(const trace_t *trace, int axis, const double p[3])
{
    const double(*rows)[3] = trace->homography->panel_from_picture;
    const double at = p[axis] / p[2];
    const double half =
        0.5 * trace->sample_px / p[2] * hypot(rows[axis][0] - at * rows[2][0], rows[axis][1] - at * rows[2][1]);
    return pixel_profile_mean(&trace->model->profile, at - half, at + half);
}

static pixel_sample_t trace_sample(const trace_t *trace, double x, double y)
{
    static const pixel_sample_t no_wall = {PIXEL_VIEW_NO_WALL, 0, 0.0F, 0.0F};
    const double_homography_t *h = trace->homography;
    double p[3], point_m[3];
    for (int r = 0; r < 3; r++)
        p[r] = h->panel_from_picture[r][0] * x + h->panel_from_picture[r][1] * y + h->panel_from_picture[r][2];
    if (!(p[2] > 0.0))
        return no_wall;
    const double u = p[0] / p[2], v = p[1] / p[2];
    if (!(u >= 0.0 && v >= 0.0 && u < h->panel_width && v < h->panel_height))
        return no_wall;
    double_wall_point(&trace->wall, (const double[2]){u, v}, point_m);
    const double profile = profile_along(trace, 0, p) * profile_along(trace, 1, p);
    const double gain = pixel_screen_gain(&trace->model->screen, point_m, trace->normal, trace->eye_m);
    return (pixel_sample_t){(uint16_t)u, (uint16_t)v, (float)profile, (float)gain};
}

bool pixel_view(pixel_view_t *view, const double_homography_t *homography, const wall_t *wall, const double eye_m[3],
                const pixel_model_t *model, int32_t factor)
{
    assert(factor >= 2 && factor % 2 == 0 && factor <= PIXEL_VIEW_MAX_FACTOR);
    pixel_view_t made = {.width = homography->picture_width, .height = homography->picture_height, .factor = factor};
    made.sample = malloc((size_t)made.width * (size_t)made.height * (size_t)(factor * factor) * sizeof *made.sample);
    made.field = malloc(2 * (size_t)made.width * 2 * (size_t)made.height * sizeof *made.field);
    if (made.sample == NULL || made.field == NULL) {
        pixel_view_free(&made);
        return false;
    }
    trace_t trace = {.homography = homography, .eye_m = eye_m, .model = model, .sample_px = 1.0 / factor};
    double_wall(&trace.wall, wall);
    normal_of(&trace.wall, wall->panel_width, wall->panel_height, trace.normal);
    pixel_sample_t *sample = made.sample;
    double sum = 0.0;
    for (int32_t y = 0; y < made.height * factor; y++)
        for (int32_t x = 0; x < made.width * factor; x++, sample++) {
            *sample = trace_sample(&trace, (x + 0.5) / factor, (y + 0.5) / factor);
            made.covered += sample->x != PIXEL_VIEW_NO_WALL;
            sum += (double)sample->gain;
        }
    if (made.covered > 0)
        made.mean_gain = sum / (double)made.covered;
    *view = made;
    return true;
}

void pixel_view_free(pixel_view_t *view)
{
    free(view->sample);
    free(view->field);
    view->sample = NULL;
    view->field = NULL;
}

/* Squared errors and how many. */
typedef struct {
    double square;
    int64_t count;
} error_t;

static void add_error(error_t *error, double off)
{
    error->square += off * off;
    error->count++;
}

/* Seen light against the true picture's. */
typedef struct {
    const pixel_view_t *view;
    const image_t *panel, *truth;
    bool even; /* the true picture's wall */
} compare_t;

static double difference(const compare_t *compare, const pixel_sample_t *sample, double truth)
{
    const double gain = (double)sample->gain / compare->view->mean_gain;
    const double light = image_row(compare->panel, sample->y)[sample->x] * (double)sample->profile * gain;
    return light - truth * (compare->even ? 1.0 : gain);
}

/* The mean difference over half a picture pixel each way, from its first sample on. NaN unless all is covered. */
static double half_pixel(const compare_t *compare, const pixel_sample_t *first, double truth, error_t *fine)
{
    const int32_t side = compare->view->factor / 2;
    const ptrdiff_t stride = (ptrdiff_t)compare->view->width * compare->view->factor;
    double sum = 0.0;
    for (int32_t j = 0; j < side; j++)
        for (int32_t i = 0; i < side; i++) {
            const pixel_sample_t *sample = &first[j * stride + i];
            if (sample->x == PIXEL_VIEW_NO_WALL) {
                sum = (double)NAN;
                continue;
            }
            const double off = difference(compare, sample, truth);
            add_error(fine, off);
            sum += off;
        }
    return sum / (side * side);
}

/* In place; the two values at each end have no neighbours and become NaN. */
static void smooth(double *line, int32_t count, ptrdiff_t stride)
{
    double window[5] = {(double)NAN, (double)NAN, (double)NAN, line[0], count > 1 ? line[stride] : (double)NAN};
    for (int32_t n = 0; n < count; n++) {
        for (int i = 0; i < 4; i++)
            window[i] = window[i + 1];
        window[4] = n + 2 < count ? line[(n + 2) * stride] : (double)NAN;
        line[n * stride] = (window[0] + window[4] + 4.0 * (window[1] + window[3]) + 6.0 * window[2]) / 16.0;
    }
}

static error_t compare_as_eye(const compare_t *compare, error_t *fine)
{
    const pixel_view_t *view = compare->view;
    const int32_t width = 2 * view->width, height = 2 * view->height, side = view->factor / 2;
    for (int32_t y = 0; y < height; y++)
        for (int32_t x = 0; x < width; x++) {
            const ptrdiff_t first = ((ptrdiff_t)y * side * width + x) * side;
            const double truth = image_row(compare->truth, y / 2)[x / 2];
            view->field[(ptrdiff_t)y * width + x] = half_pixel(compare, &view->sample[first], truth, fine);
        }
    for (int32_t y = 0; y < height; y++)
        smooth(view->field + (ptrdiff_t)y * width, width, 1);
    for (int32_t x = 0; x < width; x++)
        smooth(view->field + x, height, width);
    error_t eye = {0.0, 0};
    for (ptrdiff_t n = 0; n < (ptrdiff_t)width * height; n++)
        if (!isnan(view->field[n]))
            add_error(&eye, view->field[n]);
    return eye;
}

pixel_psnr_t pixel_view_psnr(const pixel_view_t *view, const image_t *panel, const image_t *truth)
{
    error_t fine = {0.0, 0}, fine_uneven = {0.0, 0};
    const error_t eye = compare_as_eye(&(compare_t){view, panel, truth, false}, &fine);
    const error_t uneven = compare_as_eye(&(compare_t){view, panel, truth, true}, &fine_uneven);
    return (pixel_psnr_t){.fine = mesh_db(fine.square, fine.count),
                          .eye = mesh_db(eye.square, eye.count),
                          .uneven = mesh_db(uneven.square, uneven.count)};
}
