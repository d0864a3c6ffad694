// SPDX-License-Identifier: Apache-2.0
// The frame of the study with experiments made for the test: files, plots, page, failures, threads.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/study/study_experiments.h"
#include "sim/study/study_progress.h"
#include "tests/support/scratch.h"

enum { TASKS = 1000 };

static bool run(const scratch_t *scratch, const study_experiment_t *experiment, int experiments,
                char error[FILE_ERROR_LENGTH])
{
    const study_options_t options = {scratch->folder, true, experiment, experiments};
    return study_run(&options, error);
}

/* The whole file as text. */
static char *text_of(const scratch_t *scratch, const char *name)
{
    char path[SCRATCH_PATH_LENGTH];
    size_t length;
    scratch_path(scratch, name, path);
    uint8_t *bytes = scratch_read(path, &length);
    char *text = malloc(length + 1);
    memcpy(text, bytes, length);
    text[length] = '\0';
    free(bytes);
    return text;
}

static bool exists(const scratch_t *scratch, const char *name)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(scratch, name, path);
    return access(path, F_OK) == 0;
}

static void say_everything(study_t *study)
{
    FILE *csv = study_csv_begin(study, "table.csv", "name<1>,value");
    fputs("a&b,1\n\"c\",2\n", csv);
    study_csv_end(study, csv);
    study_section(study, "First <section>", "seed \"7\" & size");
    study_text(study, "%d < %d", 3, 4);
    study_figure(study, "a.svg", "a.csv", "One \"figure\"");
    study_figure(study, "b.svg", NULL, "Another");
    study_table(study, "table.csv", "A table");
    study_data(study, "table.csv", "The same & more:");
    study_claim(study, STUDY_PARTLY, "paper, fig 1", "A claim", "because %d", 5);
    study_section(study, "Second", "none");
    study_claim(study, STUDY_FAILS, "wallwarp", "Another claim", "no");
    study_headline(study, "%d > %d", 4, 3);
}

static int count_of(const char *text, const char *word)
{
    int count = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word))
        count++;
    return count;
}

static void page_holds_all_escaped_and_closed(void **state)
{
    char error[FILE_ERROR_LENGTH];
    assert_true(run(*state, &(study_experiment_t){"all", say_everything, 1, 1}, 1, error));
    char *page = text_of(*state, "index.html");
    static const char *const expected[] = {
        "<h2>First &lt;section&gt;</h2>",
        "<p class=\"settings\">seed &quot;7&quot; &amp; size</p>",
        ">3 &lt; 4</p>",
        "<img src=\"a.svg\" alt=\"One &quot;figure&quot;\">",
        "<a href=\"a.csv\">a.csv</a>",
        "<tr><th>name&lt;1&gt;</th><th>value</th></tr>",
        "<tr><td>a&amp;b</td><td>1</td></tr>",
        "The same &amp; more: <a href=\"table.csv\">table.csv</a></p>",
        "<div class=\"headlines\">\n<p>4 &gt; 3</p>\n</div>",
        "2 claims: 0 hold, 1 in part, 1 not.",
        "<a class=\"claim\" href=\"#c1\"><span class=\"pill part\">holds in part</span>",
        "id=\"c1\"><span class=\"pill part\">holds in part</span>",
        "<p>because 5</p></div></div>",
        "id=\"c2\"><span class=\"pill bad\">does not hold</span>",
        "<a href=\"#s2\">Second</a>",
    };
    for (size_t n = 0; n < sizeof expected / sizeof *expected; n++) {
        if (strstr(page, expected[n]) == NULL)
            print_error("missing: %s\n", expected[n]);
        assert_non_null(strstr(page, expected[n]));
    }
    static const char *const elements[][2] = {{"<section", "</section>"}, {"<div", "</div>"}, {"<figure ", "</figure>"},
                                              {"<table", "</table>"},     {"<p", "</p>"},     {"<a ", "</a>"}};
    for (size_t n = 0; n < sizeof elements / sizeof *elements; n++)
        assert_int_equal(count_of(page, elements[n][0]), count_of(page, elements[n][1]));
    /* every claim in the list at the top and in its place */
    const char *claims = strstr(page, "<div class=\"claims card\">"), *sections = strstr(page, "id=\"s1\"");
    assert_int_equal(count_of(claims, "<b>A claim</b>"), 2);
    assert_int_equal(count_of(page, "<b>A claim</b>"), 2);
    assert_int_equal(count_of(sections, "<b>A claim</b>"), 1);
    assert_int_equal(count_of(sections, "<b>Another claim</b>"), 1);
    assert_null(strstr(page, "<!--CLAIMS-->"));
    free(page);
}

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
    char error[FILE_ERROR_LENGTH] = "";
    const bool done = run(*state, &(study_experiment_t){"gap", draw_gap, 1, 1}, 1, error);
    if (!done)
        print_error("%s\n", error);
    assert_true(done);
    for (int n = 0; n < 3; n++) {
        char picture[32];
        snprintf(picture, sizeof picture, "gap%d.svg", n);
        char *svg = text_of(*state, picture);
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
    assert_false(run(*state, &(study_experiment_t){"nothing", draw_nothing, 1, 1}, 1, error));
    assert_non_null(strstr(error, "empty.svg: gnuplot"));
}

static void count_task(void *context, int32_t index)
{
    int32_t *slot = context;
    slot[index] += index;
}

static void use_threads(study_t *study)
{
    int32_t *slot = calloc(TASKS, sizeof *slot);
    study_parallel(study, TASKS, count_task, slot);
    study_parallel(study, 0, count_task, slot);
    for (int32_t n = 0; n < TASKS; n++)
        if (slot[n] != n)
            study_fail(study, "task %d ran wrongly", n);
    free(slot);
}

