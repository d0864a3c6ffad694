// SPDX-License-Identifier: Apache-2.0
// Tests of pose lists: good files, and every kind of bad line with its place.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/pose_list.h"
#include "tests/support/scratch.h"

static bool load(pose_list_t *list, const char *text, size_t length, char error[POSE_LIST_MESSAGE_LENGTH])
{
    scratch_t scratch;
    char path[SCRATCH_PATH_LENGTH];
    scratch_open(&scratch);
    scratch_path(&scratch, "poses.csv", path);
    scratch_write(path, text, length);
    const bool loaded = pose_list_load(list, path, error);
    scratch_close(&scratch);
    return loaded;
}

static void test_a_good_list_is_read(void **state)
{
    (void)state;
    static const char TEXT[] = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\r\n"
                               "0,1,2.5,-3,1,0,0,0\r\n"
                               "0.0333333,0,0,0,0,1,0,0\n"
                               "0.0333333,0,0,0,0,0,1,0\n"
                               "12.5,0,0,0,0,0,0,-1"; /* no newline at the end */
    pose_list_t list;
    char error[POSE_LIST_MESSAGE_LENGTH] = "";
    if (!load(&list, TEXT, strlen(TEXT), error))
        fail_msg("%s", error);
    assert_int_equal(list.count, 4);
    assert_true(list.entry[0].pose.eye_nm[1] == 2500000);
    assert_true(list.entry[0].pose.eye_nm[2] == -3000000);
    assert_true(list.entry[1].time_us == 33333);
    assert_true(list.entry[3].time_us == 12500000);
    assert_int_equal(list.entry[3].pose.quaternion_q30[3], -(1 << 30));
    pose_list_free(&list);
    assert_null(list.entry);
    assert_int_equal(list.count, 0);
}

static void test_a_byte_order_mark_is_passed_over(void **state)
{
    (void)state;
    static const char TEXT[] = "\xEF\xBB\xBFtime_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,1,2,3,1,0,0,0\n";
    pose_list_t list;
    char error[POSE_LIST_MESSAGE_LENGTH] = "";
    if (!load(&list, TEXT, strlen(TEXT), error))
        fail_msg("%s", error);
    assert_int_equal(list.count, 1);
    pose_list_free(&list);
}

static void test_a_long_list_is_read(void **state)
{
    (void)state;
    enum { ROWS = 5000, ROW = 64 };
    char *text = malloc(ROWS * ROW);
    assert_non_null(text);
    size_t used = (size_t)snprintf(text, ROW, "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n");
    for (int i = 0; i < ROWS - 1; i++)
        used += (size_t)snprintf(text + used, ROW, "%d.5,%d,0,0,1,0,0,0\n", i, i);
    pose_list_t list;
    char error[POSE_LIST_MESSAGE_LENGTH];
    assert_true(load(&list, text, used, error));
    assert_int_equal(list.count, ROWS - 1);
    for (int i = 0; i < ROWS - 1; i++) {
        assert_true(list.entry[i].time_us == i * INT64_C(1000000) + 500000);
        assert_true(list.entry[i].pose.eye_nm[0] == i * INT64_C(1000000));
    }
    pose_list_free(&list);
    free(text);
}

static void check_refused(const char *text, size_t length, const char *reason)
{
    pose_list_t list = {.count = 77};
    char error[POSE_LIST_MESSAGE_LENGTH] = "";
    if (load(&list, text, length, error))
        fail_msg("a list was taken, expected \"%s\"", reason);
    if (strstr(error, reason) == NULL)
        fail_msg("the reason was \"%s\", expected \"%s\"", error, reason);
    assert_int_equal(list.count, 77);
}

static void test_bad_lists_are_refused_with_their_place(void **state)
{
    (void)state;
    static const struct {
        const char *rows, *reason;
    } BAD[] = {
        {"", ":2: found the end of the file, expected a pose"},
        {"\n", ":2: found 1 column, expected 8"},
        {"0,0,0,0,1,0,0\n", ":2: found 7 columns, expected 8"},
        {"0,0,0,0,1,0,0,0\n0,0,0,0,1,0,0,0,\n", ":3: found 9 columns, expected 8"},
        {"0,0,0,0,1,0,0,0\n\n", ":3: found 1 column, expected 8"},
        {"x,0,0,0,1,0,0,0\n", ":2: time_s: found \"x\", expected a decimal number"},
        {"-1,0,0,0,1,0,0,0\n", ":2: time_s: found -1, expected 0 to"},
        {"1e40,0,0,0,1,0,0,0\n", ":2: time_s: found 1e40, expected 0 to"},
        {"2,0,0,0,1,0,0,0\n1.9,0,0,0,1,0,0,0\n", ":3: time_s: found 1.9, expected no less than in the line before"},
        {"0,0,nan,0,1,0,0,0\n", ":2: y_mm: found \"nan\", expected a decimal number"},
        {"0,0,0, 0,1,0,0,0\n", ":2: z_mm: found \" 0\", expected a decimal number"},
        {"0,0,0,0,,0,0,0\n", ":2: qw: found \"\", expected a decimal number"},
        {"0,0,0,0,1,1,0,0\n", ":2: qw qx qy qz: found \"1 1 0 0\", expected a length within 1 % of 1"},
    };
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n%s", BAD[i].rows);
        check_refused(text, strlen(text), BAD[i].reason);
    }
    check_refused("", 0, ":1: found \"\", expected the header time_s,");
    check_refused("time_s,x_mm\n", 12, ":1: found \"time_s,x_mm\", expected the header time_s,");
}

static void test_binary_files_are_refused(void **state)
{
    (void)state;
    static char text[5000] = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,0,0,0,1,0,0,0";
    check_refused(text, 50, ":2: not text, or longer");
    memset(text + 34, '1', sizeof text - 34);
    check_refused(text, sizeof text, ":2: not text, or longer");
}

static void test_missing_files_and_folders_are_refused(void **state)
{
    (void)state;
    pose_list_t list;
    char error[POSE_LIST_MESSAGE_LENGTH] = "";
    assert_false(pose_list_load(&list, "tests/no_such_file.csv", error));
    assert_non_null(strstr(error, "tests/no_such_file.csv"));
    assert_false(pose_list_load(&list, "tests", error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_good_list_is_read),      cmocka_unit_test(test_a_byte_order_mark_is_passed_over),
        cmocka_unit_test(test_a_long_list_is_read),      cmocka_unit_test(test_bad_lists_are_refused_with_their_place),
        cmocka_unit_test(test_binary_files_are_refused), cmocka_unit_test(test_missing_files_and_folders_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
