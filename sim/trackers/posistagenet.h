// SPDX-License-Identifier: Apache-2.0
// PosiStageNet 2: data packets -> poses of their trackers.
//
// Source: PosiStageNet Protocol, version 2.03, 2019-09-09. UDP multicast 236.10.10.10:56565; all numbers little-endian.
// A packet is chunks within chunks. A chunk's head is 32 bits: 16 of id, 15 of length (without the head), and the
// highest bit says that chunks are in it.
//   6755 data packet
//     0000 header, 12 bytes: uint64 time in us, uint8 version high and low, uint8 frame, uint8 packets of the frame
//     0001 tracker list
//       (tracker's number)
//         0000 position, 3 floats, m      0001 speed, 3 floats          0002 orientation, 3 floats
//         0003 status, float 0 to 1       0004 acceleration             0005 target position
//         0006 time of this tracker, uint64, us
// Chunks of other ids are passed over. 6756 is the info packet, with names.
//
// Orientation is a rotation vector: its direction is the axis, its length the angle in radians. Axes are the server's
// (commonly x right, y up, z into the stage, which is left-handed). Quality: a status of 0 is a tracker that is lost.
// A frame's packets each carry whole trackers, so each stands for itself. The time is the tracker's, else the packet's.
#ifndef SIM_TRACKERS_POSISTAGENET_H
#define SIM_TRACKERS_POSISTAGENET_H

#include <stddef.h>

#include "sim/trackers/tracker.h"

/**
 * @param[in,out] packet  Empty; gets poses in m when TRACKER_OK is returned. Else it is to be thrown away. A tracker
 *                        without position or orientation is counted as TRACKER_INCOMPLETE.
 * @return TRACKER_OK, _OTHER (an info packet, or no PosiStageNet), _LENGTH (a chunk reaches beyond the one it is in, or
 *         is not as long as its kind), _VERSION or _SYNTAX (the header or the list is missing, or not at its place).
 */
tracker_check_t posistagenet_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size);

#endif
