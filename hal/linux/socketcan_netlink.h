// SPDX-License-Identifier: Apache-2.0
// Talking with the kernel about a CAN interface: rtnetlink, without blocking and without heap but for the two sockets.
#ifndef HAL_LINUX_SOCKETCAN_NETLINK_H
#define HAL_LINUX_SOCKETCAN_NETLINK_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/linux/socketcan_link.h"

enum { SOCKETCAN_NETLINK_BYTES = 16384 /**< more than any message about one link: 2 KB with everything */ };

typedef struct {
    struct mnl_socket *requests, *notices;
    uint32_t sequence;
    _Alignas(8) char buffer[SOCKETCAN_NETLINK_BYTES];
} socketcan_netlink_t;

/** @return 0, or what errno had: nothing is open then. */
int socketcan_netlink_open(socketcan_netlink_t *netlink);

/** Also right for one that is all zero. */
void socketcan_netlink_close(socketcan_netlink_t *netlink);

/**
 * Ask what an interface is now. The kernel answers before it returns.
 *
 * @param[out] link  Written only when 0 is returned.
 * @return 0, or an errno: ENODEV when there is none of that name.
 */
int socketcan_netlink_ask(socketcan_netlink_t *netlink, const char *interface, socketcan_link_t *link);

/**
 * Take the oldest notice about that interface.
 *
 * @param[out] link  Written only when HAL_OK is returned.
 * @return HAL_OK; HAL_EMPTY when there is none; HAL_IO when notices were lost: ask.
 */
MUST_CHECK hal_status_t socketcan_netlink_hear(socketcan_netlink_t *netlink, const char *interface,
                                               socketcan_link_t *link);

/**
 * Restart a controller that is bus-off. May wait for the kernel's lock of network settings, that is for a command like
 * `ip link set` of somebody else.
 *
 * @return 0, or an errno: EPERM without CAP_NET_ADMIN, EBUSY when it is not bus-off.
 */
int socketcan_netlink_restart(socketcan_netlink_t *netlink, int32_t index);

/** @return Has this process CAP_NET_ADMIN? */
bool socketcan_netlink_may_restart(void);

#endif
