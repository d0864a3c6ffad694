// SPDX-License-Identifier: Apache-2.0
// The smallest sender of poses: walks round the room once, 240 poses a second. Needs nothing but Linux; take it and
// change it.
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

enum { VIEWER = 0, TRACKED = 1, POSES_PER_S = 240, WALK_S = 10, FD_ID = 0x100 + VIEWER, SET_ID = 0x110 + 4 * VIEWER };

typedef struct {
    double mm[3]; /* the eye, in the tracker's world */
    double q[4];  /* w, x, y, z: turns camera axes (x right, y down, z forward) into the world's; of length 1 */
    uint64_t capture_us;
} pose_t;

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
    for (int i = 0; i < 3; i++) {
        frame[i].can_id = (canid_t)(SET_ID + i);
        frame[i].len = 8;
        frame[i].data[1] = (uint8_t)(number % 15 | (uint32_t)nibble[i] << 4);
        frame[i].data[0] = crc_of_classic(SET_ID + i, frame[i].data);
    }
}

/* Once round a circle of 1.5 m in ten seconds, looking at its middle; y is down. */
static pose_t walk(double seconds, uint64_t now_us)
{
    const double turn = 2 * M_PI * seconds / WALK_S;
    return (pose_t){.mm = {1500 * sin(turn), -1700, -1500 * cos(turn)},
                    .q = {cos(turn / 2), 0, -sin(turn / 2), 0},
                    .capture_us = now_us};
}

static uint64_t now_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
}

static int open_can(const char *interface)
{
    const int can = socket(PF_CAN, SOCK_RAW, CAN_RAW), on = 1;
    const struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = (int)if_nametoindex(interface)};
    if (can < 0 || address.can_ifindex == 0 || setsockopt(can, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) != 0 ||
        bind(can, (const struct sockaddr *)&address, sizeof address) != 0)
        return -1;
    return can;
}

static void print(const struct canfd_frame *frame, bool fd, uint64_t time_us)
{
    printf("(%llu.%06llu) can0 %03X#%s", (unsigned long long)(time_us / 1000000),
           (unsigned long long)(time_us % 1000000), (unsigned)frame->can_id, fd ? "#1" : "");
    for (int i = 0; i < frame->len; i++)
        printf("%02X", (unsigned)frame->data[i]);
    printf("\n");
}

int main(int argc, char **argv)
{
    const bool fd = argc<3, dry = argc> 1 && strcmp(argv[1], "-") == 0;
    const int can = argc > 1 && !dry ? open_can(argv[1]) : -1;
    if (argc < 2 || argc > 3 || (!fd && strcmp(argv[2], "classic") != 0) || (!dry && can < 0)) {
        fprintf(stderr, "usage: send_pose INTERFACE [classic]: %s\n", errno ? strerror(errno) : "an argument is wrong");
        return 1;
    }
    const uint64_t start_us = dry ? 1000000 : now_us();
    const uint32_t poses = dry ? POSES_PER_S : POSES_PER_S * WALK_S;
    for (uint32_t n = 0; n < poses; n++) {
        const uint64_t due_us = start_us + n * 1000000ULL / POSES_PER_S;
        while (!dry && now_us() < due_us)
            usleep(200);
        const pose_t pose = walk((double)n / POSES_PER_S, dry ? due_us : now_us());
        struct canfd_frame frame[3];
        if (fd)
            frame[0] = fd_frame(&pose, n);
        else
            classic_frames(frame, &pose, n);
        for (int i = 0; i < (fd ? 1 : 3); i++) {
            const size_t size = fd ? CANFD_MTU : CAN_MTU;
            if (dry)
                print(&frame[i], fd, due_us);
            else if (write(can, &frame[i], size) != (ssize_t)size)
                fprintf(stderr, "send_pose: %s\n", strerror(errno));
        }
    }
    return 0;
}
