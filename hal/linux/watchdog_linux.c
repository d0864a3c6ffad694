// SPDX-License-Identifier: Apache-2.0
// The watchdog (hal/hal_watchdog.h) behind /dev/watchdogN of Linux.
#include "hal/linux/watchdog_linux.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/watchdog.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hal/linux/board_error.h"

struct hal_watchdog {
    int device; /* -1: the board has none */
    int32_t period_s;
};

static hal_status_t explain(const char *device, int failure, char error[HAL_BOARD_ERROR_LENGTH])
{
    if (failure == EBUSY)
        return board_error(error,
                           "watchdog %.60s: held by another program (`fuser %.60s`); if that is systemd, leave "
                           "RuntimeWatchdogSec out of system.conf",
                           device, device);
    if (failure == EACCES || failure == EPERM)
        return board_error(error, "watchdog %.60s: %s, expected the right to write to it: `ls -l %.60s`", device,
                           strerror(failure), device);
    return board_error(error, "watchdog %.60s: %s, expected the device of a watchdog: `wdctl` lists them", device,
                       strerror(failure));
}

static void stop(int device)
{
    if (write(device, "V", 1) != 1) {
        /* the driver runs on, and the board resets: nothing is left to try */
    }
    close(device);
}

/* @return The period that the device now has; 0 when it tells none. */
static int32_t set_period(int device)
{
    int period_s = 0;
    for (int wanted_s = WATCHDOG_LINUX_PERIOD_S; wanted_s <= WATCHDOG_LINUX_LONGEST_S; wanted_s *= 2) {
        int given_s = wanted_s;
        if (ioctl(device, WDIOC_SETTIMEOUT, &given_s) == 0)
            break;
    }
    return ioctl(device, WDIOC_GETTIMEOUT, &period_s) == 0 ? period_s : 0;
}

/* A file that is no device must not even be opened: opening is what starts a watchdog, and closing writes. */
static int open_device(const char *path, int *failure)
{
    struct stat about;
    *failure = stat(path, &about) != 0 ? errno : 0;
    if (*failure == 0 && !S_ISCHR(about.st_mode))
        *failure = ENOTTY;
    if (*failure != 0)
        return -1;
    const int device = open(path, O_WRONLY | O_CLOEXEC);
    struct watchdog_info info;
    *failure = device < 0 ? errno : 0;
    if (device >= 0 && ioctl(device, WDIOC_GETSUPPORT, &info) != 0) {
        *failure = ENOTTY;
        close(device);
        return -1;
    }
    return device;
}

hal_status_t watchdog_linux_open(hal_watchdog_t **watchdog, const char *device, char error[HAL_BOARD_ERROR_LENGTH])
{
    hal_watchdog_t made = {.device = -1};
    if (device != NULL) {
        int failure;
        made.device = open_device(device, &failure);
        if (made.device < 0)
            return explain(device, failure, error);
        made.period_s = set_period(made.device);
    }
    hal_watchdog_t *kept = malloc(sizeof *kept);
    if (kept == NULL) {
        if (made.device >= 0)
            stop(made.device);
        return board_error(error, "watchdog: out of memory");
    }
    *kept = made;
    *watchdog = kept;
    return HAL_OK;
}

void watchdog_linux_close(hal_watchdog_t *watchdog)
{
    if (watchdog != NULL && watchdog->device >= 0)
        stop(watchdog->device);
    free(watchdog);
}

int32_t watchdog_linux_period_s(const hal_watchdog_t *watchdog)
{
    return watchdog->period_s;
}

hal_status_t hal_watchdog_feed(hal_watchdog_t *watchdog)
{
    return watchdog->device < 0 || ioctl(watchdog->device, WDIOC_KEEPALIVE, 0) == 0 ? HAL_OK : HAL_IO;
}
