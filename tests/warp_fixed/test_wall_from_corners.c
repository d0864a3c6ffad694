// SPDX-License-Identifier: Apache-2.0
// Walls from corner markers: the map against the float oracle, residuals, and every kind of bad corners.
#include "warp_fixed/wall_from_corners.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "tests/support/oracle.h"
#include "warp_fixed/image.h"

static long double value_of(real_t a)
{
    return ldexpl((long double)a.mantissa, a.exponent);
}

/* World position of a panel point, micrometres. */
static void map_point(long double um[3], const wall_t *wall, long double u, long double v)
{
    const long double weight =
        value_of(wall->weight[0]) * u + value_of(wall->weight[1]) * v + value_of(wall->weight[2]);
    for (int k = 0; k < 3; k++)
        um[k] =
            wall->origin_um[k] +
            (value_of(wall->point[k][0]) * u + value_of(wall->point[k][1]) * v + value_of(wall->point[k][2])) / weight;
}

static wall_corners_t plain_wall(void)
{
    return (wall_corners_t){
        .panel_width = 1920,
        .panel_height = 1080,
        .corner_um = {{-2000000, -1125000, 0}, {2000000, -1125000, 0}, {2000000, 1125000, 0}, {-2000000, 1125000, 0}},
        .corner_known = {true, true, true, true}};
}

static void corners_map_to_markers(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        rng_t rng = {seed};
        oracle_case_t c;
        oracle_wall_t exact;
        wall_t wall;
        oracle_random_case(&c, &rng);
        oracle_wall(&exact, &c.corners);
        assert_int_equal(wall_from_corners(&wall, &c.corners), WALL_OK);
        assert_in_range(wall.worst_um, 0, 3); /* coplanar but for rounding to micrometres */
        for (int n = 0; n < 20; n++) {
            const long double u = (long double)rng_double(&rng, 0, c.corners.panel_width);
            const long double v = (long double)rng_double(&rng, 0, c.corners.panel_height);
            const long double weight = exact.weight[0] * u + exact.weight[1] * v + exact.weight[2];
            long double um[3];
            map_point(um, &wall, u, v);
            for (int k = 0; k < 3; k++) {
                const long double expected =
                    (exact.point[k][0] * u + exact.point[k][1] * v + exact.point[k][2]) / weight * 1e6L;
                if (fabsl(um[k] - expected) > 1e-4L)
                    fail_msg("seed %lu at (%Lf, %Lf): %.6Lf um, expected %.6Lf", (unsigned long)seed, u, v, um[k],
                             expected);
            }
        }
    }
}

static void three_corners_complete_the_rectangle(void **state)
{
    (void)state;
    for (int unknown = 0; unknown < 4; unknown++) {
        wall_corners_t measured = plain_wall();
        measured.corner_known[unknown] = false;
        memset(measured.corner_um[unknown], 0x55, sizeof(measured.corner_um[unknown])); /* must not be read */
        wall_t wall;
        assert_int_equal(wall_from_corners(&wall, &measured), WALL_OK);
        const wall_corners_t whole = plain_wall();
        for (int c = 0; c < 4; c++) {
            long double um[3];
            map_point(um, &wall, c == 1 || c == 2 ? 1920 : 0, c >= 2 ? 1080 : 0);
            for (int k = 0; k < 3; k++)
                assert_true(fabsl(um[k] - whole.corner_um[c][k]) < 1e-6L);
        }
        assert_int_equal(wall.skew_mdeg, 0);
    }
}

static void residuals_are_measured(void **state)
{
    (void)state;
    wall_corners_t measured = plain_wall();
    measured.corner_um[0][2] = 4000; /* one corner 4 mm off: the plane takes 3/4 of it, each is 1 mm off */
    wall_t wall;
    assert_int_equal(wall_from_corners(&wall, &measured), WALL_OK);
    assert_in_range(wall.rms_um, 999, 1001);
    assert_in_range(wall.worst_um, 999, 1001);

    measured = plain_wall();
    measured.marker_count = 1;
    measured.marker[0] = (wall_marker_t){{960 << 16, 540 << 16}, {3000, 0, 0}};
    assert_int_equal(wall_from_corners(&wall, &measured), WALL_OK);
    assert_int_equal(wall.worst_um, 0);
    assert_int_equal(wall.marker_um, 3000);
}

