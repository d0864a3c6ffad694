// SPDX-License-Identifier: Apache-2.0
// The study's measured cases against the tables of tests/oracle, which a program of its own made in floating point.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/study/study_mesh.h"
#include "sim/study/study_mesh_tally.h"

enum { LINE_LENGTH = 512, TABLE_FIELDS = 11 };

/* Cases that are cheap, and which rows of the tables they are. */
typedef struct {
    const char *table, *room, *picture;
    study_mesh_case_t at; /* without angle */
    int rows;             /* at least */
} table_case_t;

/* Splits at commas, empty fields kept. */
static int split(char *line, char *field[TABLE_FIELDS])
{
    int fields = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *next = line; next != NULL && fields < TABLE_FIELDS;)
        field[fields++] = strsep(&next, ",");
    return fields;
}

static double psnr_of(const study_mesh_run_t *run, study_truth_t truth, const char *method)
{
    const study_methods_t set = strcmp(method, "limit") == 0 ? STUDY_LIMIT : study_methods(method);
    return study_best_db(&run->found, truth, set);
}

/* @return false when this build has no such method. */
static bool row_agrees(const study_mesh_run_t *run, study_truth_t truth, char *const last[5])
{
    const double got = psnr_of(run, truth, last[0]), expected = strtod(last[1], NULL);
    if (got == -HUGE_VAL)
        return false;
    if (!(fabs(study_db_ahead(got, expected)) <= 0.1))
        fail_msg("%s at %g degrees: %.3f dB, expected %s", last[0], run->at.angle_deg, got, last[1]);
    const double k_in = strtod(last[2], NULL), k_all = strtod(last[3], NULL);
    assert_true(fabs(run->found.k_in - k_in) <= 2e-4 * k_in);
    assert_true(fabs(run->found.k_all - k_all) <= 2e-4 * k_all);
    assert_true(fabs(run->found.coverage - strtod(last[4], NULL)) <= 2e-4);
    return true;
}

static int compare(const table_case_t *c)
{
    const study_truth_t truth = c->at.finer > 1 ? STUDY_TRUTH_ORIGINAL : STUDY_TRUTH_PICTURE;
    const int more = c->at.finer > 1; /* a field names the original */
    study_mesh_run_t run = {.at = {.angle_deg = -1}};
    char line[LINE_LENGTH], *field[TABLE_FIELDS];
    int rows = 0;
    FILE *table = fopen(c->table, "r");
    assert_non_null(table);
    while (fgets(line, sizeof line, table) != NULL) {
        if (split(line, field) != 9 + more || strcmp(field[0], c->room) != 0 || strcmp(field[1], c->picture) != 0)
            continue;
        char *z = strchr(field[2 + more], ' '); /* x y z ...: y is 0 */
        assert_non_null(z);
        const double x = strtod(field[2 + more], NULL), depth = -strtod(strchr(z + 1, ' '), NULL);
        const double angle_deg = round(atan2(x, depth) * 1800.0 / acos(-1.0)) / 10.0;
        if (run.at.angle_deg != angle_deg) {
            run.at = c->at;
            run.at.angle_deg = angle_deg;
            study_mesh_measure(&run);
            assert_string_equal(run.error, "");
        }
        rows += row_agrees(&run, truth, &field[4 + more]);
    }
    fclose(table);
    return rows;
}

static void cases_agree_with_the_tables(void **state)
{
    (void)state;
    static const char original[] = "tests/oracle/expected_original.csv", picture[] = "tests/oracle/expected_psnr.csv";
    static const table_case_t cases[] = {
        {original, "room_480x270_eq.yaml", "studio_480x270.png", {{480, 270, 480, 270}, STUDY_STUDIO, 4, 4, 0}, 45},
        {original, "room_480x270_gt.yaml", "studio_480x270.png", {{480, 270, 240, 135}, STUDY_STUDIO, 4, 4, 0}, 45},
        {picture, "room_gt.yaml", "studio_1920x1080.png", {{1920, 1080, 960, 540}, STUDY_STUDIO, 1, 4, 0}, 15},
    };
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const int rows = compare(&cases[c]);
        if (rows < cases[c].rows)
            fail_msg("%s: %d rows were compared, expected %d or more", cases[c].room, rows, cases[c].rows);
    }
}

static void without_an_original_there_are_no_figures_of_it(void **state)
{
    (void)state;
    study_mesh_run_t run = {.at = {{64, 36, 64, 36}, STUDY_NOISE, 1, 4, 30}};
    study_mesh_measure(&run);
    assert_string_equal(run.error, "");
    assert_true(isnan(run.found.limit_db[STUDY_TRUTH_ORIGINAL]));
    for (int m = 0; m < WARP_METHODS; m++)
        assert_true(isnan(run.found.psnr_db[STUDY_TRUTH_ORIGINAL][m]));
    assert_true(isfinite(run.found.limit_db[STUDY_TRUTH_PICTURE]));
}

static void refused(const study_mesh_case_t *at, const char *why)
{
    study_mesh_run_t run = {.at = *at, .found = {.k_in = 7.0}};
    study_mesh_measure(&run);
    if (strstr(run.error, why) == NULL)
        fail_msg("error '%s', expected it to say '%s'", run.error, why);
    assert_true(run.found.k_in == 7.0);
}

static void impossible_cases_are_refused(void **state)
{
    (void)state;
    refused(&(study_mesh_case_t){{1920, 1080, 64, 36}, STUDY_COFFEE, 1, 4, 30}, "coffee, 1920 x 1080");
    refused(&(study_mesh_case_t){{64, 36, 64, 36}, STUDY_NOISE, 4, 6, 30}, "factor 6, expected a multiple of 4");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_agree_with_the_tables),
        cmocka_unit_test(without_an_original_there_are_no_figures_of_it),
        cmocka_unit_test(impossible_cases_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
