// SPDX-License-Identifier: Apache-2.0
// Text -> pose.
#include "sim/pose/pose_text.h"

#include <stdio.h>
#include <string.h>

#include "sim/pose/decimal.h"
#include "warp_fixed/fixed.h"

enum { LONGEST_TEXT = 1023, QUATERNION_PLACES = 17, NM_PLACES = 6 };

static const int64_t farthest_nm = INT64_C(1000000000000);

const char *const pose_text_field_name[POSE_TEXT_FIELDS] = {"x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"};

static bool fail(char error[POSE_TEXT_MESSAGE_LENGTH], int field, const char *found, const char *expected)
{
    snprintf(error, POSE_TEXT_MESSAGE_LENGTH, "%s: found \"%.40s\", expected %s", pose_text_field_name[field], found,
             expected);
    return false;
}

/* 10^-17 units; their squares are below 10^36, so the sum of four is exact. */
static bool is_nearly_unit(const int64_t component[4])
{
    const int128_t shortest = INT64_C(99000000000000000);
    const int128_t longest = INT64_C(101000000000000000);
    int128_t sum = 0;
    for (int i = 0; i < 4; i++)
        sum += (int128_t)component[i] * component[i];
    return sum >= shortest * shortest && sum <= longest * longest;
}

bool pose_from_fields(const char *const field[POSE_TEXT_FIELDS], pose_t *pose, char error[POSE_TEXT_MESSAGE_LENGTH])
{
    int64_t number[POSE_TEXT_FIELDS];
    for (int i = 0; i < POSE_TEXT_FIELDS; i++) {
        const bool position = i < 3;
        const decimal_status_t status =
            decimal_from_text(field[i], position ? NM_PLACES : QUATERNION_PLACES, &number[i]);
        if (status == DECIMAL_NOT_A_NUMBER)
            return fail(error, i, field[i], "a decimal number");
        if (position && (status == DECIMAL_TOO_LARGE || number[i] > farthest_nm || number[i] < -farthest_nm))
            return fail(error, i, field[i], "at most 1000000 mm from the origin");
        if (status == DECIMAL_TOO_LARGE)
            return fail(error, i, field[i], "-1 to 1");
    }
    if (!is_nearly_unit(&number[3])) {
        snprintf(error, POSE_TEXT_MESSAGE_LENGTH,
                 "qw qx qy qz: found \"%.24s %.24s %.24s %.24s\", expected a length within 1 %% of 1", field[3],
                 field[4], field[5], field[6]);
        return false;
    }
    for (int i = 0; i < 3; i++)
        pose->eye_nm[i] = number[i];
    const real_t unit = real_from_int(INT64_C(100000000000000000), 0);
    for (int i = 0; i < 4; i++)
        pose->quaternion_q30[i] =
            (int32_t)real_to_fixed(real_div(real_from_int(number[3 + i], 0), unit), 30, INT32_MAX);
    return true;
}

bool pose_from_text(const char *text, pose_t *pose, char error[POSE_TEXT_MESSAGE_LENGTH])
{
    char copy[LONGEST_TEXT + 1] = "";
    const char *field[POSE_TEXT_FIELDS];
    int fields = 0;
    if (strlen(text) <= LONGEST_TEXT) /* else it stays empty and is refused */
        strcpy(copy, text);
    char *rest = NULL;
    for (char *word = strtok_r(copy, " \t", &rest); word != NULL; word = strtok_r(NULL, " \t", &rest)) {
        if (fields < POSE_TEXT_FIELDS)
            field[fields] = word;
        fields++;
    }
    if (fields != POSE_TEXT_FIELDS) {
        snprintf(error, POSE_TEXT_MESSAGE_LENGTH,
                 "pose \"%.100s\": expected 7 numbers with spaces between them: x_mm y_mm z_mm qw qx qy qz", text);
        return false;
    }
    return pose_from_fields(field, pose, error);
}