static void skew_is_the_corner_angles(void **state)
{
    (void)state;
    wall_corners_t measured = plain_wall();
    measured.corner_known[2] = false;
    measured.corner_um[1][1] += 69815; /* 4 m wide: tan(1 degree) */
    wall_t wall;
    assert_int_equal(wall_from_corners(&wall, &measured), WALL_OK);
    assert_in_range(wall.skew_mdeg, 995, 1005);
}

static void bad_corners_are_refused(void **state)
{
    (void)state;
    wall_t wall, untouched;
    memset(&wall, 0x5a, sizeof(wall));
    untouched = wall;

    wall_corners_t m = plain_wall();
    m.corner_known[0] = m.corner_known[3] = false;
    assert_int_equal(wall_from_corners(&wall, &m), WALL_TOO_FEW_CORNERS);

    m = plain_wall();
    m.corner_known[3] = false;
    for (int k = 0; k < 3; k++)
        m.corner_um[2][k] = 2 * m.corner_um[1][k] - m.corner_um[0][k];
    assert_int_equal(wall_from_corners(&wall, &m), WALL_ON_A_LINE);

    m = plain_wall();
    memset(m.corner_um, 0, sizeof(m.corner_um));
    assert_int_equal(wall_from_corners(&wall, &m), WALL_ON_A_LINE);

    m = plain_wall(); /* top-left, bottom-right, top-right, bottom-left */
    memcpy(m.corner_um[1], plain_wall().corner_um[2], sizeof(m.corner_um[1]));
    memcpy(m.corner_um[2], plain_wall().corner_um[1], sizeof(m.corner_um[2]));
    assert_int_equal(wall_from_corners(&wall, &m), WALL_CROSSED);

    m = plain_wall(); /* a corner inside the triangle of the others */
    m.corner_um[2][0] = -1000000;
    m.corner_um[2][1] = -500000;
    assert_int_equal(wall_from_corners(&wall, &m), WALL_CROSSED);

    m = plain_wall();
    m.panel_width = 0;
    assert_int_equal(wall_from_corners(&wall, &m), WALL_BAD_SIZE);
    m = plain_wall();
    m.panel_height = IMAGE_MAX_HEIGHT + 1;
    assert_int_equal(wall_from_corners(&wall, &m), WALL_BAD_SIZE);
    m = plain_wall();
    m.marker_count = WALL_MAX_MARKERS + 1;
    assert_int_equal(wall_from_corners(&wall, &m), WALL_BAD_SIZE);
    assert_memory_equal(&wall, &untouched, sizeof(wall));
    for (int s = WALL_OK; s <= WALL_BAD_SIZE; s++)
        assert_true(strlen(wall_status_text((wall_status_t)s)) > 10);
}

/* Corners far from the origin, huge and tiny walls: nothing overflows. */
static void extremes_do_not_overflow(void **state)
{
    (void)state;
    const int32_t far = 1 << 30;
    wall_corners_t m = plain_wall();
    const int32_t huge[4][3] = {{-far, -far, far}, {far, -far, far}, {far, far, far}, {-far, far, far}};
    wall_t wall;
    memcpy(m.corner_um, huge, sizeof(huge));
    assert_int_equal(wall_from_corners(&wall, &m), WALL_OK);
    const int32_t tiny[4][3] = {{far, far, far}, {far - 10, far, far}, {far - 10, far - 10, far}, {far, far - 10, far}};
    memcpy(m.corner_um, tiny, sizeof(tiny));
    assert_int_equal(wall_from_corners(&wall, &m), WALL_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_map_to_markers),  cmocka_unit_test(three_corners_complete_the_rectangle),
        cmocka_unit_test(residuals_are_measured),  cmocka_unit_test(skew_is_the_corner_angles),
        cmocka_unit_test(bad_corners_are_refused), cmocka_unit_test(extremes_do_not_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
