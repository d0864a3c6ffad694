// SPDX-License-Identifier: Apache-2.0
// When the kernel got a message, on this machine's monotonic clock: of sockets with SO_TIMESTAMPNS.
#ifndef SIM_POSE_KERNEL_STAMP_H
#define SIM_POSE_KERNEL_STAMP_H

#include <stdint.h>
#include <sys/socket.h>
#include <time.h>

enum { KERNEL_STAMP_BYTES = CMSG_SPACE(sizeof(struct timespec)) /**< of msg_control, aligned as a struct cmsghdr */ };

/**
 * @param message  As recvmsg() has just filled it.
 * @return The stamp, on sim_clock_monotonic_us(). The kernel's own is on CLOCK_REALTIME, which may be set: when there
 * is none, or none that can be, the present moment.
 */
int64_t kernel_stamp_us(struct msghdr *message);

#endif
