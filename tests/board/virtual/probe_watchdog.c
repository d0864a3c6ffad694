// SPDX-License-Identifier: Apache-2.0
// Has a watchdog for a while: probe_watchdog DEVICE SECONDS close|crash|hang, what it does at the end of that time.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hal/linux/watchdog_linux.h"

enum { FEEDS_A_SECOND = 10, BAD_USAGE = 2 };

int main(int argc, char **argv)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_watchdog_t *watchdog;
    if (argc != 4)
        return BAD_USAGE;
    if (watchdog_linux_open(&watchdog, argv[1], error) != HAL_OK) {
        printf("%s\n", error);
        return 1;
    }
    printf("period %d s\n", watchdog_linux_period_s(watchdog));
    fflush(stdout);
    for (int i = 0; i < FEEDS_A_SECOND * atoi(argv[2]); i++) {
        if (hal_watchdog_feed(watchdog) != HAL_OK) {
            printf("not fed\n");
            return 1;
        }
        usleep(1000000 / FEEDS_A_SECOND);
    }
    if (strcmp(argv[3], "close") == 0)
        watchdog_linux_close(watchdog);
    else if (strcmp(argv[3], "hang") == 0)
        sleep(3600);
    _exit(0);
}
