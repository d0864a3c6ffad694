// SPDX-License-Identifier: Apache-2.0
// Times of cameras on hal_time's clock, CLOCK_MONOTONIC.
#ifndef HAL_LINUX_CAMERA_CLOCK_H
#define HAL_LINUX_CAMERA_CLOCK_H

#include <stdint.h>
#include <time.h>

/** @return Microseconds on a clock of the system. */
static inline int64_t camera_clock_us(clockid_t clock)
{
    struct timespec now;
    (void)clock_gettime(clock, &now); /* clocks that every Linux has */
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static inline int64_t camera_now_us(void)
{
    return camera_clock_us(CLOCK_MONOTONIC);
}

/**
 * A time stamp of libcamera on CLOCK_MONOTONIC. By its documentation it is on CLOCK_BOOTTIME, while its pipelines pass
 * on V4L2's, which is on CLOCK_MONOTONIC. Both agree but for the time that the board slept, by which the former is
 * ahead: a stamp that is still to come is on it.
 *
 * @param stamp_us      The stamp, of a picture that has arrived.
 * @param monotonic_us  CLOCK_MONOTONIC now.
 * @param boottime_us   CLOCK_BOOTTIME now.
 */
static inline int64_t camera_stamp_us(int64_t stamp_us, int64_t monotonic_us, int64_t boottime_us)
{
    return stamp_us <= monotonic_us ? stamp_us : stamp_us - (boottime_us - monotonic_us);
}

#endif
