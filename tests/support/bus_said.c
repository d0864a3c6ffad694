// SPDX-License-Identifier: Apache-2.0
// For tests of what `wallwarp-pose check` and `monitor` say of a watched bus.
#include "tests/support/bus_said.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/bus_table.h"

void bus_said(const bus_watch_t *watch, int64_t pose_delay_us, int bad, const char *expected)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    const int found = bus_check_print(file, watch, pose_delay_us);
    assert_int_equal(fclose(file), 0);
    if ((bad != BUS_SAID_ANY && found != bad) || strstr(text, expected) == NULL)
        fail_msg("%d bad instead of %d, or \"%s\" is not in:\n%s", found, bad, expected, text);
    free(text);
}

void bus_shown(const bus_watch_t *watch, const char *expected)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    bus_table_print(file, "can0", watch);
    assert_int_equal(fclose(file), 0);
    if (strstr(text, expected) == NULL)
        fail_msg("\"%s\" is not in:\n%s", expected, text);
    free(text);
}
