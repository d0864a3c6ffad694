// SPDX-License-Identifier: Apache-2.0
// A CAN controller that is set up as the room does not want it: the line's command mends it. For the super-user:
// check_can_controller INTERFACE, one with CAN FD.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hal/linux/can_socketcan.h"
#include "hal/linux/socketcan_netlink.h"

enum { NOBODY = 65534 };

static const char *interface;

/* A command of the shell, in which $CAN is the interface. */
static void run(const char *command)
{
    if (system(command) != 0)
        fail_msg("failed: %s", command);
}

static hal_status_t try_open(bool fd, char error[HAL_BOARD_ERROR_LENGTH])
{
    const can_socketcan_settings_t settings = {interface, 500000, 2000000, fd};
    hal_can_t *can = NULL;
    const hal_status_t status = can_socketcan_open(&can, &settings, error);
    can_socketcan_close(can);
    return status;
}

/* Refused for that reason; and no longer, once the command in the line has been run. */
static void assert_mended(bool fd, const char *reason)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "", start[HAL_BOARD_ERROR_LENGTH];
    snprintf(start, sizeof start, "can %s: %s: `", interface, reason);
    assert_int_equal(try_open(fd, error), HAL_IO);
    if (strncmp(error, start, strlen(start)) != 0)
        fail_msg("%s", error);
    char *command = error + strlen(start);
    assert_int_equal(command[strlen(command) - 1], '`');
    command[strlen(command) - 1] = '\0';
    run(command);
    if (try_open(fd, error) != HAL_OK)
        fail_msg("%s", error);
}

static void commands_mend_what_they_are_for(void **state)
{
    (void)state;
    run("ip link set $CAN down");
    assert_mended(true, "is down");
    run("ip link set $CAN down; ip link set $CAN up type can bitrate 250000 dbitrate 2000000 fd on");
    assert_mended(true, "bitrate 250000, the room has 500000");
    run("ip link set $CAN down; ip link set $CAN up type can bitrate 500000 dbitrate 4000000 fd on");
    assert_mended(true, "dbitrate 4000000, the room has 2000000");
    run("ip link set $CAN down; ip link set $CAN up type can bitrate 500000 fd off");
    assert_mended(true, "classic frames only, the room has CAN FD");
    run("ip link set $CAN down; ip link set $CAN up type can bitrate 500000 dbitrate 2000000 fd on listen-only on");
    assert_mended(true, "listens only");
}

/* The same as a user without any right, in a process of its own: its exit status is that of opening. */
static hal_status_t open_as_nobody(char error[HAL_BOARD_ERROR_LENGTH])
{
    int pipe_ends[2], status;
    assert_int_equal(pipe(pipe_ends), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        char line[HAL_BOARD_ERROR_LENGTH] = "";
        const hal_status_t opened = setresuid(NOBODY, NOBODY, NOBODY) == 0 ? try_open(true, line) : HAL_BAD_CALL;
        const ssize_t written = write(pipe_ends[1], line, sizeof line);
        _exit(written == sizeof line ? (int)opened : HAL_BAD_CALL);
    }
    close(pipe_ends[1]);
    assert_int_equal(read(pipe_ends[0], error, HAL_BOARD_ERROR_LENGTH), HAL_BOARD_ERROR_LENGTH);
    close(pipe_ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return (hal_status_t)WEXITSTATUS(status);
}

static void who_may_not_restart_needs_restart_ms(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH], expected[HAL_BOARD_ERROR_LENGTH];
    run("ip link set $CAN down; ip link set $CAN up type can bitrate 500000 dbitrate 2000000 fd on restart-ms 0");
    snprintf(expected, sizeof expected,
             "can %s: no way back from bus-off, expected restart-ms or CAP_NET_ADMIN: `ip link set %s down; ip link "
             "set %s up txqueuelen 64 type can bitrate 500000 dbitrate 2000000 fd on restart-ms 100`",
             interface, interface, interface);
    assert_int_equal(open_as_nobody(error), HAL_IO);
    assert_string_equal(error, expected);
    assert_int_equal(try_open(true, error), HAL_OK);
    run("ip link set $CAN down; ip link set $CAN up type can restart-ms 100");
    assert_int_equal(open_as_nobody(error), HAL_OK);
}

/* The kernel takes the request to be one: it refuses for the reason that there is. */
static void the_kernel_understands_a_restart(void **state)
{
    (void)state;
    static socketcan_netlink_t netlink;
    socketcan_link_t link;
    assert_int_equal(socketcan_netlink_open(&netlink), 0);
    run("ip link set $CAN down; ip link set $CAN up type can bitrate 500000 dbitrate 2000000 fd on restart-ms 0");
    assert_int_equal(socketcan_netlink_ask(&netlink, interface, &link), 0);
    assert_int_equal(socketcan_netlink_restart(&netlink, link.index), EBUSY); /* not bus-off */
    run("ip link set $CAN down");
    assert_int_equal(socketcan_netlink_restart(&netlink, link.index), EINVAL); /* down */
    assert_int_equal(socketcan_netlink_restart(&netlink, 99), ENODEV);
    socketcan_netlink_close(&netlink);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commands_mend_what_they_are_for),
        cmocka_unit_test(who_may_not_restart_needs_restart_ms),
        cmocka_unit_test(the_kernel_understands_a_restart),
    };
    if (argc != 2)
        return 2;
    interface = argv[1];
    return setenv("CAN", interface, 1) == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
