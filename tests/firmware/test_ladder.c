// SPDX-License-Identifier: Apache-2.0
// Tests of the ladders of methods: which stand in for which, that each is cheaper, and that the costs are those
// counted.
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/ladder.h"
#include "warp_fixed/warp.h"

static const int32_t FULL_HD = 1920 * 1080;

static void assert_ladder(const char *expected)
{
    char names[200] = "", first[32];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(expected, " "), expected);
    const ladder_t ladder = ladder_of(warp_method_from_name(first));
    for (int32_t step = 0; step < ladder.steps; step++) {
        strcat(names, step > 0 ? " " : "");
        strcat(names, ladder.method[step]->name);
    }
    assert_string_equal(names, expected);
}

static void test_what_stands_in_for_what(void **state)
{
    (void)state;
    assert_ladder("mean+spline mean+cubic area none+linear none+nearest");
    assert_ladder("auto mean+cubic area none+linear none+nearest");
    assert_ladder("ls mean+cubic area none+linear none+nearest");
    assert_ladder("mean+cubic area none+linear none+nearest");
    assert_ladder("area none+linear none+nearest");
    assert_ladder("kaiser+spline area none+linear none+nearest");
    assert_ladder("gauss+nearest none+linear none+nearest");
    assert_ladder("none+spline none+cubic none+linear none+nearest");
    assert_ladder("none+cubic none+linear none+nearest");
    assert_ladder("none+linear none+nearest");
    assert_ladder("none+nearest");
}

/* gauss+nearest alone is cheaper than what stands in for it, as long as k is small. */
static void test_each_step_is_cheaper(void **state)
{
    (void)state;
    for (int i = 0; i < WARP_METHODS; i++) {
        const ladder_t ladder = ladder_of(&warp_methods[i]);
        for (int32_t k_q16 = 65536; k_q16 < 4 << 16; k_q16 += 16384) {
            const ladder_frame_t frame = {FULL_HD, FULL_HD, k_q16};
            const bool narrow = warp_methods[i].filter != WARP_FILTER_NONE && k_q16 < 3 << 16;
            for (int32_t step = narrow ? 2 : 1; step < ladder.steps; step++) {
                const uint32_t cost = ladder_cost(ladder.method[step], &frame);
                const uint32_t above = ladder_cost(ladder.method[step - 1], &frame);
                const bool same = warp_methods[i].resampler == WARP_AUTO && step == 1;
                if (same ? cost > above : cost >= above)
                    fail_msg("%s, k %d / 65536: step %d costs %u, the one above %u", warp_methods[i].name, k_q16, step,
                             cost, above);
            }
        }
    }
}

static void test_costs_fit_at_the_largest_sizes(void **state)
{
    (void)state;
    const int32_t most = IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT;
    for (int i = 0; i < WARP_METHODS; i++) {
        assert_in_range(ladder_cost(&warp_methods[i], &(ladder_frame_t){most, most, INT32_MAX}), 1, 1U << 28);
        assert_in_range(ladder_cost(&warp_methods[i], &(ladder_frame_t){0, 1, 0}), 1, 1);
    }
}

/* Else the firmware leaves the step out. */
static void test_steps_are_asked_for_where_they_cost(void **state)
{
    (void)state;
    for (int i = 0; i < WARP_METHODS; i++) {
        const ladder_t ladder = ladder_of(&warp_methods[i]);
        bool differs = false;
        for (int32_t step = 0; step < ladder.steps; step++)
            differs |= ladder_cost(ladder.method[step], &(ladder_frame_t){FULL_HD, FULL_HD, 0}) !=
                       ladder_cost(ladder.method[step], &(ladder_frame_t){FULL_HD, FULL_HD, 3 << 16});
        if (ladder_needs_step(&ladder) != differs)
            fail_msg("%s: a step that %s is %sasked for", warp_methods[i].name, differs ? "costs" : "costs nothing",
                     differs ? "not " : "");
    }
}

static void test_a_warp_is_ready_for_every_ladder(void **state)
{
    (void)state;
    static warp_t warp;
    static const uint8_t border[3] = {0, 0, 0};
    for (int i = 0; i < WARP_METHODS; i++) {
        const ladder_t ladder = ladder_of(&warp_methods[i]);
        warp_init(&warp, warp_methods[i], false, border);
        for (int32_t step = 1; step < ladder.steps; step++)
            if (!warp_add_method(&warp, *ladder.method[step]))
                fail_msg("%s: no room for %s", warp_methods[i].name, ladder.method[step]->name);
    }
}

/* Instructions per panel pixel of a case in the baseline, XRGB. */
static double counted(const char *name, const char *pose)
{
    char line[128], wanted[64];
    double instructions = -1;
    FILE *file = fopen("tests/bench/baseline.csv", "r");
    assert_non_null(file);
    snprintf(wanted, sizeof wanted, "%s,xrgb,%s,", name, pose);
    while (fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, wanted, strlen(wanted)) == 0)
            instructions = strtod(line + strlen(wanted), NULL);
    fclose(file);
    if (instructions < 0)
        fail_msg("tests/bench/baseline.csv has no line %s", wanted);
    return instructions;
}

/* Instructions per lit pixel: case and grid, the mean of both poses. */
static double counted_per_lit(const char *name)
{
    return (counted(name, "strong") + counted("grid", "strong")) / 0.493 / 2 +
           (counted(name, "mild") + counted("grid", "mild")) / 0.878 / 2;
}

static double model_per_lit(const char *method)
{
    return ladder_cost(warp_method_from_name(method), &(ladder_frame_t){1000000, 0, 65536}) / 1000.0;
}

static void test_costs_are_those_counted(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"nearest", "none+nearest"},   {"linear", "none+linear"}, {"cubic", "none+cubic"},
        {"spline", "none+spline"},     {"area", "area"},          {"mean+cubic", "mean+cubic"},
        {"mean+spline", "mean+spline"}};
    enum { CASES = sizeof cases / sizeof *cases };
    bool same = true;
    for (int i = 0; i < CASES; i++) {
        const double baseline = counted_per_lit(cases[i][0]) / counted_per_lit("mean+cubic");
        const double model = model_per_lit(cases[i][1]) / model_per_lit("mean+cubic");
        same = same && model < 1.3 * baseline && baseline < 1.3 * model;
    }
    for (int i = 0; i < CASES && !same; i++)
        printf("%s: %.1f instructions per lit pixel in baseline.csv, %.1f in firmware/ladder.c\n", cases[i][1],
               counted_per_lit(cases[i][0]), model_per_lit(cases[i][1]));
    if (!same)
        fail_msg("the ratios of firmware/ladder.c are off by more than 1.3: put the new counts into lit_pixel");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_stands_in_for_what),
        cmocka_unit_test(test_each_step_is_cheaper),
        cmocka_unit_test(test_costs_fit_at_the_largest_sizes),
        cmocka_unit_test(test_a_warp_is_ready_for_every_ladder),
        cmocka_unit_test(test_costs_are_those_counted),
        cmocka_unit_test(test_steps_are_asked_for_where_they_cost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
