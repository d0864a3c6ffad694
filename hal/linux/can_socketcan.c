// SPDX-License-Identifier: Apache-2.0
// A CAN controller (hal/hal_can.h) behind an interface of Linux: SocketCAN, classic and FD.
#include "hal/linux/can_socketcan.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "hal/linux/board_error.h"
#include "hal/linux/socketcan_frame.h"
#include "hal/linux/socketcan_netlink.h"
#include "hal/linux/socketcan_socket.h"
#include "hal/linux/socketcan_stamp.h"

enum {
    PASSED = 512, /* frames not meant for the caller, per call */
    NOTICES = 64, /* of the link, per call */
    OWN = 64      /* frames to be handed back: the newest */
};

struct hal_can {
    can_socketcan_settings_t settings;
    socketcan_netlink_t netlink;
    socketcan_link_t link;
    socketcan_stamp_t stamp;
    socketcan_heard_t heard;
    int socket;
    int32_t bound; /* index of the interface that the socket is bound to, or 0 */
    bool usable;   /* the link is up and as wanted */
    bool may_restart;
    bool ask;     /* what the link is, as something was missed */
    bool emptied; /* no frame was waiting at the end of the last call */
    hal_can_state_t state;
    uint32_t lost;
    struct canfd_frame own[OWN]; /* [n % OWN]: sent with own set, not heard yet unless can_id is CAN_ERR_FLAG */
    uint32_t own_count;
};

static void forget_own(hal_can_t *can)
{
    for (int i = 0; i < OWN; i++)
        can->own[i].can_id = CAN_ERR_FLAG;
}

/* What the link is from now on. */
static void take_link(hal_can_t *can, const socketcan_link_t *link)
{
    char ignored[HAL_BOARD_ERROR_LENGTH];
    const bool was_usable = can->usable;
    can->link = *link;
    if (link->index != can->bound)
        can->bound = link->index != 0 && socketcan_socket_bind(can->socket, link->index) == 0 ? link->index : 0;
    can->usable = can->bound != 0 && socketcan_link_check(link, &can->settings, can->may_restart, ignored) == HAL_OK;
    if (can->usable && !was_usable) {
        can->state = HAL_CAN_ERROR_ACTIVE;
        can->stamp.distance_known = false;
        forget_own(can);
    }
    if (link->any_state)
        can->state = link->state;
}

static void hear_of_link(hal_can_t *can)
{
    socketcan_link_t link = {.index = 0};
    hal_status_t status = HAL_OK;
    for (int i = 0; i < NOTICES && status == HAL_OK; i++) {
        status = socketcan_netlink_hear(&can->netlink, can->settings.interface, &link);
        if (status == HAL_OK)
            take_link(can, &link);
    }
    if (status == HAL_EMPTY && !can->ask)
        return;
    const int failure = socketcan_netlink_ask(&can->netlink, can->settings.interface, &link);
    can->ask = failure != 0 && failure != ENODEV;
    if (!can->ask)
        take_link(can, failure == 0 ? &link : &(socketcan_link_t){.index = 0});
}

/* Was it asked for? Each is handed back once. */
static bool is_awaited(hal_can_t *can, const struct canfd_frame *raw)
{
    for (uint32_t n = 0; n < OWN; n++) {
        struct canfd_frame *own = &can->own[(can->own_count + n) % OWN]; /* oldest first */
        if (own->can_id == raw->can_id && own->len == raw->len && memcmp(own->data, raw->data, raw->len) == 0) {
            own->can_id = CAN_ERR_FLAG;
            return true;
        }
    }
    return false;
}

static void take_error(hal_can_t *can, const socketcan_error_t *error)
{
    can->lost += error->overrun;
    if (!error->any_state)
        return;
    if (can->state == HAL_CAN_BUS_OFF && error->state != HAL_CAN_BUS_OFF)
        forget_own(can); /* the kernel has dropped what was queued */
    can->state = error->state;
}

/* @return Is what was heard for the caller? */
static bool take_heard(hal_can_t *can, uint32_t dropped_before, hal_can_frame_t *frame)
{
    const socketcan_heard_t *heard = &can->heard;
    const socketcan_error_t error = socketcan_frame_error(&heard->frame, heard->size);
    hal_can_frame_t found = {.own = heard->own};
    can->lost += heard->dropped - dropped_before;
    can->ask = can->ask || heard->dropped != dropped_before; /* an error frame may have been among them */
    take_error(can, &error);
    if (!socketcan_frame_unpack(&found, &heard->frame, heard->size) || (heard->own && !is_awaited(can, &heard->frame)))
        return false;
    const clock_pair_t now = clock_pair();
    found.time_us = socketcan_stamp_ns(&can->stamp, &heard->stamps, &now) / 1000;
    *frame = found;
    return true;
}

