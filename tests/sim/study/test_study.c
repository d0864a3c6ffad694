// SPDX-License-Identifier: Apache-2.0
// The frame of the study with experiments made for the test: files, failures, threads, verdicts.
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
#include "tests/support/study_bench.h"

enum { TASKS = 1000 };

static bool exists(const scratch_t *scratch, const char *name)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(scratch, name, path);
    return access(path, F_OK) == 0;
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
    study_bench_succeed(*state, use_threads);
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
    FILE *csv = study_csv_begin(study, "late.csv", "x");
    fputs("1\n", csv);
    study_csv_end(study, csv);
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
    assert_false(study_bench_run(*state, experiments, 2, error));
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
    const bool done = study_bench_run(scratch, &(study_experiment_t){"never", never_run, 1, 1}, 1, error);
    assert_int_equal(setenv("PATH", path, 1), 0);
    free(path);
    assert_false(done);
    assert_non_null(strstr(error, "apt-get install gnuplot-nox"));
}

static void same_files(const scratch_t *a, const scratch_t *b, const char *name)
{
    char *first = study_bench_text(a, name), *second = study_bench_text(b, name);
    if (strcmp(first, second) != 0)
        print_error("%s differs\n", name);
    assert_string_equal(first, second);
    free(first);
    free(second);
}

static void two_runs_make_the_same_bytes(void **state)
{
    scratch_t other;
    scratch_open(&other);
    study_bench_succeed(*state, study_fig05);
    study_bench_succeed(&other, study_fig05);
    static const char *const names[] = {"index.html",  "fig05.csv",   "fig05_k.csv",  "fig05_x.svg",
                                        "fig05_y.svg", "fig05_z.svg", "fig05_xyz.svg"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        same_files(*state, &other, names[n]);
    scratch_close(&other);
}

static void claims_hold_in_all_in_some_or_in_no_case(void **state)
{
    (void)state;
    assert_int_equal(study_verdict(3, 3), STUDY_HOLDS);
    assert_int_equal(study_verdict(1, 3), STUDY_PARTLY);
    assert_int_equal(study_verdict(2, 3), STUDY_PARTLY);
    assert_int_equal(study_verdict(0, 3), STUDY_FAILS);
    assert_int_equal(study_verdict(0, 0), STUDY_FAILS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_task_runs_once, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(first_failure_ends_the_study, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(bad_folders_are_refused, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(missing_gnuplot_is_said_before_the_work, scratch_set_up, scratch_tear_down),
        cmocka_unit_test_setup_teardown(two_runs_make_the_same_bytes, scratch_set_up, scratch_tear_down),
        cmocka_unit_test(claims_hold_in_all_in_some_or_in_no_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
