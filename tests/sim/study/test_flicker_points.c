// SPDX-License-Identifier: Apache-2.0
// Which methods are both sharper and steadier than the adaptive family, and the labels of its plots.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "sim/study/flicker_labels.h"
#include "tests/support/rng.h"

static const flicker_case_t ordinary = {
    "a", 4, {{"none+cubic", 0.7, 3.0}, {"area", 0.5, 2.0}, {"mean+cubic", 0.6, 2.5}, {"gauss+cubic", 0.4, 1.0}}};

static void family_is_known_by_name(void **state)
{
    (void)state;
    assert_true(flicker_in_family("area"));
    assert_true(flicker_in_family("mean+cubic"));
    assert_true(flicker_in_family("mean+spline"));
    assert_false(flicker_in_family("none+nearest"));
    assert_false(flicker_in_family("ls"));
}

static void beating_needs_both(void **state)
{
    (void)state;
    const flicker_point_t it = {"a", 0.5, 2.0};
    const flicker_point_t better = {"b", 0.51, 1.9}, sharper = {"b", 0.51, 2.1}, steadier = {"b", 0.49, 1.9};
    const flicker_point_t rounding = {"b", 0.5 + flicker_least_sharper / 2, 2.0 - flicker_least_steadier / 2};
    assert_true(flicker_beats(&better, &it));
    assert_false(flicker_beats(&it, &better));
    assert_false(flicker_beats(&sharper, &it));
    assert_false(flicker_beats(&steadier, &it));
    assert_false(flicker_beats(&rounding, &it));
    assert_false(flicker_beats(&it, &it));
}

static void nobody_beats_an_ordinary_family(void **state)
{
    (void)state;
    const flicker_defeats_t defeats = flicker_defeats(&ordinary, 1, NULL);
    assert_int_equal(defeats.pairs, 2); /* the outsiders */
    assert_int_equal(defeats.defeats, 0);
    assert_null(defeats.worst);
}

static void beating_one_member_is_not_beating_the_family(void **state)
{
    (void)state;
    flicker_case_t of = ordinary;
    of.point[0] = (flicker_point_t){"none+cubic", 0.55, 1.5}; /* beats area, not mean+cubic: that is sharper */
    const flicker_defeats_t family = flicker_defeats(&of, 1, NULL), area = flicker_defeats(&of, 1, "area");
    const flicker_defeats_t cubic = flicker_defeats(&of, 1, "mean+cubic");
    assert_int_equal(family.defeats, 0);
    assert_int_equal(area.defeats, 1);
    assert_int_equal(cubic.defeats, 0);
    assert_ptr_equal(area.worst, &of);
    assert_string_equal(area.victor->name, "none+cubic");
    assert_string_equal(area.victim->name, "area");
    of.point[0] = (flicker_point_t){"none+cubic", 0.65, 2.2}; /* beats mean+cubic, not area: that is steadier */
    assert_int_equal(flicker_defeats(&of, 1, NULL).defeats, 0);
    assert_int_equal(flicker_defeats(&of, 1, "mean+cubic").defeats, 1);
}

static void worst_defeat_is_found_among_cases(void **state)
{
    (void)state;
    flicker_case_t of[3] = {ordinary, ordinary, ordinary};
    of[1].point[0] = (flicker_point_t){"none+cubic", 0.9, 1.8};
    of[2].point[3] = (flicker_point_t){"gauss+cubic", 0.9, 0.5};
    const flicker_defeats_t defeats = flicker_defeats(of, 3, NULL);
    assert_int_equal(defeats.pairs, 6);
    assert_int_equal(defeats.defeats, 2);
    assert_ptr_equal(defeats.worst, &of[2]);
    assert_string_equal(defeats.victor->name, "gauss+cubic");
    assert_string_equal(defeats.victim->name, "area"); /* the steadiest */
}

static void members_do_not_beat_each_other(void **state)
{
    (void)state;
    flicker_case_t of = ordinary;
    of.point[2] = (flicker_point_t){"mean+cubic", 0.9, 0.1};
    assert_int_equal(flicker_defeats(&of, 1, "area").defeats, 0);
}

static void missing_member_has_no_pairs(void **state)
{
    (void)state;
    assert_int_equal(flicker_defeats(&ordinary, 1, "mean+spline").pairs, 0);
}

typedef struct {
    double x, y, half_width;
} label_t;

/* The labels in gnuplot's commands, in pixels. */
static int read_labels(const char *setup, label_t label[WARP_METHODS])
{
    int count = 0;
    for (const char *at = strstr(setup, "set label '"); at != NULL; at = strstr(at + 1, "set label '")) {
        char name[80];
        double x, y;
        assert_int_equal(sscanf(at, "set label '%79[^']' noenhanced at graph %lf,%lf", name, &x, &y), 3);
        assert_true(count < WARP_METHODS);
        label[count++] = (label_t){x * 588, y * 368, 3.0 * (double)strlen(name)};
    }
    return count;
}

static void labels_do_not_overlap(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        rng_t rng = {seed};
        flicker_case_t of = {.points = WARP_METHODS};
        for (int n = 0; n < of.points; n++)
            of.point[n] = (flicker_point_t){warp_methods[n].name, rng_double(&rng, 0.3, 0.7), rng_double(&rng, 1, 5)};
        const flicker_axes_t axes = flicker_axes(&of);
        char setup[FLICKER_SETUP_LENGTH];
        flicker_labels(setup, &axes, &of);
        label_t label[WARP_METHODS];
        const int count = read_labels(setup, label);
        for (int a = 0; a < count; a++)
            for (int b = 0; b < a; b++) {
                const double dx = label[a].x - label[b].x, dy = label[a].y - label[b].y;
                const double reach = label[a].half_width + label[b].half_width;
                if (dx < reach && dx > -reach && dy < 12.0 && dy > -12.0)
                    fail_msg("seed %d: labels %d and %d overlap", (int)seed, a, b);
            }
    }
}

static void points_in_one_place_share_a_label(void **state)
{
    (void)state;
    flicker_case_t of = ordinary;
    of.point[0] = of.point[2];
    of.point[0].name = "none+cubic";
    const flicker_axes_t axes = flicker_axes(&of);
    char setup[FLICKER_SETUP_LENGTH];
    flicker_labels(setup, &axes, &of);
    assert_non_null(strstr(setup, "'mean+cubic and 1 more'"));
    assert_null(strstr(setup, "none+cubic"));
    assert_non_null(strstr(setup, "'gauss+cubic'"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(family_is_known_by_name),
        cmocka_unit_test(beating_needs_both),
        cmocka_unit_test(nobody_beats_an_ordinary_family),
        cmocka_unit_test(beating_one_member_is_not_beating_the_family),
        cmocka_unit_test(worst_defeat_is_found_among_cases),
        cmocka_unit_test(members_do_not_beat_each_other),
        cmocka_unit_test(missing_member_has_no_pairs),
        cmocka_unit_test(labels_do_not_overlap),
        cmocka_unit_test(points_in_one_place_share_a_label),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