hal_status_t hal_can_receive(hal_can_t *can, hal_can_frame_t *frame)
{
    if (can->emptied)
        hear_of_link(can);
    can->emptied = false;
    for (int i = 0; i < PASSED; i++) {
        const uint32_t dropped_before = can->heard.dropped;
        const int failure = socketcan_socket_receive(can->socket, &can->heard);
        if (failure == 0 && take_heard(can, dropped_before, frame))
            return HAL_OK;
        if (failure == 0)
            continue;
        can->emptied = true;
        if (failure != EAGAIN)
            return HAL_IO;
        can->stamp.empty = clock_pair();
        break;
    }
    return can->usable ? HAL_EMPTY : HAL_IO;
}

hal_status_t hal_can_send(hal_can_t *can, const hal_can_frame_t *frame)
{
    struct canfd_frame raw;
    const size_t size = socketcan_frame_pack(&raw, frame, can->settings.fd);
    if (size == 0)
        return HAL_BAD_CALL;
    if (!can->usable || can->state == HAL_CAN_BUS_OFF)
        return HAL_IO;
    if (send(can->socket, &raw, size, MSG_DONTWAIT) != (ssize_t)size)
        return errno == ENOBUFS || errno == EAGAIN ? HAL_FULL : HAL_IO;
    if (frame->own)
        can->own[can->own_count++ % OWN] = raw;
    return HAL_OK;
}

uint32_t hal_can_lost(const hal_can_t *can)
{
    return can->lost;
}

hal_can_state_t hal_can_state(const hal_can_t *can)
{
    return can->state;
}

hal_status_t hal_can_restart(hal_can_t *can)
{
    if (can->state != HAL_CAN_BUS_OFF || can->link.restart_ms != 0)
        return HAL_OK;
    const int failure = socketcan_netlink_restart(&can->netlink, can->link.index);
    return failure == 0 || failure == EBUSY ? HAL_OK : HAL_IO;
}

/* Notices are heard of from before the question on, so that none is missed. */
static hal_status_t open_link(hal_can_t *can, char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *interface = can->settings.interface;
    socketcan_link_t link;
    int failure = socketcan_netlink_open(&can->netlink);
    if (failure == 0)
        failure = socketcan_netlink_ask(&can->netlink, interface, &link);
    if (failure == ENODEV)
        return board_error(error,
                           "can %s: no such interface, expected one of `ip link show type can`; is the controller's "
                           "device-tree overlay loaded?",
                           interface);
    if (failure != 0)
        return board_error(error, "can %s: the kernel does not tell of interfaces: %s", interface, strerror(failure));
    const hal_status_t status = socketcan_link_check(&link, &can->settings, can->may_restart, error);
    if (status != HAL_OK)
        return status;
    take_link(can, &link);
    if (!can->usable)
        return board_error(error, "can %s: went away while it was opened", interface);
    return HAL_OK;
}

hal_status_t can_socketcan_open(hal_can_t **can, const can_socketcan_settings_t *settings,
                                char error[HAL_BOARD_ERROR_LENGTH])
{
    const size_t length = strlen(settings->interface);
    if (length == 0 || length >= IFNAMSIZ)
        return board_error(error, "can \"%.40s\": expected the name of an interface, 1 to %d characters, as can0",
                           settings->interface, IFNAMSIZ - 1);
    hal_can_t *made = calloc(1, sizeof *made);
    if (made == NULL)
        return board_error(error, "can %s: out of memory", settings->interface);
    made->settings = *settings;
    made->socket = -1;
    made->emptied = true;
    made->may_restart = socketcan_netlink_may_restart();
    made->stamp.empty = clock_pair();
    hal_status_t status = socketcan_socket_open(&made->socket, settings, error);
    if (status == HAL_OK)
        status = open_link(made, error);
    if (status == HAL_OK)
        *can = made;
    else
        can_socketcan_close(made);
    return status;
}

void can_socketcan_close(hal_can_t *can)
{
    if (can == NULL)
        return;
    socketcan_netlink_close(&can->netlink);
    if (can->socket >= 0)
        close(can->socket);
    free(can);
}
