// SPDX-License-Identifier: Apache-2.0
// What the kernel tells of a CAN interface (rtnetlink), and whether it is as the room wants it. Pure functions.
#include "hal/linux/socketcan_link.h"

#include <libmnl/libmnl.h>
#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/if_arp.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <stdio.h>
#include <string.h>

#include "hal/linux/board_error.h"

enum { TOLERANCE = 200, COMMAND_LENGTH = 192 };

static bool fits(const struct nlattr *attribute, size_t size)
{
    return mnl_attr_get_payload_len(attribute) >= size;
}

static uint32_t number_of(const struct nlattr *attribute)
{
    return fits(attribute, sizeof(uint32_t)) ? mnl_attr_get_u32(attribute) : 0;
}

static uint32_t rate_of(const struct nlattr *attribute)
{
    struct can_bittiming timing = {.bitrate = 0};
    if (fits(attribute, sizeof timing))
        memcpy(&timing, mnl_attr_get_payload(attribute), sizeof timing);
    return timing.bitrate == UINT32_MAX ? 0 : timing.bitrate; /* UINT32_MAX: the driver does not know */
}

static void take_state(socketcan_link_t *link, uint32_t state)
{
    link->any_state = state <= CAN_STATE_BUS_OFF;
    link->state = HAL_CAN_ERROR_ACTIVE;
    if (state == CAN_STATE_ERROR_PASSIVE)
        link->state = HAL_CAN_ERROR_PASSIVE;
    else if (state == CAN_STATE_BUS_OFF)
        link->state = HAL_CAN_BUS_OFF;
}

static int take_controller(const struct nlattr *attribute, void *context)
{
    socketcan_link_t *link = context;
    const uint16_t type = mnl_attr_get_type(attribute);
    if (type == IFLA_CAN_BITTIMING) {
        link->bitrate = rate_of(attribute);
    } else if (type == IFLA_CAN_DATA_BITTIMING) {
        link->data_bitrate = rate_of(attribute);
    } else if (type == IFLA_CAN_STATE && fits(attribute, sizeof(uint32_t))) {
        take_state(link, number_of(attribute));
    } else if (type == IFLA_CAN_RESTART_MS) {
        link->restart_ms = number_of(attribute);
    } else if (type == IFLA_CAN_CTRLMODE && fits(attribute, sizeof(struct can_ctrlmode))) {
        struct can_ctrlmode mode;
        memcpy(&mode, mnl_attr_get_payload(attribute), sizeof mode);
        link->listen_only = (mode.flags & CAN_CTRLMODE_LISTENONLY) != 0;
    }
    return MNL_CB_OK;
}

/* What data are depends on the kind, which may come after them. */
typedef struct {
    bool can;
    const struct nlattr *data;
} kind_t;

static int take_kind(const struct nlattr *attribute, void *context)
{
    kind_t *kind = context;
    const uint16_t type = mnl_attr_get_type(attribute);
    if (type == IFLA_INFO_KIND)
        kind->can = fits(attribute, sizeof "can") && memcmp(mnl_attr_get_payload(attribute), "can", sizeof "can") == 0;
    else if (type == IFLA_INFO_DATA)
        kind->data = attribute;
    return MNL_CB_OK;
}

static int take_attribute(const struct nlattr *attribute, void *context)
{
    socketcan_link_t *link = context;
    const uint16_t type = mnl_attr_get_type(attribute);
    kind_t kind = {.can = false};
    if (type == IFLA_IFNAME) {
        snprintf(link->name, sizeof link->name, "%.*s", (int)mnl_attr_get_payload_len(attribute),
                 mnl_attr_get_str(attribute));
    } else if (type == IFLA_MTU) {
        link->fd = number_of(attribute) >= CANFD_MTU;
    } else if (type == IFLA_LINKINFO) {
        if (mnl_attr_parse_nested(attribute, take_kind, &kind) < 0)
            return MNL_CB_ERROR;
        link->controller = kind.can && kind.data != NULL;
        if (link->controller)
            return mnl_attr_parse_nested(kind.data, take_controller, link);
    }
    return MNL_CB_OK;
}

