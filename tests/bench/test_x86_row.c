// SPDX-License-Identifier: Apache-2.0
// Medians and quartiles of times, the CSV line, and what is said of the speeds that are asked for.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/bench/x86_row.h"

static const x86_case_t linear = {"linear", "none+linear", OPENCV_LINEAR, "linear", 35};
static const x86_case_t area = {"area", "area", OPENCV_LINEAR, "linear", 0};

static const x86_row_t rows[] = {
    {&linear, "xrgb", "strong", 1, {{2, 0.25}, {4.5, 0.5}, {0.3, 0.1}, {20, 1}}, {2.25, 0}, 44.04},
    {&area, "xrgb", "strong", 1, {{2, 0}, {2, 0}, {1, 0}, {20, 1}}, {1, 0}, 20},
    {&area, "xrgb", "mild", 1, {{8, 0}, {2, 0}, {1, 0}, {20, 1}}, {0.25, 0}, 20},
    {&area, "gray", "strong", 2, {{8, 0}, {2, 0}, {1, 0}, {20, 1}}, {0.25, 0}, 20},
};

static void assert_time(double *times, int count, double median, double iqr)
{
    const x86_spread_t time = x86_spread_of(times, count);
    assert_float_equal(time.median, median, 1e-9);
    assert_float_equal(time.iqr, iqr, 1e-9);
}

static void quartiles_of_any_number_of_times(void **state)
{
    (void)state;
    assert_time((double[]){7}, 1, 7, 0);
    assert_time((double[]){4, 2}, 2, 3, 1);
    assert_time((double[]){9, 1, 5, 3, 700}, 5, 5, 6);
    assert_time((double[]){40, 10, 30, 20}, 4, 25, 15);
}

/* What `print` writes. */
static void said(char *text, size_t size, void (*print)(FILE *))
{
    FILE *file = tmpfile();
    assert_non_null(file);
    print(file);
    rewind(file);
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
}

static void print_two_lines(FILE *file)
{
    x86_print_row(file, &rows[0]);
    x86_print_row(file, &rows[1]);
}

static void print_all_figures(FILE *file)
{
    x86_print_figures(file, rows, sizeof rows / sizeof *rows);
}

static void a_line_has_the_fields_of_the_header(void **state)
{
    (void)state;
    char text[1024];
    said(text, sizeof text, print_two_lines);
    assert_string_equal(text,
                        "linear,xrgb,strong,1,2.000,0.250,linear,4.500,0.500,2.25,0.00,0.300,0.100,20.000,1.000,44.0\n"
                        "area,xrgb,strong,1,2.000,0.000,linear,2.000,0.000,1.00,0.00,1.000,0.000,20.000,1.000,\n");
    char header[1024];
    said(header, sizeof header, x86_print_header);
    int fields = 0;
    for (const char *c = header; *c != '\0'; c++)
        fields += *c == ',' ? 1 : 0;
    for (const char *c = text; *c != '\n'; c++)
        fields -= *c == ',' ? 1 : 0;
    assert_int_equal(fields, 0);
}

static void figures_are_of_one_thread_and_the_strong_pose(void **state)
{
    (void)state;
    char text[1024];
    said(text, sizeof text, print_all_figures);
    assert_string_equal(text, "bench: linear      xrgb strong: 2.25 times as fast as OpenCV's linear, at least 2.5 "
                              "wanted: NOT REACHED\n"
                              "bench: area        xrgb strong: 1.00 times as fast as OpenCV's linear, at least 1.0 "
                              "wanted: reached\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quartiles_of_any_number_of_times),
        cmocka_unit_test(a_line_has_the_fields_of_the_header),
        cmocka_unit_test(figures_are_of_one_thread_and_the_strong_pose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
