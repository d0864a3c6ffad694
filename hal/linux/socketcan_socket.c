// SPDX-License-Identifier: Apache-2.0
// A raw CAN socket: made, bound, and read with everything that the kernel tells of a frame.
#include "hal/linux/socketcan_socket.h"

#include <errno.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <linux/errqueue.h> /* after <time.h>, which it needs */

#include "hal/linux/board_error.h"

enum { QUEUE_FRAMES = 256, FRAME_BYTES = 1024 /* at most, with all that the kernel keeps of one */ };

static bool set(int can, int level, int option, int value)
{
    return setsockopt(can, level, option, &value, sizeof value) == 0;
}

/* The kernel forgets the filter of data frames with the interface that the socket was bound to. */
static bool set_filters(int can)
{
    const struct can_filter no_remote = {.can_id = 0, .can_mask = CAN_RTR_FLAG};
    const can_err_mask_t states = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL;
    return setsockopt(can, SOL_CAN_RAW, CAN_RAW_FILTER, &no_remote, sizeof no_remote) == 0 &&
           setsockopt(can, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &states, sizeof states) == 0;
}

/* The kernel doubles what it is asked for, and gives no more than net.core.rmem_max. */
static bool set_queue(int can)
{
    int bytes = 0;
    socklen_t length = sizeof bytes;
    return set(can, SOL_SOCKET, SO_RCVBUF, QUEUE_FRAMES * FRAME_BYTES) &&
           getsockopt(can, SOL_SOCKET, SO_RCVBUF, &bytes, &length) == 0 && bytes >= QUEUE_FRAMES * FRAME_BYTES;
}

static bool set_stamps(int can)
{
    return set(can, SOL_SOCKET, SO_TIMESTAMPING,
               SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE | SOF_TIMESTAMPING_RX_HARDWARE |
                   SOF_TIMESTAMPING_RAW_HARDWARE);
}

hal_status_t socketcan_socket_open(int *made, const can_socketcan_settings_t *settings,
                                   char error[HAL_BOARD_ERROR_LENGTH])
{
    const int can = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
    hal_status_t status = HAL_OK;
    if (can < 0)
        return board_error(error, "can %s: this kernel has no CAN sockets (%s): `modprobe can-raw`",
                           settings->interface, strerror(errno));
    if (!set(can, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, 1) || !set(can, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, settings->fd) ||
        !set(can, SOL_SOCKET, SO_RXQ_OVFL, 1) || !set_stamps(can))
        status =
            board_error(error,
                        "can %s: this kernel's CAN sockets refuse an option (%s), expected CAN FD, own frames, time "
                        "stamps and counts of lost frames: use a newer kernel",
                        settings->interface, strerror(errno));
    else if (!set_queue(can))
        status = board_error(error, "can %s: no room for %d received frames: `sysctl net.core.rmem_max=%d`",
                             settings->interface, QUEUE_FRAMES, QUEUE_FRAMES * FRAME_BYTES);
    if (status != HAL_OK)
        close(can);
    else
        *made = can;
    return status;
}

int socketcan_socket_bind(int socket, int32_t index)
{
    const struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = index};
    return set_filters(socket) && bind(socket, (const struct sockaddr *)&address, sizeof address) == 0 ? 0 : errno;
}

static int64_t ns_of(const struct timespec *time)
{
    return (int64_t)time->tv_sec * 1000000000 + time->tv_nsec;
}

static void take_note(socketcan_heard_t *heard, const struct cmsghdr *note)
{
    if (note->cmsg_level != SOL_SOCKET)
        return;
    if (note->cmsg_type == SO_RXQ_OVFL) {
        memcpy(&heard->dropped, CMSG_DATA(note), sizeof heard->dropped);
    } else if (note->cmsg_type == SO_TIMESTAMPING) {
        struct scm_timestamping times;
        memcpy(&times, CMSG_DATA(note), sizeof times);
        heard->stamps = (socketcan_stamps_t){.kernel_ns = ns_of(&times.ts[0]), .controller_ns = ns_of(&times.ts[2])};
    }
}

int socketcan_socket_receive(int socket, socketcan_heard_t *heard)
{
    socketcan_heard_t got = {.dropped = heard->dropped};
    _Alignas(struct cmsghdr) char notes[CMSG_SPACE(sizeof(struct scm_timestamping)) + CMSG_SPACE(sizeof(uint32_t))];
    struct iovec bytes = {.iov_base = &got.frame, .iov_len = sizeof got.frame};
    struct msghdr message = {.msg_iov = &bytes, .msg_iovlen = 1, .msg_control = notes, .msg_controllen = sizeof notes};
    const ssize_t size = recvmsg(socket, &message, MSG_DONTWAIT);
    if (size < 0)
        return errno;
    got.size = (size_t)size;
    got.own = (message.msg_flags & MSG_CONFIRM) != 0;
    for (struct cmsghdr *note = CMSG_FIRSTHDR(&message); note != NULL; note = CMSG_NXTHDR(&message, note))
        take_note(&got, note);
    *heard = got;
    return 0;
}
