// SPDX-License-Identifier: Apache-2.0
// A CAN controller that can't be opened: one line that says why. What an open one does is seen on the virtual board.
#include "hal/linux/can_socketcan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

static void open_refused(const char *interface, char error[HAL_BOARD_ERROR_LENGTH])
{
    const can_socketcan_settings_t settings = {interface, 500000, 2000000, true};
    hal_can_t *can = NULL;
    error[0] = '\0';
    assert_int_equal(can_socketcan_open(&can, &settings, error), HAL_IO);
    assert_null(can);
    assert_null(strchr(error, '\n'));
}

static void names_that_no_interface_has_are_refused(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    open_refused("", error);
    assert_string_equal(error, "can \"\": expected the name of an interface, 1 to 15 characters, as can0");
    open_refused("sixteen_letters_", error);
    assert_string_equal(error,
                        "can \"sixteen_letters_\": expected the name of an interface, 1 to 15 characters, as can0");
}

/* A kernel without CAN, as many a build machine has, must say so; one with CAN has no such interface. */
static void missing_interfaces_are_told(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    const int can = socket(PF_CAN, SOCK_RAW, 1);
    open_refused("nosuchcan0", error);
    if (can < 0)
        assert_string_equal(error, "can nosuchcan0: this kernel has no CAN sockets (Address family not supported by "
                                   "protocol): `modprobe can-raw`");
    else
        assert_string_equal(error, "can nosuchcan0: no such interface, expected one of `ip link show type can`; is the "
                                   "controller's device-tree overlay loaded?");
    close(can);
}

/* What was opened before the failure must be closed: many tries use up no files. */
static void nothing_is_left_open(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    const int before = dup(0);
    close(before);
    for (int i = 0; i < 10; i++)
        open_refused("nosuchcan0", error);
    const int after = dup(0);
    close(after);
    assert_int_equal(after, before);
    can_socketcan_close(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_that_no_interface_has_are_refused),
        cmocka_unit_test(missing_interfaces_are_told),
        cmocka_unit_test(nothing_is_left_open),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
