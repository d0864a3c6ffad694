// SPDX-License-Identifier: Apache-2.0
// Rectangularity of known figures, and quadrilaterals found in drawn pictures.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/study/rectangle.h"
#include "tests/support/rng.h"

enum { SIDE = 200, SAMPLES = 16, ROUNDS = 60 };

static const double pi = 3.14159265358979323846;

static rectangle_point_t turned(double x, double y, double angle)
{
    return (rectangle_point_t){x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)};
}

static void hull_has_no_inner_points(void **state)
{
    (void)state;
    rectangle_point_t points[] = {{1, 1}, {0, 0}, {2, 0}, {1, 0}, {2, 2}, {0.5, 1.5}, {0, 2}, {0, 1}, {2, 2}},
                      spare[18];
    assert_int_equal(rectangle_hull(points, spare, 9), 4);
    for (int n = 0; n < 4; n++)
        assert_true((points[n].x == 0 || points[n].x == 2) && (points[n].y == 0 || points[n].y == 2));
    assert_true(rectangle_bounds_area(points, 4) == 4.0);
    rectangle_point_t line[] = {{3, 4}, {1, 2}, {2, 3}};
    assert_int_equal(rectangle_hull(line, spare, 3), 2);
}

static void shape_is(const rectangle_point_t corner[4], double mean_deg, double worst_deg, double rectangularity)
{
    for (int turn = 0; turn < 36; turn++) {
        rectangle_point_t moved[4];
        for (int n = 0; n < 4; n++)
            moved[(n + turn) % 4] = turned(corner[n].x, corner[n].y, turn * pi / 18.0 + 0.01);
        const rectangle_shape_t shape = rectangle_shape(moved);
        assert_true(fabs(shape.mean_deg - mean_deg) < 1e-5);
        assert_true(fabs(shape.worst_deg - worst_deg) < 1e-5);
        assert_true(fabs(shape.rectangularity - rectangularity) < 1e-6);
    }
}

