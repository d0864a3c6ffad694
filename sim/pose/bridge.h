// SPDX-License-Identifier: Apache-2.0
// A tracker's packets -> pose messages for the bus: decoded, moved into the room, with their times and counts.
#ifndef SIM_POSE_BRIDGE_H
#define SIM_POSE_BRIDGE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "sim/trackers/protocols.h"
#include "sim/trackers/tracker_clock.h"
#include "sim/trackers/transform.h"

/** What a bridge has seen. */
typedef struct {
    uint64_t packets;
    uint64_t poses;                   /**< made for viewers */
    uint64_t others;                  /**< poses of bodies that no viewer wears */
    uint64_t too_far;                 /**< poses farther away than can be said */
    uint64_t refused[TRACKER_CHECKS]; /**< packets, and bodies in packets, that gave no pose; [TRACKER_OK] is 0 */
} bridge_counts_t;

/** A viewer's newest pose on the tracker's clock. */
typedef struct {
    bool any;
    int64_t time_us;
} bridge_newest_t;

/** Some 70 kB. Made by bridge_init(); its fields are the bridge's own, but for the counts. */
typedef struct {
    const tracker_protocol_t *protocol;
    tracker_transform_t transform;
    tracker_memory_t memory;
    tracker_clock_t clock;
    tracker_packet_t packet;
    bridge_newest_t newest[CAN_VIEWERS];
    bridge_counts_t counts;
} bridge_t;

void bridge_init(bridge_t *bridge, const tracker_protocol_t *protocol, const tracker_transform_t *transform);

/**
 * One packet.
 *
 * A pose's capture time is the protocol's, brought onto this machine's clock by tracker_clock_local_us(), else the
 * arrival; the transform's latency is taken off. A viewer's pose that is not newer than the one before is left out. A
 * lost viewer's pose is at the origin and does not turn.
 *
 * @param      size        0 to TRACKER_MAX_PACKET.
 * @param      arrived_us  On this machine's monotonic clock.
 * @param[out] message     All but the counters. Not necessarily within the range of a set of classic frames.
 * @return How many messages.
 */
int bridge_packet(bridge_t *bridge, const uint8_t *bytes, size_t size, int64_t arrived_us,
                  can_pose_t message[TRACKER_MAX_POSES]);

/** Write what gave no pose and why, one line each: "wrong checksum: 3". Nothing when all was good. */
void bridge_counts_print(FILE *file, const bridge_counts_t *counts);

#endif
