// SPDX-License-Identifier: Apache-2.0
// The transform file: from a tracker's axes, unit and bodies to the room and the viewers' eyes.
//
//   axes: {x: +x, y: -z, z: +y}    for each axis of the room, the tracker's axis that points the same way
//   viewers:                       one to four
//     - viewer: 0                  its number on the bus, 0 to 3
//       body: 1                    the tracker's number of the body on the viewer's head
//       camera: {right: +x, down: -z, forward: +y}   the body's own axes that point right, down, forward of the viewer
//       eye_mm: [0, 0, 0]          from the tracked point to the eye, in the body's own axes
//       turn_deg: [0, 0, 0]        the look against `camera`: turned right, then up, then clockwise
//   origin_mm: [0, 0, 0]           where the tracker's origin is in the room
//   unit: mm                       of the tracker's positions: mm, cm, m or in; by default the protocol's own
//   latency_ms: 0                  from capture to arrival; taken off the capture time
//   tracker: 0                     the tracker's number on the bus, 0 to 15
//
// Only axes and viewers, and in them viewer, body and camera, must be there. A left-handed tracker needs nothing
// special: its axes and the bodies' are both mirrored, which axes and camera then say alike.
#ifndef SIM_TRACKERS_TRANSFORM_H
#define SIM_TRACKERS_TRANSFORM_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_protocol.h"
#include "firmware/room.h"
#include "sim/trackers/tracker.h"

/** One viewer and its body. */
typedef struct {
    uint32_t body;
    uint8_t viewer;
    double eye_mm[3];         /**< in the body's axes */
    double camera_axis[3][3]; /**< the camera's x, y, z axes, in the body's */
} tracker_viewer_t;

typedef struct {
    double room_axis[3][3]; /**< the room's x, y, z axes, in the tracker's */
    double origin_mm[3];
    double unit_mm; /**< 0 when the file has none: the protocol's */
    int64_t latency_us;
    uint8_t tracker;
    int viewers; /**< 1 to CAN_VIEWERS */
    tracker_viewer_t viewer[CAN_VIEWERS];
} tracker_transform_t;

/**
 * Read and check a transform file. Uses the heap while it runs.
 *
 * @param[out] transform  Written only when true is returned.
 * @param[out] error      On failure: "FILE:LINE: KEY: what was found, what was expected".
 */
bool tracker_transform_load(tracker_transform_t *transform, const char *path, char error[ROOM_MESSAGE_LENGTH]);

/** @return The viewer that wears the body, or NULL. */
const tracker_viewer_t *tracker_transform_viewer(const tracker_transform_t *transform, uint32_t body);

/**
 * A body's pose -> its viewer's, in the room.
 *
 * @param      unit_mm  The protocol's, for a file without unit.
 * @param[out] out      Written only when true is returned. The quaternion has w >= 0.
 * @return false when the eye is more than 1000 m from the room's origin along an axis.
 */
bool tracker_transform_apply(const tracker_transform_t *transform, const tracker_viewer_t *viewer, double unit_mm,
                             const tracker_pose_t *pose, pose_t *out);

#endif
