// SPDX-License-Identifier: Apache-2.0
// When the kernel got a message, on this machine's monotonic clock: of sockets with SO_TIMESTAMPNS.
#include "sim/pose/kernel_stamp.h"

#include <string.h>

#include "hal/linux/clocks.h"

enum { LONGEST_WAIT_US = 1000000 };

int64_t kernel_stamp_us(struct msghdr *message)
{
    const clock_pair_t now = clock_pair();
    const int64_t now_us = now.monotonic_ns / 1000;
    for (struct cmsghdr *part = CMSG_FIRSTHDR(message); part != NULL; part = CMSG_NXTHDR(message, part)) {
        if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS)
            continue;
        struct timespec stamp;
        memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
        const int64_t stamp_ns = (int64_t)stamp.tv_sec * 1000000000 + stamp.tv_nsec;
        const int64_t age_us = (now.realtime_ns - stamp_ns) / 1000;
        return age_us >= 0 && age_us <= LONGEST_WAIT_US ? now_us - age_us : now_us;
    }
    return now_us;
}
