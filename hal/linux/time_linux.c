// SPDX-License-Identifier: Apache-2.0
// The board's clock (hal/hal_time.h) on Linux: CLOCK_MONOTONIC.
#include "hal/linux/time_linux.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hal/linux/board_error.h"

enum { US_PER_S = 1000000, NS_PER_US = 1000 };

struct hal_time {
    clockid_t id;
};

hal_status_t time_linux_open(hal_time_t **clock, char error[HAL_BOARD_ERROR_LENGTH])
{
    struct timespec step;
    if (clock_getres(CLOCK_MONOTONIC, &step) != 0)
        return board_error(error, "clock: no CLOCK_MONOTONIC: %s", strerror(errno));
    if (step.tv_sec > 0 || step.tv_nsec > NS_PER_US)
        return board_error(error,
                           "clock: CLOCK_MONOTONIC has steps of %ld us, expected 1 us or less; boot a kernel with "
                           "CONFIG_HIGH_RES_TIMERS and without highres=off",
                           (long)(step.tv_sec * US_PER_S + step.tv_nsec / NS_PER_US));
    hal_time_t *opened = malloc(sizeof *opened);
    if (opened == NULL)
        return board_error(error, "clock: out of memory");
    opened->id = CLOCK_MONOTONIC;
    *clock = opened;
    return HAL_OK;
}

void time_linux_close(hal_time_t *clock)
{
    free(clock);
}

int64_t hal_time_now_us(const hal_time_t *clock)
{
    struct timespec now;
    clock_gettime(clock->id, &now);
    return (int64_t)now.tv_sec * US_PER_S + now.tv_nsec / NS_PER_US;
}