static void every_task_runs_once(void **state)
{
    char error[FILE_ERROR_LENGTH] = "";
    const bool done = run(*state, &(study_experiment_t){"threads", use_threads, 1, 1}, 1, error);
    if (!done)
        print_error("%s\n", error);
    assert_true(done);
}

static void fail_task(void *context, int32_t index)
{
    study_fail(context, index == 0 ? "the first reason, %d" : "a later one, %d", index);
}

static void fail_early(study_t *study)
{
    assert_false(study_failed(study));
    assert_true(study_quick(study));
    study_parallel(study, 1, fail_task, study);
    study_fail(study, "another reason");
    assert_true(study_failed(study));
    assert_null(study_csv_begin(study, "late.csv", "x"));
    study_section(study, "late", "late");
    study_text(study, "late");
    study_claim(study, STUDY_HOLDS, "late", "late", "late");
    study_plot(study, &(study_plot_t){.name = "late.svg"});
}

static void never_run(study_t *study)
{
    (void)study;
    fail();
}

static void first_failure_ends_the_study(void **state)
{
    char error[FILE_ERROR_LENGTH] = "", path[SCRATCH_PATH_LENGTH];
    const study_experiment_t experiments[] = {{"fails", fail_early, 1, 1}, {"never", never_run, 1, 1}};
    scratch_path(*state, "index.html", path);
    scratch_write(path, "old", 3);
    assert_false(run(*state, experiments, 2, error));
    assert_string_equal(error, "the first reason, 0");
    assert_false(exists(*state, "index.html"));
    assert_false(exists(*state, "late.csv"));
    assert_false(exists(*state, "late.svg"));
}

static void refuses(const char *folder, const char *reason)
{
    char error[FILE_ERROR_LENGTH] = "";
    const study_experiment_t never = {"never", never_run, 1, 1};
    const study_options_t options = {folder, true, &never, 1};
    assert_false(study_run(&options, error));
    if (strstr(error, reason) == NULL)
        print_error("said '%s', expected '%s'\n", error, reason);
    assert_non_null(strstr(error, reason));
}

static void bad_folders_are_refused(void **state)
{
    char path[SCRATCH_PATH_LENGTH], below[SCRATCH_PATH_LENGTH + 8], far[400];
    scratch_path(*state, "file", path);
    scratch_write(path, "x", 1);
    refuses(path, "file: is not a folder");
    snprintf(below, sizeof below, "%s/below", path);
    refuses(below, "can't make this folder");
    refuses("", "is no name for a folder");
    memset(far, 'a', sizeof far - 1);
    far[sizeof far - 1] = '\0';
    refuses(far, "File name too long");
    refuses("/proc/wallwarp", "can't make this folder");
}

static void missing_gnuplot_is_said_before_the_work(void **state)
{
    const scratch_t *scratch = *state;
    char *const path = strdup(getenv("PATH"));
    assert_int_equal(setenv("PATH", "/nowhere", 1), 0);
    char error[FILE_ERROR_LENGTH] = "";
    const bool done = run(scratch, &(study_experiment_t){"never", never_run, 1, 1}, 1, error);
    assert_int_equal(setenv("PATH", path, 1), 0);
    free(path);
    assert_false(done);
    assert_non_null(strstr(error, "apt-get install gnuplot-nox"));
}

static void same_files(const scratch_t *a, const scratch_t *b, const char *name)
{
    char *first = text_of(a, name), *second = text_of(b, name);
    if (strcmp(first, second) != 0)
        print_error("%s differs\n", name);
    assert_string_equal(first, second);
    free(first);
    free(second);
}

static void two_runs_make_the_same_bytes(void **state)
{
    char error[FILE_ERROR_LENGTH];
    scratch_t other;
    const study_experiment_t experiments[] = {{"all", say_everything, 1, 1}, {"fig 5", study_fig05, 1, 1}};
    scratch_open(&other);
    assert_true(run(*state, experiments, 2, error));
    assert_true(run(&other, experiments, 2, error));
    static const char *const names[] = {"index.html",  "fig05.csv",   "fig05_k.csv",  "fig05_x.svg",
                                        "fig05_y.svg", "fig05_z.svg", "fig05_xyz.svg"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        same_files(*state, &other, names[n]);
    scratch_close(&other);
}

static void time_left_follows_table_and_pace(void **state)
{
    (void)state;
    const study_experiment_t table[] = {{"a", NULL, 1, 100}, {"b", NULL, 2, 200}, {"c", NULL, 4, 400}};
    const study_options_t options = {.experiment = table, .experiments = 3};
    /* a machine half as fast, 10 s into b and 5 s into its running call */
    const study_progress_t progress = {
        .options = &options, .current = 1, .machine = 2.0, .started_us = 1000000, .call_us = 6000000};
    const int64_t now_us = 11000000;
    assert_true(study_progress_left_s(&progress, now_us, 0, 10) == 400 - 10 + 800);
    assert_true(study_progress_left_s(&progress, now_us, 5, 10) == 390 + 800);
    assert_true(study_progress_left_s(&progress, now_us, 1, 101) == 500 + 800);
    assert_true(study_progress_left_s(&progress, now_us + 1000000000, 0, 0) == 800);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(page_holds_all_escaped_and_closed, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(plots_leave_gaps, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(every_task_runs_once, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(first_failure_ends_the_study, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(bad_folders_are_refused, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(missing_gnuplot_is_said_before_the_work, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(two_runs_make_the_same_bytes, scratch_set_up, scratch_tear_down),
        cmocka_unit_test(time_left_follows_table_and_pace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
