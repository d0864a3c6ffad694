// SPDX-License-Identifier: Apache-2.0
// What the kernel tells of a CAN interface (rtnetlink), and whether it is as the room wants it. Pure functions.
#ifndef HAL_LINUX_SOCKETCAN_LINK_H
#define HAL_LINUX_SOCKETCAN_LINK_H

#include <linux/netlink.h>
#include <net/if.h>
#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"
#include "hal/linux/can_socketcan.h"

/** An interface. What the kernel does not tell is 0 or false: virtual ones have no controller. */
typedef struct {
    char name[IFNAMSIZ];
    int32_t index;                  /**< 0: there is none of that name */
    bool can;                       /**< of the CAN kind */
    bool up;                        /**< set up by the user; bus-off does not change it */
    bool fd;                        /**< takes CAN FD frames */
    bool controller;                /**< has bit rates, states and so on */
    bool listen_only;               /**< the controller never sends */
    bool any_state;                 /**< the controller tells its state */
    hal_can_state_t state;          /**< if any_state */
    uint32_t bitrate, data_bitrate; /**< as the controller divides its clock; 0: unknown */
    uint32_t restart_ms;            /**< after bus-off; 0: not by itself */
} socketcan_link_t;

/**
 * Read a message of the kernel.
 *
 * @param      message  RTM_NEWLINK or RTM_DELLINK, whole; a message of RTM_DELLINK gives index 0.
 * @param[out] link     Written only when true is returned.
 * @return false when it is another message, or damaged.
 */
bool socketcan_link_parse(socketcan_link_t *link, const struct nlmsghdr *message);

/**
 * @param      may_restart  The process may restart a controller that is bus-off.
 * @param[out] error        When the link is not as wanted: one line, with the command that mends it.
 * @return HAL_OK; HAL_IO.
 */
MUST_CHECK hal_status_t socketcan_link_check(const socketcan_link_t *link, const can_socketcan_settings_t *wanted,
                                             bool may_restart, char error[HAL_BOARD_ERROR_LENGTH]);

#endif
