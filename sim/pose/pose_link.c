// SPDX-License-Identifier: Apache-2.0
// Opens either kind of link; sends and hears over SocketCAN.
#include "sim/pose/pose_link.h"

#include <errno.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "sim/devices/sim_clock.h"
#include "sim/pose/kernel_stamp.h"
#include "sim/pose/pose_link_socketcand.h"

enum { CONGESTION_MS = 1000 };

static bool fail(char error[POSE_LINK_MESSAGE_LENGTH], const char *interface, const char *what, const char *advice)
{
    snprintf(error, POSE_LINK_MESSAGE_LENGTH, "%.16s: %.90s; %.120s", interface, what, advice);
    return false;
}

/* The remedy is to bring the interface up; fd_rate is "" or says how with FD. */
static bool fail_until_up(char error[POSE_LINK_MESSAGE_LENGTH], const char *interface, const char *what,
                          const char *fd_rate)
{
    snprintf(error, POSE_LINK_MESSAGE_LENGTH, "%.16s: %.90s; try `ip link set %.16s up type can bitrate 500000%s`",
             interface, what, interface, fd_rate);
    return false;
}

/* The interface exists, is CAN, is up, and carries FD when that is wanted. */
static bool check_interface(int can, const char *name, bool fd, char error[POSE_LINK_MESSAGE_LENGTH])
{
    struct ifreq request = {.ifr_ifindex = 0};
    strncpy(request.ifr_name, name, sizeof request.ifr_name - 1);
    if (ioctl(can, SIOCGIFMTU, &request) != 0)
        return fail(error, name, "no such interface", "see `ip link`; a simulator is given as HOST:PORT");
    if (request.ifr_mtu != CAN_MTU && request.ifr_mtu != CANFD_MTU)
        return fail(error, name, "not a CAN interface", "see `ip link show type can`");
    if (fd && request.ifr_mtu != CANFD_MTU)
        return fail_until_up(error, name, "carries no CAN FD", " dbitrate 2000000 fd on");
    if (ioctl(can, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0)
        return fail_until_up(error, name, "is down", "");
    return true;
}

static bool bind_interface(int can, const char *name, bool fd)
{
    /* An empty filter: nothing is received, so nothing piles up. */
    const int on = 1;
    const struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = (int)if_nametoindex(name)};
    return setsockopt(can, SOL_CAN_RAW, CAN_RAW_FILTER, NULL, 0) == 0 &&
           (!fd || setsockopt(can, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) == 0) &&
           bind(can, (const struct sockaddr *)&address, sizeof address) == 0;
}

static bool open_interface(pose_link_t *link, const char *name, bool fd, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const int can = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
    if (can < 0)
        return fail_until_up(error, name, "no CAN in this kernel, `modprobe can_raw`; a simulator is HOST:PORT", "");
    if (!check_interface(can, name, fd, error)) {
        close(can);
        return false;
    }
    if (!bind_interface(can, name, fd)) {
        fail_until_up(error, name, strerror(errno), "");
        close(can);
        return false;
    }
    *link = (pose_link_t){.socket = can};
    snprintf(link->name, sizeof link->name, "%s", name);
    return true;
}

bool pose_link_check(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH])
{
    if (strchr(bus, ':') != NULL)
        return pose_link_socketcand_check(bus, error);
    if (strlen(bus) == 0 || strlen(bus) >= IFNAMSIZ)
        return fail(error, bus, "not the name of an interface", "expected one like can0, or HOST:PORT");
    return true;
}

bool pose_link_open(pose_link_t *link, const char *bus, bool fd, char error[POSE_LINK_MESSAGE_LENGTH])
{
    if (!pose_link_check(bus, error))
        return false;
    if (strchr(bus, ':') == NULL)
        return open_interface(link, bus, fd, error);
    if (fd) {
        snprintf(error, POSE_LINK_MESSAGE_LENGTH,
                 "%.60s: socketcand carries classic frames only; leave --fd out, or give a CAN FD interface", bus);
        return false;
    }
    const int socket = pose_link_socketcand_open(bus, error);
    if (socket < 0)
        return false;
    *link = (pose_link_t){.socket = socket, .socketcand = true};
    snprintf(link->name, sizeof link->name, "%.63s", bus);
    return true;
}

