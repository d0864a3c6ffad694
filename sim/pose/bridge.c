// SPDX-License-Identifier: Apache-2.0
// A tracker's packets -> pose messages for the bus: decoded, moved into the room, with their times and counts.
#include "sim/pose/bridge.h"

#include <inttypes.h>
#include <string.h>

void bridge_init(bridge_t *bridge, const tracker_protocol_t *protocol, const tracker_transform_t *transform)
{
    memset(bridge, 0, sizeof *bridge);
    bridge->protocol = protocol;
    bridge->transform = *transform;
}

/* Late, or a repetition? After a jump back of more than a second it is neither: the tracker's clock has been set. */
static bool is_old(bridge_newest_t *newest, const tracker_pose_t *pose)
{
    const int64_t since_us = pose->time_us - newest->time_us;
    if (newest->any && since_us <= 0 && since_us >= -TRACKER_CLOCK_JUMP_US)
        return true;
    *newest = (bridge_newest_t){.any = true, .time_us = pose->time_us};
    return false;
}

static bool make_message(bridge_t *bridge, const tracker_viewer_t *viewer, const tracker_pose_t *pose,
                         can_pose_t *message)
{
    message->viewer = viewer->viewer;
    message->tracker = bridge->transform.tracker;
    message->quality = pose->quality;
    if (pose->quality == CAN_POSE_LOST) {
        message->pose = (pose_t){.quaternion_q30 = {1 << 30, 0, 0, 0}};
        return true;
    }
    return tracker_transform_apply(&bridge->transform, viewer, bridge->protocol->unit_mm, pose, &message->pose);
}

int bridge_packet(bridge_t *bridge, const uint8_t *bytes, size_t size, int64_t arrived_us,
                  can_pose_t message[TRACKER_MAX_POSES])
{
    tracker_packet_t *packet = &bridge->packet;
    bridge_counts_t *counts = &bridge->counts;
    memset(packet, 0, sizeof *packet);
    counts->packets++;
    const tracker_check_t check = bridge->protocol->decode(&bridge->memory, packet, bytes, size);
    if (check != TRACKER_OK) {
        counts->refused[check]++;
        return 0;
    }
    for (int c = 0; c < TRACKER_CHECKS; c++)
        counts->refused[c] += packet->left_out[c];
    int made = 0;
    for (int i = 0; i < packet->count; i++) {
        const tracker_pose_t *pose = &packet->pose[i];
        const tracker_viewer_t *viewer = tracker_transform_viewer(&bridge->transform, pose->id);
        if (viewer == NULL) {
            counts->others++;
            continue;
        }
        if (pose->timed && is_old(&bridge->newest[viewer->viewer], pose)) {
            counts->refused[TRACKER_REPEATED]++;
            continue;
        }
        const int64_t captured_us =
            (pose->timed ? tracker_clock_local_us(&bridge->clock, pose->time_us, arrived_us) : arrived_us) -
            bridge->transform.latency_us;
        message[made] = (can_pose_t){.capture_time_us = captured_us < 0 ? 0 : (uint64_t)captured_us};
        if (make_message(bridge, viewer, pose, &message[made]))
            made++;
        else
            counts->too_far++;
    }
    counts->poses += (uint64_t)made;
    return made;
}

static void print_count(FILE *file, const char *what, uint64_t count)
{
    if (count > 0)
        fprintf(file, "%s: %" PRIu64 "\n", what, count);
}

void bridge_counts_print(FILE *file, const bridge_counts_t *counts)
{
    for (int c = 0; c < TRACKER_CHECKS; c++)
        print_count(file, tracker_check_text[c], counts->refused[c]);
    print_count(file, "bodies that no viewer wears", counts->others);
    print_count(file, "too far away", counts->too_far);
}
