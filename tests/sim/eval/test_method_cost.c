// SPDX-License-Identifier: Apache-2.0
// The model of cost against sums done by hand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "sim/eval/method_cost.h"
#include "warp_fixed/method.h"

static void costs_are_what_the_header_says(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double near, far; /* k 0.8, side 0.5, as many pixels; k 2, side sqrt(5), two picture pixels per panel pixel */
    } expected[] = {
        {"none+nearest", 1, 1},
        {"none+linear", 4, 4},
        {"none+cubic", 16, 16},
        {"none+spline", 16 + 4, 16 + 8},
        {"gauss+nearest", 1, 1 + 2 * 2 * 7},   /* ceil(4 * 2 * 0.265) = 3 */
        {"kaiser+linear", 4, 4 + 2 * 2 * 25},  /* 12 */
        {"butter+cubic", 16, 16 + 2 * 2 * 33}, /* 16 */
        {"gauss+spline", 20, 16 + 8 + 2 * 2 * 7},
        {"area", 2.25, (2.2360680 + 1) * (2.2360680 + 1)},
        {"mean+cubic", 16, 36},
        {"mean+spline", 20, 36 + 8},
        {"ls", 16 + 2 * 20, 16 + 2 * 2 * 18},
    };
    const method_cost_place_t near = {0.8, 0.5, 1.0}, far = {2.0, sqrt(5.0), 2.0};
    for (size_t e = 0; e < sizeof expected / sizeof *expected; e++) {
        const double got_near = method_cost(expected[e].name, &near), got_far = method_cost(expected[e].name, &far);
        if (!(fabs(got_near - expected[e].near) < 1e-6 && fabs(got_far - expected[e].far) < 1e-6))
            fail_msg("%s costs %f and %f, expected %f and %f", expected[e].name, got_near, got_far, expected[e].near,
                     expected[e].far);
    }
}

static void other_names_have_no_cost(void **state)
{
    (void)state;
    static const char *const names[] = {"", "auto", "none", "none+", "+cubic", "non+cubic", "none+cubi", "mean+linear"};
    const method_cost_place_t place = {2.0, 2.0, 1.0};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        if (!isnan(method_cost(names[n], &place)))
            fail_msg("'%s' has a cost", names[n]);
}

static void every_method_but_auto_has_a_cost(void **state)
{
    (void)state;
    const method_cost_place_t place = {2.0, 2.0, 1.0};
    for (int m = 0; m < WARP_METHODS; m++)
        if (strcmp(warp_methods[m].name, "auto") != 0 && !(method_cost(warp_methods[m].name, &place) >= 1.0))
            fail_msg("%s has no cost", warp_methods[m].name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(costs_are_what_the_header_says),
        cmocka_unit_test(other_names_have_no_cost),
        cmocka_unit_test(every_method_but_auto_has_a_cost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
