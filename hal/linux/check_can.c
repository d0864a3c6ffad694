// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): the bus.
#include <linux/ethtool.h>
#include <linux/net_tstamp.h>
#include <linux/sockios.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "hal/linux/check.h"
#include "hal/linux/socketcan_netlink.h"

static const char *state_name(const socketcan_link_t *link)
{
    if (!link->any_state)
        return link->controller ? "state unknown" : "no controller";
    return link->state == HAL_CAN_ERROR_ACTIVE    ? "error active"
           : link->state == HAL_CAN_ERROR_PASSIVE ? "error passive"
                                                  : "bus-off";
}

/* Who stamps received frames. Asking needs no rights. */
static const char *stamps_of(const char *interface)
{
    struct ethtool_ts_info info = {.cmd = ETHTOOL_GET_TS_INFO};
    struct ifreq request = {.ifr_data = (void *)&info};
    (void)snprintf(request.ifr_name, sizeof request.ifr_name, "%.15s", interface);
    const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (file < 0)
        return "stamps unknown";
    const bool asked = ioctl(file, SIOCETHTOOL, &request) == 0;
    close(file);
    return asked && (info.so_timestamping & SOF_TIMESTAMPING_RX_HARDWARE) != 0 ? "stamps by the controller"
                                                                               : "stamps by the kernel";
}

/* What hal_board_open() would say; with no room, only what it says of every room. */
static hal_status_t judge(const check_t *check, const socketcan_link_t *link, char error[HAL_BOARD_ERROR_LENGTH])
{
    can_socketcan_settings_t wanted = {.interface = check->table->can, .fd = link->fd};
    if (check->needs != NULL) {
        wanted.bitrate = check->needs->bitrate;
        wanted.data_bitrate = check->needs->data_bitrate;
        wanted.fd = check->needs->fd;
    }
    return socketcan_link_check(link, &wanted, socketcan_netlink_may_restart(), error);
}

void check_can(check_t *check)
{
    const char *interface = check->table->can;
    char error[HAL_BOARD_ERROR_LENGTH];
    socketcan_netlink_t netlink;
    socketcan_link_t link = {.index = 0};
    int failure = socketcan_netlink_open(&netlink);
    if (failure == 0)
        failure = socketcan_netlink_ask(&netlink, interface, &link);
    socketcan_netlink_close(&netlink);
    if (failure != 0)
        check_miss(check, "load the overlay of the controller, as the page of the board has it; ip link show type can",
                   "can %s: %s", interface, strerror(failure));
    else if (judge(check, &link, error) != HAL_OK)
        check_miss(check, NULL, "%s", error);
    else
        check_found(check, "can %s: %u bit/s%s, data %u bit/s, %s, %s", interface, link.bitrate, link.fd ? " FD" : "",
                    link.data_bitrate, state_name(&link), stamps_of(interface));
}
