// SPDX-License-Identifier: Apache-2.0
// Sets of methods, contests between them, and that the figures which must hold fail as soon as the numbers do.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "sim/study/gap_contests.h"

enum { RUNS = 4 };

static int index_of(const char *name)
{
    const warp_method_t *method = warp_method_from_name(name);
    assert_non_null(method);
    return (int)(method - warp_methods);
}

/* Every method at 30 dB, the limit at 30.1. */
static void level_runs(study_mesh_run_t run[RUNS])
{
    memset(run, 0, RUNS * sizeof run[0]);
    for (int n = 0; n < RUNS; n++) {
        run[n].at = (study_mesh_case_t){{8, 8, 8, 8}, STUDY_NOISE, 4, 4, 20.0 * n};
        for (int truth = 0; truth < STUDY_TRUTHS; truth++) {
            run[n].found.limit_db[truth] = 30.1;
            for (int m = 0; m < WARP_METHODS; m++)
                run[n].found.psnr_db[truth][m] = 30.0;
        }
    }
}

static bool has(study_methods_t set, const char *name)
{
    return (set >> index_of(name) & 1) != 0;
}

static void sets_hold_what_they_say(void **state)
{
    (void)state;
    assert_true(has(study_methods("kaiser+*"), "kaiser+cubic"));
    assert_false(has(study_methods("kaiser+*"), "butter+cubic"));
    assert_true(study_methods("no such method") == 0);
    assert_true(study_methods("auto") == 0);
    assert_true(has(study_methods_paper(), "none+nearest") && has(study_methods_paper(), "gauss+cubic"));
    assert_false(has(study_methods_paper(), "area") || has(study_methods_paper(), "mean+cubic"));
    assert_true(has(study_methods_filtered(), "butter+linear"));
    assert_false(has(study_methods_filtered(), "none+linear") || has(study_methods_filtered(), "area"));
    assert_false(has(study_methods_filtered(), "ls"));
    assert_true(study_methods_family() == (study_methods("area") | study_methods("mean+*")));
    assert_true((study_methods("*") & STUDY_LIMIT) == 0);
}

static void a_tally_counts_cases_and_finds_the_worst(void **state)
{
    (void)state;
    study_mesh_run_t run[RUNS];
    level_runs(run);
    const int area = index_of("area");
    run[1].found.psnr_db[0][area] = 32.0;
    run[2].found.psnr_db[0][area] = 29.0;
    run[3].found.psnr_db[0][area] = 29.95;
    study_contest_t contest = {
        .contenders = study_methods("area"), .others = study_methods_paper(), .tolerance_db = 0.1};
    study_tally_t tally = study_tally(&contest, run, RUNS);
    assert_int_equal(tally.cases, 4);
    assert_int_equal(tally.wins, 3);
    assert_int_equal(tally.worst, 2);
    assert_true(fabs(tally.worst_db + 1.0) < 1e-9);
    assert_true(fabs(tally.mean_db - 0.95 / 4) < 1e-9);
    contest.from_angle_deg = 60;
    tally = study_tally(&contest, run, RUNS);
    assert_int_equal(tally.cases, 1);
    assert_int_equal(tally.wins, 1);
    contest.contenders = 0;
    tally = study_tally(&contest, run, RUNS);
    assert_int_equal(tally.cases, 0);
    assert_int_equal(tally.worst, -1);
}

static void cases_without_error_are_no_contest(void **state)
{
    (void)state;
    study_mesh_run_t run[RUNS];
    level_runs(run);
    for (int m = 0; m < WARP_METHODS; m++)
        run[0].found.psnr_db[0][m] = HUGE_VAL;
    run[1].found.psnr_db[0][index_of("none+nearest")] = HUGE_VAL;
    const study_contest_t contest = {.contenders = study_methods("area"), .others = study_methods_paper()};
    const study_tally_t tally = study_tally(&contest, run, RUNS);
    assert_int_equal(tally.cases, 3);
    assert_int_equal(tally.wins, 2);
    assert_int_equal(tally.worst, 1);
    assert_true(tally.worst_db == -HUGE_VAL);
    assert_true(tally.mean_db == 0.0);
    assert_true(study_db_ahead(HUGE_VAL, HUGE_VAL) == 0.0);
}

static void the_original_is_judged_where_there_is_one(void **state)
{
    (void)state;
    study_mesh_run_t run[RUNS];
    level_runs(run);
    run[2].at.finer = 1;
    const study_contest_t contest = {STUDY_TRUTH_ORIGINAL, study_methods("area"), study_methods_paper(), 0, 0};
    assert_int_equal(study_tally(&contest, run, RUNS).cases, 3);
}

/* The figure holds with all methods level, and no longer with one number of one run `by` dB off. */
static void flips(int which, const char *method, study_truth_t truth, double by)
{
    gap_contest_t contest[GAP_CONTESTS];
    study_mesh_run_t run[RUNS];
    gap_contests(contest);
    level_runs(run);
    const study_contest_claim_t claim = {"wallwarp", contest[which].claim, &contest[which].duel, 1};
    assert_int_equal(study_contest_verdict(&claim, run, RUNS), STUDY_HOLDS);
    double *number = &run[2].found.psnr_db[truth][index_of(method)];
    *number += 0.9 * by;
    assert_int_equal(study_contest_verdict(&claim, run, RUNS), STUDY_HOLDS);
    *number += 0.2 * by;
    if (study_contest_verdict(&claim, run, RUNS) != STUDY_PARTLY)
        fail_msg("%s holds although %s is off by %g dB", contest[which].name, method, 1.1 * by);
    for (int n = 0; n < RUNS; n++)
        run[n].found.psnr_db[truth][index_of(method)] = *number;
    assert_int_equal(study_contest_verdict(&claim, run, RUNS), STUDY_FAILS);
}

static void figures_that_must_hold_fail_when_numbers_do(void **state)
{
    (void)state;
    flips(0, "area", STUDY_TRUTH_PICTURE, -0.02); /* from 0.1 to 0.122 dB below the limit */
    flips(1, "area", STUDY_TRUTH_PICTURE, -0.02);
    flips(1, "butter+cubic", STUDY_TRUTH_PICTURE, 0.02);
    flips(2, "gauss+cubic", STUDY_TRUTH_ORIGINAL, 0.05);
    flips(2, "area", STUDY_TRUTH_ORIGINAL, 0.05);
}

static void blocks_are_rewarded_only_by_their_own_truth(void **state)
{
    (void)state;
    gap_rewards_t rewards = {.nearest_db = {0.9, -1.6}, .area_db = {2.7, -1.0}};
    assert_int_equal(gap_rewards_verdict(&rewards), STUDY_HOLDS);
    rewards.nearest_db[STUDY_TRUTH_PICTURE] = -0.1;
    assert_int_equal(gap_rewards_verdict(&rewards), STUDY_PARTLY);
    rewards.area_db[STUDY_TRUTH_ORIGINAL] = 0.1;
    assert_int_equal(gap_rewards_verdict(&rewards), STUDY_FAILS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sets_hold_what_they_say),
        cmocka_unit_test(a_tally_counts_cases_and_finds_the_worst),
        cmocka_unit_test(cases_without_error_are_no_contest),
        cmocka_unit_test(the_original_is_judged_where_there_is_one),
        cmocka_unit_test(figures_that_must_hold_fail_when_numbers_do),
        cmocka_unit_test(blocks_are_rewarded_only_by_their_own_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
