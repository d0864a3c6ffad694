// SPDX-License-Identifier: Apache-2.0
// The smallest sender of poses and bus time, to take and change: walks round the room once. Needs nothing but Linux.
//
// Build: cc -o send_pose send_pose.c -lm
// Use:   send_pose can0           CAN FD, one frame of 32 bytes a pose
//        send_pose can0 classic   three classic frames a pose
//        send_pose - [classic]    print the frames of one second as candump writes them, and send nothing
// Every number here is explained in firmware/BUS.md, and by firmware/wallwarp.dbc.
#define _GNU_SOURCE
#include <errno.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <math.h>
#include <net/if.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { VIEWER = 0, TRACKED = 1, POSES_PER_S = 240, WALK_S = 10, SYNC_US = 125000 };
enum { SYNC_ID = 0x040, FOLLOW_UP_ID = 0x080, FD_ID = 0x100 + VIEWER, SET_ID = 0x110 + 4 * VIEWER };

typedef struct {
    double mm[3];        /* the eye, in the tracker's world */
    double q[4];         /* w, x, y, z: turns camera axes (x right, y down, z forward) into the world's; of length 1 */
    uint64_t capture_us; /* bus time, which here is CLOCK_MONOTONIC */
} pose_t;

typedef struct {
    int can; /* -1: print */
    uint32_t syncs;
    uint64_t sync_due_us;
} sender_t;

static void put(uint8_t *to, int bytes, int64_t value)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (uint8_t)(value >> 8 * i);
}

/* AUTOSAR E2E profile 5: CRC-16 over bytes 2 to 31 and the data id, which is the identifier. */
static uint16_t crc_of_fd(const uint8_t data[32])
{
    const uint8_t id[2] = {FD_ID & 0xFF, FD_ID >> 8};
    uint16_t crc = 0xFFFF;
    for (int i = 2; i < 34; i++) {
        crc ^= (uint16_t)((i < 32 ? data[i] : id[i - 32]) << 8);
        for (int bit = 0; bit < 8; bit++)
            crc = (uint16_t)(crc << 1 ^ (crc & 0x8000 ? 0x1021 : 0));
    }
    return crc;
}

/* AUTOSAR E2E profile 1A: CRC-8 over the data id, low byte first, and bytes 1 to 7. */
static uint8_t crc_of_classic(int id, const uint8_t data[8])
{
    uint8_t crc = 0;
    for (int i = -2; i < 7; i++) {
        crc ^= i < 0 ? (uint8_t)(id >> 8 * (i + 2)) : data[i + 1];
        for (int bit = 0; bit < 8; bit++)
            crc = (uint8_t)(crc << 1 ^ (crc & 0x80 ? 0x1D : 0));
    }
    return crc;
}

static struct canfd_frame fd_frame(const pose_t *pose, uint32_t number)
{
    struct canfd_frame frame = {.can_id = FD_ID, .len = 32, .flags = CANFD_BRS};
    frame.data[2] = (uint8_t)number;
    frame.data[3] = TRACKED;
    for (int i = 0; i < 3; i++)
        put(frame.data + 4 + 4 * i, 4, llround(pose->mm[i] * 1000));
    for (int i = 0; i < 4; i++)
        put(frame.data + 16 + 3 * i, 3, llround(pose->q[i] * 4194304));
    put(frame.data + 28, 4, (int64_t)pose->capture_us);
    put(frame.data, 2, crc_of_fd(frame.data));
    return frame;
}

/* The last step of a classic frame: its counter with the 4 bits above it, and its CRC. */
static void seal(struct canfd_frame *frame, int id, uint32_t number, int nibble)
{
    frame->can_id = (canid_t)id;
    frame->len = 8;
    frame->data[1] = (uint8_t)(number % 15 | (uint32_t)nibble << 4);
    frame->data[0] = crc_of_classic(id, frame->data);
}

static int64_t q15(double component)
{
    const int64_t value = llround(component * 32768);
    return value > 32767 ? 32767 : value;
}

static void classic_frames(struct canfd_frame frame[3], const pose_t *pose, uint32_t number)
{
    const int64_t time = (int64_t)(pose->capture_us / 100); /* 16 bits of 100 us, in two pieces */
    const int nibble[3] = {TRACKED, (int)(time & 0xF), (int)(time >> 12 & 0xF)};
    memset(frame, 0, 3 * sizeof frame[0]);
    put(frame[0].data + 2, 3, llround(pose->mm[0] * 100));
    put(frame[0].data + 5, 3, llround(pose->mm[1] * 100));
    put(frame[1].data + 2, 1, time >> 4);
    put(frame[1].data + 3, 3, llround(pose->mm[2] * 100));
    put(frame[1].data + 6, 2, q15(pose->q[0]));
    for (int i = 0; i < 3; i++)
        put(frame[2].data + 2 + 2 * i, 2, q15(pose->q[1 + i]));
    for (int i = 0; i < 3; i++)
        seal(&frame[i], SET_ID + i, number, nibble[i]);
}

/* Once round a circle of 1.5 m in ten seconds, looking at its middle; y is down. */
static pose_t walk(double seconds, uint64_t capture_us)
{
    const double turn = 2 * M_PI * seconds / WALK_S;
    return (pose_t){.mm = {1500 * sin(turn), -1700, -1500 * cos(turn)},
                    .q = {cos(turn / 2), 0, -sin(turn / 2), 0},
                    .capture_us = capture_us};
}