bool socketcan_link_parse(socketcan_link_t *link, const struct nlmsghdr *message)
{
    socketcan_link_t found = {.index = 0};
    struct ifinfomsg about;
    if ((message->nlmsg_type != RTM_NEWLINK && message->nlmsg_type != RTM_DELLINK) ||
        mnl_nlmsg_get_payload_len(message) < sizeof about)
        return false;
    memcpy(&about, mnl_nlmsg_get_payload(message), sizeof about);
    found.index = message->nlmsg_type == RTM_NEWLINK ? about.ifi_index : 0;
    found.can = about.ifi_type == ARPHRD_CAN;
    found.up = (about.ifi_flags & IFF_UP) != 0;
    if (mnl_attr_parse(message, sizeof about, take_attribute, &found) < 0)
        return false;
    *link = found;
    return true;
}

/* The one to set: wanted, or else as it is, or what a room has that states none. */
static unsigned rate_for(int32_t wanted, uint32_t found, unsigned usual)
{
    return wanted != 0 ? (unsigned)wanted : found != 0 ? found : usual;
}

static void command_for(char command[COMMAND_LENGTH], const socketcan_link_t *link,
                        const can_socketcan_settings_t *wanted)
{
    char data[40] = "";
    if (wanted->fd)
        snprintf(data, sizeof data, " dbitrate %u fd on", rate_for(wanted->data_bitrate, link->data_bitrate, 2000000));
    if (link->controller)
        snprintf(command, COMMAND_LENGTH,
                 "`ip link set %s down; ip link set %s up txqueuelen 64 type can bitrate %u%s restart-ms 100%s`",
                 link->name, link->name, rate_for(wanted->bitrate, link->bitrate, 500000), data,
                 link->listen_only ? " listen-only off" : "");
    else
        snprintf(command, COMMAND_LENGTH, "`ip link set %s down; ip link set %s up mtu %d`", link->name, link->name,
                 wanted->fd ? (int)CANFD_MTU : (int)CAN_MTU);
}

static bool is_other_rate(uint32_t found, int32_t wanted)
{
    const int64_t difference = (int64_t)found - wanted;
    return found != 0 && wanted != 0 && (difference < 0 ? -difference : difference) > wanted / TOLERANCE;
}

hal_status_t socketcan_link_check(const socketcan_link_t *link, const can_socketcan_settings_t *wanted,
                                  bool may_restart, char error[HAL_BOARD_ERROR_LENGTH])
{
    char command[COMMAND_LENGTH];
    command_for(command, link, wanted);
    if (!link->can)
        return board_error(error, "can %s: is no CAN interface, expected one of `ip link show type can`", link->name);
    if (!link->up)
        return board_error(error, "can %s: is down: %s", link->name, command);
    if (is_other_rate(link->bitrate, wanted->bitrate))
        return board_error(error, "can %s: bitrate %u, the room has %d: %s", link->name, link->bitrate, wanted->bitrate,
                           command);
    if (wanted->fd && !link->fd)
        return board_error(error, "can %s: classic frames only, the room has CAN FD: %s", link->name, command);
    if (wanted->fd && is_other_rate(link->data_bitrate, wanted->data_bitrate))
        return board_error(error, "can %s: dbitrate %u, the room has %d: %s", link->name, link->data_bitrate,
                           wanted->data_bitrate, command);
    if (link->listen_only)
        return board_error(error, "can %s: listens only: %s", link->name, command);
    if (link->controller && link->restart_ms == 0 && !may_restart)
        return board_error(error, "can %s: no way back from bus-off, expected restart-ms or CAP_NET_ADMIN: %s",
                           link->name, command);
    return HAL_OK;
}