static bool send_interface(const pose_link_t *link, const hal_can_frame_t *frame, char error[POSE_LINK_MESSAGE_LENGTH])
{
    struct canfd_frame raw = {.can_id = frame->extended ? frame->id | CAN_EFF_FLAG : frame->id, .len = frame->length};
    if (frame->fd && frame->bit_rate_switch)
        raw.flags = CANFD_BRS;
    memcpy(raw.data, frame->data, frame->length);
    const size_t size = frame->fd ? CANFD_MTU : CAN_MTU;
    for (int waited_ms = 0; waited_ms < CONGESTION_MS; waited_ms++) {
        if (write(link->socket, &raw, size) == (ssize_t)size)
            return true;
        if (errno != ENOBUFS && errno != EINTR)
            return fail_until_up(error, link->name, strerror(errno), "");
        poll(NULL, 0, 1); /* a full queue of the interface does not show in poll() on its socket */
    }
    return fail(error, link->name, "nothing gets onto the bus",
                "is another node there, powered, with the same bit rate, and the bus terminated?");
}

bool pose_link_send(pose_link_t *link, const hal_can_frame_t *frame, int count, char error[POSE_LINK_MESSAGE_LENGTH])
{
    if (link->socketcand)
        return pose_link_socketcand_send(link, frame, count, error);
    for (int i = 0; i < count; i++)
        if (!send_interface(link, &frame[i], error))
            return false;
    return true;
}

bool pose_link_time(pose_link_t *link, uint32_t id, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const int on = 1;
    const struct can_filter own = {.can_id = id, .can_mask = CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG};
    if (link->socketcand)
        return true;
    if (setsockopt(link->socket, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) != 0 ||
        setsockopt(link->socket, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, &on, sizeof on) != 0 ||
        setsockopt(link->socket, SOL_CAN_RAW, CAN_RAW_FILTER, &own, sizeof own) != 0)
        return fail_until_up(error, link->name, strerror(errno), "");
    link->timing = true;
    return true;
}

/* The frame as the controller has sent it, with the kernel's stamp; not one like it of another sender, or an older one.
 * @return -1 when that is not what has come. */
static int64_t take_own_us(const pose_link_t *link, const hal_can_frame_t *frame)
{
    struct can_frame raw;
    _Alignas(struct cmsghdr) char control[KERNEL_STAMP_BYTES];
    struct iovec part = {&raw, sizeof raw};
    struct msghdr message = {
        .msg_iov = &part, .msg_iovlen = 1, .msg_control = control, .msg_controllen = sizeof control};
    if (recvmsg(link->socket, &message, MSG_DONTWAIT) != (ssize_t)sizeof raw ||
        (message.msg_flags & MSG_CONFIRM) == 0 || raw.can_dlc != frame->length ||
        memcmp(raw.data, frame->data, frame->length) != 0)
        return -1;
    return kernel_stamp_us(&message);
}

bool pose_link_send_timed(pose_link_t *link, const hal_can_frame_t *frame, int64_t *time_us,
                          char error[POSE_LINK_MESSAGE_LENGTH])
{
    if (!pose_link_send(link, frame, 1, error))
        return false;
    const int64_t sent_us = sim_clock_monotonic_us();
    int64_t left_ms = POSE_LINK_OUT_MS;
    *time_us = link->timing ? -1 : sent_us;
    while (*time_us < 0 && left_ms > 0) {
        struct pollfd can = {.fd = link->socket, .events = POLLIN};
        if (poll(&can, 1, (int)left_ms) > 0)
            *time_us = take_own_us(link, frame);
        left_ms = POSE_LINK_OUT_MS - (sim_clock_monotonic_us() - sent_us) / 1000;
    }
    return true;
}

