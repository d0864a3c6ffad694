// SPDX-License-Identifier: Apache-2.0
// What wallwarp-eval advise prints, for advice made by hand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "sim/eval/advice_print.h"

typedef void print_fn(FILE *out, const wall_advice_t *advice);

enum { TEXT_LENGTH = 8192 };

static void print_to(char text[TEXT_LENGTH], print_fn *print, const wall_advice_t *advice)
{
    memset(text, 0, TEXT_LENGTH);
    FILE *out = fmemopen(text, TEXT_LENGTH, "w");
    assert_non_null(out);
    print(out, advice);
    fclose(out);
}

static void assert_says(print_fn *print, const wall_advice_t *advice, const char *expected)
{
    char text[TEXT_LENGTH];
    print_to(text, print, advice);
    if (strstr(text, expected) == NULL)
        fail_msg("expected '%s' in:\n%s", expected, text);
}

static int32_t method_number(const char *name)
{
    const warp_method_t *method = warp_method_from_name(name);
    assert_non_null(method);
    return (int32_t)(method - warp_methods);
}

/* Every method 3 dB below the limit at cost 50, but for those that a test sets. */
static wall_advice_t advice_of(const room_board_t *board)
{
    wall_advice_t advice = {.board = board, .places = 49, .k = {0.5, 1.25, 2.0}};
    for (int m = 0; m < WARP_METHODS; m++) {
        advice.gap_db[m] = 1.0;
        advice.gap_original_db[m] = 3.0;
        advice.cost[m] = 50.0;
    }
    return advice;
}

static void set(wall_advice_t *advice, const char *name, double gap_original_db, double cost)
{
    const int32_t m = method_number(name);
    advice->gap_original_db[m] = gap_original_db;
    advice->cost[m] = cost;
}

static void csv_has_a_row_per_method(void **state)
{
    (void)state;
    const room_board_t board = {.name = "left", .method = warp_method_default()};
    wall_advice_t advice = advice_of(&board);
    set(&advice, "area", 0.25, 5.04);
    char text[TEXT_LENGTH];
    print_to(text, advice_print_csv, &advice);
    int lines = 0;
    for (const char *at = strchr(text, '\n'); at != NULL; at = strchr(at + 1, '\n'))
        lines++;
    assert_int_equal(lines, WARP_METHODS);
    assert_says(advice_print_csv, &advice, "left,area,0.5000,1.2500,2.0000,1.000,0.250,5.0\n");
    advice.places = 0;
    assert_says(advice_print_csv, &advice, "left,area,-,-,-,-,-,-\n");
}

static void table_begins_with_the_best(void **state)
{
    (void)state;
    const room_board_t board = {.name = "left", .method = warp_method_from_name("mean+cubic")};
    wall_advice_t advice = advice_of(&board);
    set(&advice, "area", 0.5, 5.0);
    set(&advice, "none+linear", 2.0, 4.0);
    set(&advice, "mean+cubic", 0.25, 20.0);
    set(&advice, "none+cubic", 3.0, 49.0);
    char text[TEXT_LENGTH];
    print_to(text, advice_print_table, &advice);
    assert_non_null(strstr(text, "left: k 0.50 to 2.00, median 1.25; method: mean+cubic\n"));
    static const char *const order[] = {"\n  mean+cubic ", "\n  area ",         "\n  none+linear ",
                                        "\n  none+cubic ", "\n  none+nearest ", "\n  gauss+nearest "};
    for (size_t n = 1; n < sizeof order / sizeof *order; n++) {
        const char *before = strstr(text, order[n - 1]), *after = strstr(text, order[n]);
        if (before == NULL || after == NULL || !(before < after))
            fail_msg("'%s' is not before '%s' in:\n%s", order[n - 1], order[n], text);
    }
    assert_says(advice_print_table, &advice,
                "\n  advice: method: mean+cubic, as it is\n"
                "  auto: mean+spline at the least k, mean+cubic at the median, mean+cubic at the largest\n");
}

static void advice_names_a_cheaper_one(void **state)
{
    (void)state;
    const room_board_t board = {.name = "left", .method = warp_method_from_name("area")};
    wall_advice_t advice = advice_of(&board);
    set(&advice, "mean+cubic", 0.25, 20.0);
    set(&advice, "area", 0.34, 5.0);
    set(&advice, "none+nearest", 0.36, 1.0);
    assert_says(advice_print_table, &advice,
                "\n  advice: method: mean+cubic; area is within 0.1 dB of it at 25 % of its cost\n");
    set(&advice, "area", 0.36, 5.0);
    assert_says(advice_print_table, &advice, "\n  advice: method: mean+cubic\n");
    /* where auto is mean+cubic everywhere, nobody needs it */
    set(&advice, "auto", 0.25, 20.0);
    assert_says(advice_print_table, &advice, "\n  advice: method: mean+cubic\n");
    /* of equals, the one that stays good where the viewer was not expected */
    set(&advice, "gauss+cubic", 0.25, 19.0);
    set(&advice, "none+cubic", 0.25, 20.0);
    assert_says(advice_print_table, &advice, "\n  advice: method: mean+cubic;");
    set(&advice, "gauss+cubic", 1.0, 50.0);
    set(&advice, "none+cubic", 1.0, 50.0);
    set(&advice, "mean+spline", 0.2, 24.0);
    assert_says(advice_print_table, &advice, "; mean+cubic is within 0.1 dB of it at 83 % of its cost\n");
}

static void warnings_name_what_is_wrong(void **state)
{
    (void)state;
    const room_board_t board = {.name = "left", .method = warp_method_default()};
    wall_advice_t advice = advice_of(&board);
    char text[TEXT_LENGTH];
    print_to(text, advice_print_warnings, &advice);
    assert_string_equal(text, "");
    advice.places = 40;
    advice.too_near = 7;
    advice.unseen = 2;
    advice.from_behind = 3;
    assert_says(advice_print_warnings, &advice, "warning: board left: 7 of 49 places are nearer than 0.3 m");
    assert_says(advice_print_warnings, &advice, "warning: board left: 2 of 49 places do not see it");
    assert_says(advice_print_warnings, &advice, "warning: board left: 3 of 49 places see it from behind");
    advice.places = 0;
    assert_says(advice_print_warnings, &advice, "warning: board left: out of view from everywhere");
    assert_says(advice_print_table, &advice, "left: not seen from anywhere\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_has_a_row_per_method),
        cmocka_unit_test(table_begins_with_the_best),
        cmocka_unit_test(advice_names_a_cheaper_one),
        cmocka_unit_test(warnings_name_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
