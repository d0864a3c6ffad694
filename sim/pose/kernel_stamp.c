// SPDX-License-Identifier: Apache-2.0
// When the kernel got a message, on this machine's monotonic clock: of sockets with SO_TIMESTAMPNS.
#include "sim/pose/kernel_stamp.h"

#include <string.h>

#include "sim/devices/sim_clock.h"

enum { LONGEST_WAIT_US = 1000000, CLOSE_US = 20, MOST_READINGS = 5 };

static int64_t realtime_us(const struct timespec *time)
{
    return (int64_t)time->tv_sec * 1000000 + time->tv_nsec / 1000;
}

/* How far CLOCK_REALTIME is ahead of the monotonic clock. Whoever is interrupted between the two reads again. */
static int64_t ahead_us(void)
{
    int64_t ahead = 0, least_us = INT64_MAX;
    for (int i = 0; i < MOST_READINGS && least_us > CLOSE_US; i++) {
        struct timespec now;
        const int64_t before_us = sim_clock_monotonic_us();
        clock_gettime(CLOCK_REALTIME, &now);
        const int64_t took_us = sim_clock_monotonic_us() - before_us;
        if (took_us < least_us) {
            least_us = took_us;
            ahead = realtime_us(&now) - before_us - took_us / 2;
        }
    }
    return ahead;
}

int64_t kernel_stamp_us(struct msghdr *message)
{
    const int64_t now_us = sim_clock_monotonic_us();
    for (struct cmsghdr *part = CMSG_FIRSTHDR(message); part != NULL; part = CMSG_NXTHDR(message, part)) {
        if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS)
            continue;
        struct timespec stamp;
        memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
        const int64_t stamp_us = realtime_us(&stamp) - ahead_us();
        return stamp_us <= now_us && now_us - stamp_us <= LONGEST_WAIT_US ? stamp_us : now_us;
    }
    return now_us;
}
