// SPDX-License-Identifier: Apache-2.0
// Faults that need no source: a flood, and bus-off on a virtual interface.
#include "sim/pose/bus_flood.h"

#include <errno.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/ethtool.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "sim/devices/sim_clock.h"

enum { US_PER_S = 1000000, FRAMES_PER_S = 9000 /* 8 bytes take 111 bits and more: a bus of 1 Mbit/s is full */ };

bool bus_flood(const char *bus, const bus_flood_t *flood, int64_t *sent, char error[POSE_LINK_MESSAGE_LENGTH])
{
    pose_link_t link;
    *sent = 0;
    if (!pose_link_open(&link, bus, false, error))
        return false;
    const hal_can_frame_t frame = {.id = flood->id, .length = 8};
    const int64_t start_us = sim_clock_monotonic_us();
    bool ok = true;
    for (int64_t since_us = 0; ok && !*flood->stop && since_us < flood->length_us;) {
        for (; ok && *sent * US_PER_S < since_us * FRAMES_PER_S; *sent += ok)
            ok = pose_link_send(&link, &frame, 1, error);
        poll(NULL, 0, 1);
        since_us = sim_clock_monotonic_us() - start_us;
    }
    pose_link_close(&link);
    return ok;
}

static bool is_virtual(int socket, const char *interface)
{
    struct ethtool_drvinfo driver = {.cmd = ETHTOOL_GDRVINFO};
    struct ifreq request = {.ifr_ifindex = 0};
    snprintf(request.ifr_name, sizeof request.ifr_name, "%s", interface);
    request.ifr_data = (char *)&driver;
    return ioctl(socket, SIOCETHTOOL, &request) == 0 && strcmp(driver.driver, "vcan") == 0;
}

bool bus_flood_bus_off(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH])
{
    pose_link_t link;
    if (!pose_link_open(&link, bus, false, error))
        return false;
    const struct can_frame frame = {.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF, .can_dlc = CAN_ERR_DLC};
    bool ok = false;
    if (link.socketcand || !is_virtual(link.socket, bus))
        snprintf(
            error, POSE_LINK_MESSAGE_LENGTH,
            "%.40s: only a virtual interface can play bus-off: `modprobe vcan && ip link add vcan0 type vcan && ip "
            "link set vcan0 up`, and --can vcan0 for the board; on a real bus connect CAN_H and CAN_L for a moment",
            bus);
    else if (write(link.socket, &frame, sizeof frame) != (ssize_t)sizeof frame)
        snprintf(error, POSE_LINK_MESSAGE_LENGTH, "%.60s: %.100s", bus, strerror(errno));
    else
        ok = true;
    pose_link_close(&link);
    return ok;
}