static uint64_t now_us(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
}

/* Only Sync is heard on this socket: its own, handed back with the kernel's stamp once the controller has sent it. */
static int open_can(const char *interface)
{
    const int can = socket(PF_CAN, SOCK_RAW, CAN_RAW), on = 1;
    const struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = (int)if_nametoindex(interface)};
    const struct can_filter sync = {.can_id = SYNC_ID, .can_mask = CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG};
    if (can < 0 || address.can_ifindex == 0 || setsockopt(can, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) != 0 ||
        setsockopt(can, SOL_CAN_RAW, CAN_RAW_FILTER, &sync, sizeof sync) != 0 ||
        setsockopt(can, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, &on, sizeof on) != 0 ||
        setsockopt(can, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) != 0 ||
        bind(can, (const struct sockaddr *)&address, sizeof address) != 0)
        return -1;
    return can;
}

/* time_us is only printed. */
static void send_frame(const sender_t *sender, const struct canfd_frame *frame, bool fd, uint64_t time_us)
{
    const size_t size = fd ? CANFD_MTU : CAN_MTU;
    if (sender->can >= 0 && write(sender->can, frame, size) != (ssize_t)size)
        fprintf(stderr, "send_pose: %s\n", strerror(errno));
    if (sender->can >= 0)
        return;
    printf("(%.6f) can0 %03X#%s", (double)time_us / 1e6, (unsigned)frame->can_id, fd ? "#1" : "");
    for (int i = 0; i < frame->len; i++)
        printf("%02X", (unsigned)frame->data[i]);
    printf("\n");
}

static void send_follow_up(const sender_t *sender, uint32_t number, uint64_t sent_us)
{
    struct canfd_frame follow_up = {.can_id = 0};
    put(follow_up.data + 2, 6, (int64_t)sent_us);
    seal(&follow_up, FOLLOW_UP_ID, number, 0);
    send_frame(sender, &follow_up, false, sent_us);
}

/* Tell the time of a Sync that is out. The stamp tells the moment of its last bit; a clock that is read before or after
 * write() is off by what the frame waits for the bus. It is on CLOCK_REALTIME, which may step: only its age is used. */
static void follow_sync(const sender_t *sender)
{
    struct canfd_frame sync;
    struct timespec stamp;
    _Alignas(struct cmsghdr) char control[CMSG_SPACE(sizeof stamp)];
    struct iovec to = {&sync, sizeof sync};
    struct msghdr got = {.msg_iov = &to, .msg_iovlen = 1, .msg_control = control, .msg_controllen = sizeof control};
    if (recvmsg(sender->can, &got, MSG_DONTWAIT) <= 0 || (got.msg_flags & MSG_CONFIRM) == 0)
        return; /* none, or another sender's */
    const struct cmsghdr *part = CMSG_FIRSTHDR(&got);
    if (part == NULL || part->cmsg_type != SCM_TIMESTAMPNS)
        return;
    memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    const uint64_t stamp_us = (uint64_t)stamp.tv_sec * 1000000 + (uint64_t)stamp.tv_nsec / 1000;
    send_follow_up(sender, sync.data[1], now_us(CLOCK_MONOTONIC) - (now_us(CLOCK_REALTIME) - stamp_us));
}

/* Sync says nothing but its counter and, by zeros, that bus time is a tracker's. */
static void give_time(sender_t *sender, uint64_t time_us)
{
    struct canfd_frame sync = {.can_id = 0};
    if (sender->can >= 0)
        follow_sync(sender);
    if (time_us < sender->sync_due_us)
        return;
    sender->sync_due_us = time_us + SYNC_US;
    seal(&sync, SYNC_ID, sender->syncs, 0);
    send_frame(sender, &sync, false, time_us);
    if (sender->can < 0)
        send_follow_up(sender, sender->syncs, time_us);
    sender->syncs++;
}

int main(int argc, char **argv)
{
    const bool fd = argc<3, dry = argc> 1 && strcmp(argv[1], "-") == 0;
    sender_t sender = {.can = argc > 1 && !dry ? open_can(argv[1]) : -1};
    if (argc < 2 || argc > 3 || (!fd && strcmp(argv[2], "classic") != 0) || (!dry && sender.can < 0)) {
        fprintf(stderr, "usage: send_pose INTERFACE [classic]: %s\n", errno ? strerror(errno) : "an argument is wrong");
        return 1;
    }
    const uint64_t start_us = dry ? 1000000 : now_us(CLOCK_MONOTONIC);
    const uint32_t poses = dry ? POSES_PER_S : POSES_PER_S * WALK_S;
    for (uint32_t n = 0; n < poses; n++) {
        const uint64_t due_us = start_us + n * 1000000ULL / POSES_PER_S;
        uint64_t time_us;
        do {
            time_us = dry ? due_us : now_us(CLOCK_MONOTONIC);
            give_time(&sender, time_us);
        } while (time_us < due_us && usleep(200) == 0);
        const pose_t pose = walk((double)n / POSES_PER_S, time_us);
        struct canfd_frame frame[3];
        if (fd)
            frame[0] = fd_frame(&pose, n);
        else
            classic_frames(frame, &pose, n);
        for (int i = 0; i < (fd ? 1 : 3); i++)
            send_frame(&sender, &frame[i], fd, time_us);
    }
    return 0;
}
