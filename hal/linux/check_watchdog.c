// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): the watchdog. It is not opened: that would start it.
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "hal/linux/check.h"
#include "hal/linux/device_user.h"

void check_watchdog(check_t *check)
{
    const char *device = check->table->watchdog;
    if (device == NULL)
        return;
    char path[CHECK_LINE_LENGTH], identity[CHECK_WORD_LENGTH] = "watchdog", who[DEVICE_USER_LENGTH];
    const char *name = strrchr(device, '/') != NULL ? strrchr(device, '/') + 1 : device;
    (void)snprintf(path, sizeof path, "/sys/class/watchdog/%s/identity", name);
    (void)check_read(check, path, identity, sizeof identity);
    (void)snprintf(path, sizeof path, "%s%s", check->root, device);
    if (access(path, F_OK) != 0) {
        check_miss(check, "ls -l /dev/watchdog*; without one: sudo modprobe softdog",
                   "watchdog: there is no %s, expected the one of the board", device);
        return;
    }
    if (device_user(who, device))
        check_held(check, "watchdog", device, who,
                   strncmp(who, "systemd ", 8) == 0
                       ? "set RuntimeWatchdogSec=off in /etc/systemd/system.conf, then sudo systemctl daemon-reexec"
                       : "stop that program");
    else if (access(path, W_OK) != 0)
        check_miss(check, "start the firmware as its service, whose unit gives the right (board/service)",
                   "watchdog: this user may not open %s", device);
    else
        check_found(check, "watchdog: %s, %s", device, identity);
}
