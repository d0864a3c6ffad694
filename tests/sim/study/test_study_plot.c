// SPDX-License-Identifier: Apache-2.0
// Plots of the study: lines with gaps, names that gnuplot must not read, and nothing to draw.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tests/support/study_bench.h"

/* A line over 5 points of which the third is none leaves two strokes. */
static void draw_gap(study_t *study)
{
    static const char *const none[] = {"nan", "inf", ""};
    for (int n = 0; n < 3; n++) {
        char name[32];
        snprintf(name, sizeof name, "gap%d.csv", n);
        FILE *csv = study_csv_begin(study, name, "x,it's");
        fprintf(csv, "0,1\n1,2\n2,%s\n3,2\n4,1\n", none[n]);
        study_csv_end(study, csv);
        char picture[32];
        snprintf(picture, sizeof picture, "gap%d.svg", n);
        const study_line_t line = {.csv = name, .x = 1, .y = 2, .title = "it's_100%", .colour = n};
        study_plot(study,
                   &(study_plot_t){.name = picture, .title = "a 'title'", .x_label = "x", .line = &line, .lines = 1});
    }
}

static void draw_nothing(study_t *study)
{
    FILE *csv = study_csv_begin(study, "empty.csv", "x,y");
    fputs("0,nan\n1,\n", csv);
    study_csv_end(study, csv);
    const study_line_t line = {.csv = "empty.csv", .x = 1, .y = 2};
    study_plot(study, &(study_plot_t){.name = "empty.svg", .line = &line, .lines = 1});
}

static void plots_leave_gaps(void **state)
{
    study_bench_succeed(*state, draw_gap);
    for (int n = 0; n < 3; n++) {
        char picture[32];
        snprintf(picture, sizeof picture, "gap%d.svg", n);
        char *svg = study_bench_text(*state, picture);
        assert_non_null(strstr(svg, "it's_100%"));
        assert_non_null(strstr(svg, "a 'title'"));
        const char *curve = strstr(svg, "gnuplot_plot_1");
        assert_non_null(curve);
        int strokes = 0;
        for (const char *at = strstr(curve, "M"); at != NULL && at < strstr(curve, "</g>\n</svg>");
             at = strstr(at + 1, "M"))
            strokes += at[1] >= '0' && at[1] <= '9' ? 1 : 0;
        if (strokes < 3)
            print_error("gap%d.svg: %d strokes\n", n, strokes);
        assert_true(strokes >= 3); /* the key's sample, and two parts of the curve */
        free(svg);
    }
}

static void plots_of_nothing_fail(void **state)
{
    char error[FILE_ERROR_LENGTH];
    assert_false(study_bench_run(*state, &(study_experiment_t){"nothing", draw_nothing, 1, 1}, 1, error));
    assert_non_null(strstr(error, "empty.svg: gnuplot"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(plots_leave_gaps, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(plots_of_nothing_fail, scratch_set_up, scratch_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
