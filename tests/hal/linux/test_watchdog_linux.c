// SPDX-License-Identifier: Apache-2.0
// A board without a watchdog, and files that are none. What a watchdog does is seen on the virtual board.
#include "hal/linux/watchdog_linux.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tests/support/scratch.h"

static void a_board_without_one_does_nothing(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_watchdog_t *watchdog;
    assert_int_equal(watchdog_linux_open(&watchdog, NULL, error), HAL_OK);
    assert_int_equal(watchdog_linux_period_s(watchdog), 0);
    assert_int_equal(hal_watchdog_feed(watchdog), HAL_OK);
    watchdog_linux_close(watchdog);
    watchdog_linux_close(NULL);
}

static void assert_refused(const char *device, const char *why)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "", expected[HAL_BOARD_ERROR_LENGTH];
    hal_watchdog_t *watchdog = NULL;
    assert_int_equal(watchdog_linux_open(&watchdog, device, error), HAL_IO);
    assert_null(watchdog);
    snprintf(expected, sizeof expected, "watchdog %.60s: %s, expected the device of a watchdog: `wdctl` lists them",
             device, why);
    assert_string_equal(error, expected);
}

static void what_is_no_watchdog_is_refused(void **state)
{
    (void)state;
    assert_refused("/dev/no_such_watchdog", "No such file or directory");
    assert_refused("/dev/null", "Inappropriate ioctl for device");
    assert_refused("build", "Inappropriate ioctl for device");
}

static void a_plain_file_is_left_as_it_is(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    size_t length;
    scratch_path(*state, "watchdog0", path);
    scratch_write(path, "abc", 3);
    assert_refused(path, "Inappropriate ioctl for device");
    uint8_t *bytes = scratch_read(path, &length);
    assert_int_equal(length, 3);
    assert_memory_equal(bytes, "abc", 3);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_board_without_one_does_nothing),
        cmocka_unit_test(what_is_no_watchdog_is_refused),
        cmocka_unit_test(a_plain_file_is_left_as_it_is),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