bool pose_link_listen(pose_link_t *link, char error[POSE_LINK_MESSAGE_LENGTH])
{
    link->listening = true;
    if (link->socketcand)
        return true;
    const int on = 1;
    const struct can_filter everything = {.can_id = 0, .can_mask = 0};
    const can_err_mask_t errors = CAN_ERR_MASK;
    if (setsockopt(link->socket, SOL_SOCKET, SO_TIMESTAMP, &on, sizeof on) == 0 &&
        setsockopt(link->socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) == 0 &&
        setsockopt(link->socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors) == 0 &&
        setsockopt(link->socket, SOL_CAN_RAW, CAN_RAW_FILTER, &everything, sizeof everything) == 0)
        return true;
    return fail_until_up(error, link->name, strerror(errno), "");
}

/* The kernel's stamp of a received frame. */
static int64_t stamp_us(struct msghdr *message)
{
    for (struct cmsghdr *part = CMSG_FIRSTHDR(message); part != NULL; part = CMSG_NXTHDR(message, part)) {
        struct timeval stamp;
        if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SO_TIMESTAMP)
            continue;
        memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
        return (int64_t)stamp.tv_sec * 1000000 + stamp.tv_usec;
    }
    return 0;
}

static pose_link_heard_t receive_interface(const pose_link_t *link, hal_can_frame_t *frame, int wait_ms,
                                           char error[POSE_LINK_MESSAGE_LENGTH])
{
    struct canfd_frame raw;
    union {
        struct cmsghdr align;
        char bytes[CMSG_SPACE(sizeof(struct timeval))];
    } control;
    struct iovec part = {&raw, sizeof raw};
    struct pollfd can = {.fd = link->socket, .events = POLLIN};
    for (;;) {
        struct msghdr message = {
            .msg_iov = &part, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof control};
        if (poll(&can, 1, wait_ms) <= 0)
            return POSE_LINK_QUIET;
        const ssize_t got = recvmsg(link->socket, &message, MSG_DONTWAIT);
        if (got != (ssize_t)CAN_MTU && got != (ssize_t)CANFD_MTU) {
            if (got < 0 && (errno == EAGAIN || errno == EINTR))
                continue;
            fail_until_up(error, link->name, got < 0 ? strerror(errno) : "a frame of an unknown kind", "");
            return POSE_LINK_ENDED;
        }
        *frame = (hal_can_frame_t){.time_us = stamp_us(&message)};
        if ((raw.can_id & CAN_ERR_FLAG) != 0)
            return POSE_LINK_ERROR;
        if ((raw.can_id & CAN_RTR_FLAG) != 0)
            continue;
        frame->extended = (raw.can_id & CAN_EFF_FLAG) != 0;
        frame->id = raw.can_id & (frame->extended ? CAN_EFF_MASK : CAN_SFF_MASK);
        frame->fd = got == (ssize_t)CANFD_MTU;
        frame->bit_rate_switch = frame->fd && (raw.flags & CANFD_BRS) != 0;
        frame->length = raw.len;
        memcpy(frame->data, raw.data, raw.len);
        return POSE_LINK_FRAME;
    }
}

pose_link_heard_t pose_link_receive(pose_link_t *link, hal_can_frame_t *frame, int wait_ms,
                                    char error[POSE_LINK_MESSAGE_LENGTH])
{
    return link->socketcand ? pose_link_socketcand_receive(link, frame, wait_ms, error)
                            : receive_interface(link, frame, wait_ms, error);
}

void pose_link_close(pose_link_t *link)
{
    if (link->socketcand)
        pose_link_socketcand_finish(link);
    close(link->socket);
    link->socket = -1;
}
