// SPDX-License-Identifier: Apache-2.0
// What test_hal_can needs of a Linux board: two interfaces on one wire, set up here, which only the super-user can.
#include "tests/support/can_pair.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hal/linux/can_socketcan.h"
#include "hal/linux/time_linux.h"

enum { MODE_LENGTH = 128, COMMAND_LENGTH = 512 };

struct can_pair {
    hal_time_t *clock;
    hal_can_t *controller[2];
};

/* By one command for both: programs start slowly on an emulated board. */
static void set_up(const char *const names[2], bool fd)
{
    char mode[MODE_LENGTH], command[COMMAND_LENGTH];
    if (strncmp(names[0], "vcan", 4) == 0)
        snprintf(mode, sizeof mode, "mtu %d", fd ? 72 : 16);
    else
        snprintf(mode, sizeof mode, "txqueuelen 64 type can bitrate 500000%s restart-ms 100",
                 fd ? " dbitrate 2000000 fd on" : "");
    snprintf(command, sizeof command,
             "ip -batch - <<END\nlink set %s down\nlink set %s down\nlink set %s up %s\nlink set %s up %s\nEND\n",
             names[0], names[1], names[0], mode, names[1], mode);
    if (system(command) != 0)
        fail_msg("failed: %s", command);
}

can_pair_t *can_pair_open(const char *const names[2], bool fd)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    can_pair_t *pair = calloc(1, sizeof *pair);
    assert_non_null(pair);
    assert_int_equal(time_linux_open(&pair->clock, error), HAL_OK);
    set_up(names, fd);
    for (int i = 0; i < 2; i++) {
        const can_socketcan_settings_t settings = {names[i], 500000, 2000000, fd};
        if (can_socketcan_open(&pair->controller[i], &settings, error) != HAL_OK)
            fail_msg("%s", error);
    }
    return pair;
}

void can_pair_close(can_pair_t *pair)
{
    for (int i = 0; i < 2; i++)
        can_socketcan_close(pair->controller[i]);
    time_linux_close(pair->clock);
    free(pair);
}

hal_can_t *can_pair_controller(can_pair_t *pair, int number)
{
    return pair->controller[number];
}

void can_pair_wait(can_pair_t *pair, int64_t time_us)
{
    (void)pair;
    usleep((useconds_t)time_us);
}

int64_t can_pair_now_us(const can_pair_t *pair)
{
    return hal_time_now_us(pair->clock);
}
