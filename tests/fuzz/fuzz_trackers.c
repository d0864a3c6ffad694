// SPDX-License-Identifier: Apache-2.0
// Fuzzes the trackers' protocols through the bridge: whatever comes, each pose that goes out is one.
//
// Input: a byte that chooses the protocol (its low bits) and asks for checksums to be made right (its highest bit); two
// bytes, the first packet's length; the first packet, and the second.
#include "sim/pose/bridge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/input.h"
#include "tests/support/tracker_packets.h"

enum { MEND = 0x80, PROTOCOLS_MASK = 0x7F, ARRIVED_US = 1000000, APART_US = 4000 };

/* Bodies 0 and 1, mirrored axes, an eye beside the body. */
static const tracker_transform_t transform = {
    .room_axis = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
    .origin_mm = {100, 200, 300},
    .latency_us = 2000,
    .viewers = 2,
    .viewer = {{.body = 0, .viewer = 0, .eye_mm = {10, 20, 30}, .camera_axis = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}},
               {.body = 1, .viewer = 3, .camera_axis = {{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}}}},
};

static void check_pose(const can_pose_t *message, int64_t arrived_us)
{
    hal_can_frame_t frame;
    double length = 0.0;
    for (int i = 0; i < 4; i++)
        length = hypot(length, message->pose.quaternion_q30[i] / 1073741824.0);
    fuzz_check(fabs(length - 1.0) < 1e-6, "the quaternion is of unit length");
    for (int i = 0; i < 3; i++)
        fuzz_check(llabs(message->pose.eye_nm[i]) <= INT64_C(1000000000000), "the eye is within 1000 m");
    fuzz_check(message->viewer == 0 || message->viewer == 3, "the viewer is one of the file's");
    fuzz_check(message->capture_time_us <= (uint64_t)arrived_us - 2000, "nothing is captured after it has come");
    fuzz_check(can_pose_fd_encode(&frame, message), "the message carries it");
}

static void check_source(const char *protocol, const uint8_t *bytes, size_t size)
{
    if (strcmp(protocol, "freed") == 0) {
        uint8_t sum = 0;
        for (size_t i = 0; i < size; i++)
            sum = (uint8_t)(sum + bytes[i]);
        fuzz_check(size == 29 && bytes[0] == 0xD1 && sum == 0x40, "a pose comes from a sound D1");
    } else if (strcmp(protocol, "opentrackio") == 0) {
        fuzz_check(size > 16 && memcmp(bytes, "OTrk", 4) == 0, "a pose comes from a packet of OpenTrackIO");
    }
}

static void feed(bridge_t *bridge, const uint8_t *bytes, size_t size, bool mend, int64_t arrived_us)
{
    static can_pose_t message[TRACKER_MAX_POSES];
    uint8_t *copy = malloc(size + 1); /* of its own size: a byte too far is seen */
    fuzz_check(copy != NULL, "memory for the packet");
    uint8_t *packet = copy + 1;
    if (size > 0)
        memcpy(packet, bytes, size);
    if (mend && size > 0 && strcmp(bridge->protocol->name, "freed") == 0)
        tracker_bytes_mend_freed(packet, size);
    if (mend && size >= 16 && strcmp(bridge->protocol->name, "opentrackio") == 0)
        tracker_bytes_mend_opentrackio(packet, size);
    const uint64_t packets = bridge->counts.packets;
    const int made = bridge_packet(bridge, packet, size, arrived_us, message);
    fuzz_check(bridge->counts.packets == packets + 1, "packets are counted");
    fuzz_check(bridge->counts.refused[TRACKER_OK] == 0, "what is refused has a reason");
    fuzz_check(made >= 0 && made <= TRACKER_MAX_POSES, "there is room for the poses");
    for (int i = 0; i < made; i++)
        check_pose(&message[i], arrived_us);
    if (made > 0)
        check_source(bridge->protocol->name, packet, size);
    free(copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static bridge_t bridge;
    input_t input = {data, size};
    const uint8_t kind = input_byte(&input);
    const size_t asked = input_bits(&input, 2);
    const size_t first = asked < input.left ? asked : input.left;
    bridge_init(&bridge, &tracker_protocols[(kind & PROTOCOLS_MASK) % TRACKER_PROTOCOLS], &transform);
    feed(&bridge, input.bytes, first, (kind & MEND) != 0, ARRIVED_US);
    feed(&bridge, input.bytes + first, input.left - first, (kind & MEND) != 0, ARRIVED_US + APART_US);
    return 0;
}
