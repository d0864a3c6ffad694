// SPDX-License-Identifier: Apache-2.0
// A plot whose points all have names: axes around them, and a free place for each name.
#include "sim/study/flicker_labels.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Pixels: of a letter and a line of the label's font, around a point, and from the plot's edge to its axes. */
static const double letter_width = 7.2, line_height = 15.0, point_size = 5.0, same_place = 3.0;
static const double margin_left = 74.0, margin_right = 18.0, margin_top = 14.0, margin_bottom = 58.0;

static void widen(double range[2], double least, double part)
{
    const double by = part * fmax(range[1] - range[0], least);
    range[0] -= by;
    range[1] += by;
}

flicker_axes_t flicker_axes(const flicker_case_t *of)
{
    flicker_axes_t axes = {{HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, -HUGE_VAL}, 680, 440};
    for (int32_t n = 0; n < of->points; n++) {
        axes.sharpness[0] = fmin(axes.sharpness[0], of->point[n].sharpness);
        axes.sharpness[1] = fmax(axes.sharpness[1], of->point[n].sharpness);
        axes.flicker[0] = fmin(axes.flicker[0], of->point[n].flicker);
        axes.flicker[1] = fmax(axes.flicker[1], of->point[n].flicker);
    }
    widen(axes.sharpness, 0.02, 0.15);
    widen(axes.flicker, 0.2, 0.12);
    return axes;
}

/* A rectangle in pixels, y up. */
typedef struct {
    double left, right, bottom, top;
} box_t;

typedef struct {
    char *text;
    size_t used;
    double width, height; /* between the axes, pixels */
    box_t taken[2 * WARP_METHODS];
    int32_t taken_count;
} sheet_t;

__attribute__((format(printf, 2, 3))) static void print(sheet_t *sheet, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(sheet->text + sheet->used, FLICKER_SETUP_LENGTH - sheet->used, format, arguments);
    va_end(arguments);
    if (length > 0 && sheet->used + (size_t)length < FLICKER_SETUP_LENGTH)
        sheet->used += (size_t)length;
    sheet->text[sheet->used] = '\0';
}

static void take(sheet_t *sheet, box_t box)
{
    sheet->taken[sheet->taken_count++] = box;
}

static bool is_free(const sheet_t *sheet, box_t box)
{
    if (box.left < 0.0 || box.right > sheet->width || box.bottom < 0.0 || box.top > sheet->height)
        return false;
    for (int32_t n = 0; n < sheet->taken_count; n++) {
        const box_t *other = &sheet->taken[n];
        if (box.left < other->right && box.right > other->left && box.bottom < other->top && box.top > other->bottom)
            return false;
    }
    return true;
}

/* A free place for a label: rings of growing radius around the point, right of it first. */
static box_t place(const sheet_t *sheet, double x, double y, double width)
{
    enum { RINGS = 24, DIRECTIONS = 16 };
    static const double ring_step = 9.0;
    for (int ring = 0; ring < RINGS; ring++)
        for (int d = 0; d < DIRECTIONS; d++) {
            /* right, then left of it, and so on round to straight above and below */
            const double turn = M_PI * ((d + 1) / 2) / (DIRECTIONS / 2.0) * (d % 2 == 0 ? 1.0 : -1.0);
            const double radius = 2.0 * point_size + ring * ring_step;
            const double cx = x + cos(turn) * (radius + width / 2), cy = y + sin(turn) * (radius + line_height / 2);
            const box_t box = {cx - width / 2, cx + width / 2, cy - line_height / 2, cy + line_height / 2};
            if (is_free(sheet, box))
                return box;
        }
    return (box_t){x, x + width, y, y + line_height};
}

static void print_label(sheet_t *sheet, const char *name, int32_t more, double x, double y)
{
    const char *colour = flicker_in_family(name) ? "#7fdca0" : "#c6d0de";
    char text[80];
    if (more > 0)
        snprintf(text, sizeof text, "%s and %d more", name, more);
    else
        snprintf(text, sizeof text, "%s", name);
    const box_t box = place(sheet, x, y, letter_width * (double)strlen(text));
    take(sheet, box);
    const double to_x = fmin(fmax(x, box.left), box.right), to_y = fmin(fmax(y, box.bottom), box.top);
    if (hypot(to_x - x, to_y - y) > 3.0 * point_size)
        print(sheet, "set arrow from graph %.4f,%.4f to graph %.4f,%.4f nohead back lc rgb '#46536a'\n",
              x / sheet->width, y / sheet->height, to_x / sheet->width, to_y / sheet->height);
    print(sheet, "set label '%s' noenhanced at graph %.4f,%.4f center tc rgb '%s' font ',13'\n", text,
          (box.left + box.right) / 2 / sheet->width, (box.bottom + box.top) / 2 / sheet->height, colour);
}

void flicker_labels(char setup[FLICKER_SETUP_LENGTH], const flicker_axes_t *axes, const flicker_case_t *of)
{
    sheet_t sheet = {.text = setup,
                     .width = axes->width - margin_left - margin_right,
                     .height = axes->height - margin_top - margin_bottom};
    double x[WARP_METHODS], y[WARP_METHODS];
    for (int32_t n = 0; n < of->points; n++) {
        const flicker_point_t *point = &of->point[n];
        x[n] = (point->sharpness - axes->sharpness[0]) / (axes->sharpness[1] - axes->sharpness[0]) * sheet.width;
        y[n] = (point->flicker - axes->flicker[0]) / (axes->flicker[1] - axes->flicker[0]) * sheet.height;
        take(&sheet, (box_t){x[n] - point_size, x[n] + point_size, y[n] - point_size, y[n] + point_size});
    }
    print(&sheet,
          "set lmargin at screen %.4f\nset rmargin at screen %.4f\nset tmargin at screen %.4f\n"
          "set bmargin at screen %.4f\nset xrange [%.6f:%.6f]\nset yrange [%.6f:%.6f]\n",
          margin_left / axes->width, 1.0 - margin_right / axes->width, 1.0 - margin_top / axes->height,
          margin_bottom / axes->height, axes->sharpness[0], axes->sharpness[1], axes->flicker[0], axes->flicker[1]);
    bool named[WARP_METHODS] = {false};
    for (int pass = 0; pass < 2; pass++)
        for (int32_t n = 0; n < of->points; n++) {
            if (named[n] || flicker_in_family(of->point[n].name) != (pass == 0))
                continue;
            int32_t together = 0;
            for (int32_t k = 0; k < of->points; k++)
                if (!named[k] && hypot(x[k] - x[n], y[k] - y[n]) < same_place) {
                    named[k] = true;
                    together++;
                }
            print_label(&sheet, of->point[n].name, together - 1, x[n], y[n]);
        }
}
