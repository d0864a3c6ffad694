// SPDX-License-Identifier: Apache-2.0
// Talking with the kernel about a CAN interface: rtnetlink, without blocking and without heap but for the two sockets.
#include "hal/linux/socketcan_netlink.h"

#include <errno.h>
#include <libmnl/libmnl.h>
#include <linux/can/netlink.h>
#include <linux/capability.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { NOTICES = 32 /* taken per call at most */ };

int socketcan_netlink_open(socketcan_netlink_t *netlink)
{
    netlink->sequence = 0;
    netlink->notices = NULL;
    netlink->requests = mnl_socket_open2(NETLINK_ROUTE, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (netlink->requests != NULL)
        netlink->notices = mnl_socket_open2(NETLINK_ROUTE, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (netlink->notices != NULL && mnl_socket_bind(netlink->requests, 0, MNL_SOCKET_AUTOPID) == 0 &&
        mnl_socket_bind(netlink->notices, RTMGRP_LINK, MNL_SOCKET_AUTOPID) == 0)
        return 0;
    const int failure = errno;
    socketcan_netlink_close(netlink);
    return failure;
}

void socketcan_netlink_close(socketcan_netlink_t *netlink)
{
    if (netlink->requests != NULL)
        (void)mnl_socket_close(netlink->requests);
    if (netlink->notices != NULL)
        (void)mnl_socket_close(netlink->notices);
    netlink->requests = netlink->notices = NULL;
}

/* An empty request of that type in the buffer. */
static struct nlmsghdr *begin(socketcan_netlink_t *netlink, uint16_t type, uint16_t flags, int32_t index)
{
    struct nlmsghdr *message = mnl_nlmsg_put_header(netlink->buffer);
    message->nlmsg_type = type;
    message->nlmsg_flags = (uint16_t)(NLM_F_REQUEST | flags);
    message->nlmsg_seq = ++netlink->sequence;
    struct ifinfomsg *about = mnl_nlmsg_put_extra_header(message, sizeof *about);
    about->ifi_family = AF_UNSPEC;
    about->ifi_index = index;
    return message;
}

/* The kernel has put its answer into our socket when the sending call returns. */
static int exchange(socketcan_netlink_t *netlink, const struct nlmsghdr *request, const struct nlmsghdr **answer)
{
    if (mnl_socket_sendto(netlink->requests, request, request->nlmsg_len) < 0)
        return errno;
    const ssize_t length = mnl_socket_recvfrom(netlink->requests, netlink->buffer, sizeof netlink->buffer);
    if (length < 0)
        return errno;
    const struct nlmsghdr *message = (const struct nlmsghdr *)(const void *)netlink->buffer;
    if (!mnl_nlmsg_ok(message, (int)length) || message->nlmsg_seq != netlink->sequence)
        return EPROTO;
    if (message->nlmsg_type == NLMSG_ERROR) {
        struct nlmsgerr result;
        if (mnl_nlmsg_get_payload_len(message) < sizeof result)
            return EPROTO;
        memcpy(&result, mnl_nlmsg_get_payload(message), sizeof result);
        return -result.error;
    }
    *answer = message;
    return 0;
}

int socketcan_netlink_ask(socketcan_netlink_t *netlink, const char *interface, socketcan_link_t *link)
{
    const struct nlmsghdr *answer = NULL;
    struct nlmsghdr *request = begin(netlink, RTM_GETLINK, 0, 0);
    mnl_attr_put_u32(request, IFLA_EXT_MASK, RTEXT_FILTER_SKIP_STATS);
    mnl_attr_put_strz(request, IFLA_IFNAME, interface);
    const int failure = exchange(netlink, request, &answer);
    if (failure != 0)
        return failure;
    return answer != NULL && socketcan_link_parse(link, answer) ? 0 : EPROTO;
}

hal_status_t socketcan_netlink_hear(socketcan_netlink_t *netlink, const char *interface, socketcan_link_t *link)
{
    for (int i = 0; i < NOTICES; i++) {
        const ssize_t length = mnl_socket_recvfrom(netlink->notices, netlink->buffer, sizeof netlink->buffer);
        if (length < 0)
            return errno == EAGAIN ? HAL_EMPTY : HAL_IO;
        const struct nlmsghdr *message = (const struct nlmsghdr *)(const void *)netlink->buffer;
        socketcan_link_t found;
        if (mnl_nlmsg_ok(message, (int)length) && socketcan_link_parse(&found, message) &&
            strcmp(found.name, interface) == 0) {
            *link = found;
            return HAL_OK;
        }
    }
    return HAL_EMPTY;
}

int socketcan_netlink_restart(socketcan_netlink_t *netlink, int32_t index)
{
    const struct nlmsghdr *answer;
    struct nlmsghdr *request = begin(netlink, RTM_NEWLINK, NLM_F_ACK, index);
    struct nlattr *info = mnl_attr_nest_start(request, IFLA_LINKINFO);
    mnl_attr_put_strz(request, IFLA_INFO_KIND, "can");
    struct nlattr *data = mnl_attr_nest_start(request, IFLA_INFO_DATA);
    mnl_attr_put_u32(request, IFLA_CAN_RESTART, 1);
    mnl_attr_nest_end(request, data);
    mnl_attr_nest_end(request, info);
    return exchange(netlink, request, &answer);
}

bool socketcan_netlink_may_restart(void)
{
    struct __user_cap_header_struct header = {.version = _LINUX_CAPABILITY_VERSION_3};
    struct __user_cap_data_struct sets[_LINUX_CAPABILITY_U32S_3];
    return syscall(SYS_capget, &header, sets) == 0 && (sets[0].effective & (UINT32_C(1) << CAP_NET_ADMIN)) != 0;
}
