// SPDX-License-Identifier: Apache-2.0
// How long a study will still take, by its table and by its pace.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sim/study/study_progress.h"

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
        cmocka_unit_test(time_left_follows_table_and_pace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
