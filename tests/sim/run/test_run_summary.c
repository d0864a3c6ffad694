// SPDX-License-Identifier: Apache-2.0
// Tests of what is said at the end of a run.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/run/run_summary.h"

static char *printed(bool real, int64_t skipped)
{
    static room_t room;
    static run_frame_t frame[100];
    static run_record_t record = {.frames = 100, .frame = frame};
    const run_summary_t summary = {
        .room = &room, .record = &record, .folder = "out", .rate_hz = 60, .real = real, .skipped = skipped};
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    assert_non_null(file);
    run_summary_print(&summary, file);
    assert_int_equal(fclose(file), 0);
    return text;
}

static void test_a_machine_that_is_too_slow_is_said(void **state)
{
    (void)state;
    static const struct {
        bool real;
        int64_t skipped;
        bool slow;
    } runs[] = {{true, 11, true}, {true, 10, false}, {true, 0, false}, {false, 0, false}};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        char *text = printed(runs[i].real, runs[i].skipped);
        if ((strstr(text, "this machine is too slow") != NULL) != runs[i].slow || strstr(text, "page: out/") == NULL)
            fail_msg("run %zu: said\n%s", i, text);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_machine_that_is_too_slow_is_said)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
