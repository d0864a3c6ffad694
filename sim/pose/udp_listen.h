// SPDX-License-Identifier: Apache-2.0
// A UDP socket that hears a tracker: unicast, or a multicast group.
#ifndef SIM_POSE_UDP_LISTEN_H
#define SIM_POSE_UDP_LISTEN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

enum { UDP_LISTEN_MESSAGE_LENGTH = 256 };

/**
 * Can this be listened to? Nothing is opened.
 *
 * @param      address    ADDR:PORT, IPv4 in four numbers, port 0 to 65535.
 * @param      interface  The address of the network interface on which a group is joined; NULL for the system's choice.
 * @param[out] error      On failure: one line without newline, what was expected.
 */
bool udp_listen_check(const char *address, const char *interface, char error[UDP_LISTEN_MESSAGE_LENGTH]);

/**
 * Open it. A multicast address is joined, and other programs may hear it too; any other must be one of this machine's.
 *
 * @param[out] port   Which it is: another one when 0 was asked for.
 * @param[out] error  On failure: one line without newline, what failed and what to do.
 * @return The socket, for close(); or -1.
 */
int udp_listen_open(const char *address, const char *interface, int *port, char error[UDP_LISTEN_MESSAGE_LENGTH]);

/**
 * Take a packet, without waiting for one.
 *
 * @param[out] arrived_us  When this machine's kernel got it, on CLOCK_MONOTONIC: how long it has waited here does not
 * show.
 * @return Its size, cut to the place for it; or -1 with errno.
 */
ssize_t udp_listen_take(int listener, uint8_t *bytes, size_t place, int64_t *arrived_us);

#endif
