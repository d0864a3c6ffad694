// SPDX-License-Identifier: Apache-2.0
// Fuzzes poses as text and pose lists: what is accepted is a sound pose with the numbers that were written.
#include "sim/pose/pose_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/pose/pose_list.h"
#include "tests/fuzz/input.h"

enum { UNTOUCHED = 0xa5 };

static void check_sane(const pose_t *pose)
{
    double norm = 0;
    for (int i = 0; i < 3; i++)
        fuzz_check(llabs(pose->eye_nm[i]) <= INT64_C(1000000000000), "the eye is within 1000 m");
    for (int i = 0; i < 4; i++)
        norm = hypot(norm, pose->quaternion_q30[i] / 1073741824.0);
    fuzz_check(norm > 0.98999999 && norm < 1.01000001, "the quaternion is within 1 % of unit length");
}

static void check_untouched(const pose_t *pose)
{
    const uint8_t *byte = (const uint8_t *)pose;
    for (size_t i = 0; i < sizeof *pose; i++)
        fuzz_check(byte[i] == UNTOUCHED, "a refused text leaves the pose untouched");
}

/* The numbers once more, by the C library. */
static void check_numbers(const char *text, const pose_t *pose)
{
    char *at = NULL;
    for (int i = 0; i < POSE_TEXT_FIELDS; i++, text = at) {
        const long double number = strtold(text, &at);
        fuzz_check(at != text, "an accepted number is one to the C library");
        const long double expected = i < 3 ? number * 1e6L : number * 1073741824.0L;
        const long double found = (long double)(i < 3 ? pose->eye_nm[i] : pose->quaternion_q30[i - 3]);
        fuzz_check(fabsl(found - expected) <= 0.5001L, "a number is the nearest one");
    }
}

static void check_text(const char *text)
{
    pose_t pose;
    char error[POSE_TEXT_MESSAGE_LENGTH] = "";
    memset(&pose, UNTOUCHED, sizeof pose);
    if (pose_from_text(text, &pose, error)) {
        check_sane(&pose);
        check_numbers(text, &pose);
    } else {
        check_untouched(&pose);
        fuzz_check(error[0] != '\0', "a refusal says why");
    }
}

static void check_list(const uint8_t *data, size_t size)
{
    pose_list_t list = {.entry = NULL};
    char error[POSE_LIST_MESSAGE_LENGTH] = "";
    const input_file_t file = input_file_open(data, size);
    if (pose_list_load(&list, file.path, error)) {
        fuzz_check(list.count >= 1, "a list has a pose");
        for (size_t i = 0; i < list.count; i++) {
            check_sane(&list.entry[i].pose);
            fuzz_check(list.entry[i].time_us >= (i == 0 ? 0 : list.entry[i - 1].time_us), "times never go back");
            fuzz_check(list.entry[i].time_us <= INT64_C(10000000000000000), "times end somewhere");
        }
        pose_list_free(&list);
    } else {
        fuzz_check(list.entry == NULL, "a refused list is untouched");
        fuzz_check_line(error);
    }
    input_file_close(&file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    fuzz_check(text != NULL, "memory for the text");
    if (size > 0)
        memcpy(text, data, size);
    text[size] = '\0';
    check_text(text);
    free(text);
    check_list(data, size);
    return 0;
}
