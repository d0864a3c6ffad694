// SPDX-License-Identifier: Apache-2.0
// FreeD: the camera position message D1 -> pose.
#include "sim/trackers/freed.h"

#include "sim/trackers/packet_bytes.h"
#include "sim/trackers/tracker_rotation.h"

enum { TYPE_D1 = 0xD1, SUM_OF_ALL = 0x40 };

static double degrees_at(const uint8_t *bytes)
{
    return packet_be24_signed(bytes) / 32768.0;
}

tracker_check_t freed_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size)
{
    if (size == 0)
        return TRACKER_LENGTH;
    if (bytes[0] != TYPE_D1)
        return TRACKER_OTHER;
    if (size != FREED_D1_LENGTH)
        return TRACKER_LENGTH;
    uint8_t sum = 0;
    for (size_t i = 0; i < size; i++)
        sum = (uint8_t)(sum + bytes[i]);
    if (sum != SUM_OF_ALL)
        return TRACKER_CHECKSUM;

    tracker_pose_t pose = {.id = bytes[1], .quality = CAN_POSE_TRACKED};
    const double degrees[3] = {-degrees_at(bytes + 2), degrees_at(bytes + 5), degrees_at(bytes + 8)};
    tracker_rotation_from_angles(pose.quaternion, "zxy", degrees);
    for (int i = 0; i < 3; i++)
        pose.position[i] = packet_be24_signed(bytes + 11 + 3 * i) / 64.0;
    tracker_packet_add(packet, &pose);
    return TRACKER_OK;
}
