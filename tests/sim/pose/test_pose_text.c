// SPDX-License-Identifier: Apache-2.0
// Tests of pose texts: exact numbers, refusals with a reason.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/pose_text.h"
#include "tests/support/rng.h"

static pose_t read_pose(const char *text)
{
    pose_t pose;
    char error[POSE_TEXT_MESSAGE_LENGTH];
    if (!pose_from_text(text, &pose, error))
        fail_msg("\"%s\": %s", text, error);
    return pose;
}

static void test_positions_are_exact_to_the_nanometre(void **state)
{
    (void)state;
    const pose_t pose = read_pose("-7989.829770 1e3\t 0.0000014 1 0 0 0");
    assert_true(pose.eye_nm[0] == -INT64_C(7989829770));
    assert_true(pose.eye_nm[1] == INT64_C(1000000000));
    assert_true(pose.eye_nm[2] == 1);
    assert_int_equal(pose.quaternion_q30[0], 1 << 30);
    assert_int_equal(pose.quaternion_q30[1], 0);
    const pose_t far = read_pose(" -1000000 1000000 0 0 -1 0 0 ");
    assert_true(far.eye_nm[0] == -INT64_C(1000000000000));
    assert_true(far.eye_nm[1] == INT64_C(1000000000000));
    assert_int_equal(far.quaternion_q30[1], -(1 << 30));
}

/* As written: who turns by a quaternion divides by its length, so the same numbers always make the same picture. */
static void test_quaternions_are_rounded_to_q30(void **state)
{
    (void)state;
    const pose_t pose = read_pose("0 0 0 0.6060 0 -0.8080 0");
    assert_int_equal(pose.quaternion_q30[0], 650687545); /* 0.606 and 0.808 in Q30, rounded */
    assert_int_equal(pose.quaternion_q30[2], -867583394);
    assert_int_equal(read_pose("0 0 0 1.01 0 0 0").quaternion_q30[0], 1084479242);
    assert_int_equal(read_pose("0 0 0 0.99 0 0 0").quaternion_q30[0], 1063004406);
}

static void test_bad_texts_are_refused_with_a_reason(void **state)
{
    (void)state;
    static const struct {
        const char *text, *reason;
    } BAD[] = {
        {"", "expected 7 numbers"},
        {"0 0 0 1 0 0", "expected 7 numbers"},
        {"0 0 0 1 0 0 0 0", "expected 7 numbers"},
        {"0,0,0,1,0,0,0", "expected 7 numbers"},
        {"nan 0 0 1 0 0 0", "x_mm: found \"nan\", expected a decimal number"},
        {"0 inf 0 1 0 0 0", "y_mm: found \"inf\", expected a decimal number"},
        {"0 0 0 1 0 0 NaN", "qz: found \"NaN\", expected a decimal number"},
        {"0 0 1000000.000001 1 0 0 0", "z_mm: found \"1000000.000001\", expected at most 1000000 mm"},
        {"0 -1e30 0 1 0 0 0", "y_mm: found \"-1e30\", expected at most 1000000 mm"},
        {"0 0 0 0 0 0 0", "qw qx qy qz: found \"0 0 0 0\", expected a length within 1 % of 1"},
        {"0 0 0 0.9899999 0 0 0", "within 1 %"},
        {"0 0 0 0 1.0100001 0 0", "within 1 %"},
        {"0 0 0 5 5 5 5", "within 1 %"},
        {"0 0 0 0 0 1e9 0", "qy: found \"1e9\", expected -1 to 1"},
    };
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        const pose_t before = {.eye_nm = {1, 2, 3}, .quaternion_q30 = {4, 5, 6, 7}};
        pose_t pose = before;
        char error[POSE_TEXT_MESSAGE_LENGTH] = "";
        if (pose_from_text(BAD[i].text, &pose, error))
            fail_msg("\"%s\" was taken", BAD[i].text);
        if (strstr(error, BAD[i].reason) == NULL)
            fail_msg("\"%s\": the reason was \"%s\", expected \"%s\"", BAD[i].text, error, BAD[i].reason);
        assert_memory_equal(&pose, &before, sizeof pose);
    }
}

static void test_long_texts_are_refused(void **state)
{
    (void)state;
    enum { LENGTH = 100000 };
    char *text = malloc(LENGTH + 1);
    assert_non_null(text);
    for (int kind = 0; kind < 3; kind++) {
        memset(text, " 17"[kind], LENGTH);
        text[LENGTH] = '\0';
        pose_t pose;
        char error[POSE_TEXT_MESSAGE_LENGTH];
        assert_false(pose_from_text(text, &pose, error));
        assert_true(strlen(error) < POSE_TEXT_MESSAGE_LENGTH);
    }
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_positions_are_exact_to_the_nanometre),
        cmocka_unit_test(test_quaternions_are_rounded_to_q30),
        cmocka_unit_test(test_bad_texts_are_refused_with_a_reason),
        cmocka_unit_test(test_long_texts_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