static void known_figures_in_every_direction(void **state)
{
    (void)state;
    const double slope_deg = atan(0.5) * 180.0 / pi;
    shape_is((rectangle_point_t[]){{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.0, 0.0, 1.0);
    shape_is((rectangle_point_t[]){{0, 0}, {5, 0}, {5, 1}, {0, 1}}, 0.0, 0.0, 1.0);
    /* a trapezoid: its best rectangle stands on its base */
    shape_is((rectangle_point_t[]){{0, 0}, {4, 0}, {3, 2}, {1, 2}}, slope_deg, slope_deg, 0.75);
    /* two right angles and two that are off */
    shape_is((rectangle_point_t[]){{0, 0}, {2, 0}, {2, 2}, {0, 1}}, slope_deg / 2.0, slope_deg, 0.75);
    /* a rhombus, the other way round */
    shape_is((rectangle_point_t[]){{0, 0}, {0, 5}, {3, 9}, {3, 4}}, atan(4.0 / 3.0) * 180.0 / pi,
             atan(4.0 / 3.0) * 180.0 / pi, 15.0 / 27.0);
}

static bool inside(const rectangle_point_t corner[4], double x, double y)
{
    for (int n = 0; n < 4; n++) {
        const rectangle_point_t from = corner[n], to = corner[(n + 1) % 4];
        if ((to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x) < 0.0)
            return false;
    }
    return true;
}

/* Each pixel the share of it that the quadrilateral covers. */
static void draw(uint8_t *pixels, const rectangle_point_t corner[4])
{
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            int hits = 0;
            for (int s = 0; s < SAMPLES * SAMPLES; s++)
                hits += inside(corner, x + (s % SAMPLES + 0.5) / SAMPLES, y + (s / SAMPLES + 0.5) / SAMPLES) ? 1 : 0;
            pixels[y * SIDE + x] = (uint8_t)(hits * 255 / (SAMPLES * SAMPLES));
        }
}

static image_t image_of(uint8_t *pixels)
{
    return (image_t){.data = pixels, .width = SIDE, .height = SIDE, .stride = SIDE, .format = IMAGE_GRAY8};
}

static double nearest(const rectangle_point_t corner[4], rectangle_point_t point)
{
    double least = HUGE_VAL;
    for (int n = 0; n < 4; n++)
        least = fmin(least, hypot(corner[n].x - point.x, corner[n].y - point.y));
    return least;
}

/* Squares and other convex quadrilaterals, turned at random. */
static void drawn_quadrilaterals_are_found(void **state)
{
    (void)state;
    uint8_t *pixels = malloc(SIDE * SIDE);
    const image_t image = image_of(pixels);
    double worst = 0.0, worst_deg = 0.0;
    for (uint64_t seed = 1; seed <= ROUNDS; seed++) {
        rng_t rng = {seed};
        const double angle = rng_double(&rng, 0.0, 2.0 * pi), half = rng_double(&rng, 25.0, 60.0);
        const double bend = seed % 2 == 0 ? 0.0 : rng_double(&rng, 5.0, 12.0);
        rectangle_point_t corner[4], found[4];
        for (int n = 0; n < 4; n++) {
            const double x = n == 1 || n == 2 ? half : -half, y = n >= 2 ? half : -half;
            corner[n] = turned(x + rng_double(&rng, -bend, bend), y + rng_double(&rng, -bend, bend), angle);
            corner[n].x += SIDE / 2.0 + rng_double(&rng, -0.5, 0.5) * (bend > 0.0);
            corner[n].y += SIDE / 2.0;
        }
        draw(pixels, corner);
        const bool done = rectangle_find(&image, found);
        if (!done)
            print_error("seed %d: not found\n", (int)seed);
        assert_true(done);
        for (int n = 0; n < 4; n++) {
            worst = fmax(worst, nearest(found, corner[n]));
            assert_true(found[0].x + found[0].y <= found[n].x + found[n].y);
        }
        worst_deg = fmax(worst_deg, fabs(rectangle_shape(found).mean_deg - rectangle_shape(corner).mean_deg));
        if (worst > 0.15 || worst_deg > 0.15)
            print_error("seed %d: %.4f px, %.4f degrees\n", (int)seed, worst, worst_deg);
        assert_true(worst <= 0.15 && worst_deg <= 0.15);
    }
    print_message("corners within %.4f px, angles within %.4f degrees\n", worst, worst_deg);
    free(pixels);
}

static void refuses(const image_t *image, const char *what)
{
    rectangle_point_t corner[4] = {{7, 7}, {7, 7}, {7, 7}, {7, 7}};
    const bool found = rectangle_find(image, corner);
    if (found)
        print_error("%s: found\n", what);
    assert_false(found);
    for (int n = 0; n < 4; n++)
        assert_true(corner[n].x == 7.0 && corner[n].y == 7.0);
}

static void other_pictures_are_refused(void **state)
{
    (void)state;
    uint8_t *pixels = malloc(SIDE * SIDE);
    const image_t image = image_of(pixels);
    memset(pixels, 0, SIDE * SIDE);
    refuses(&image, "black");
    memset(pixels, 255, SIDE * SIDE);
    refuses(&image, "white");
    for (int n = 0; n < SIDE * SIDE; n++)
        pixels[n] = (n / SIDE + n % SIDE) % 2 == 0 ? 0 : 255;
    refuses(&image, "checkerboard");
    for (int n = 0; n < SIDE * SIDE; n++)
        pixels[n] = hypot(n % SIDE - 100, n / SIDE - 100) < 70 ? 255 : 0;
    refuses(&image, "disc");
    draw(pixels, (rectangle_point_t[]){{20, 20}, {180, 30}, {90, 170}, {90, 170}});
    refuses(&image, "triangle");
    memset(pixels, 0, SIDE * SIDE);
    pixels[SIDE * 50 + 50] = 255;
    refuses(&image, "one pixel");
    free(pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hull_has_no_inner_points),
        cmocka_unit_test(known_figures_in_every_direction),
        cmocka_unit_test(drawn_quadrilaterals_are_found),
        cmocka_unit_test(other_pictures_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
