// SPDX-License-Identifier: Apache-2.0
// An OpenTrackIO 1.0.1 sample, as values -> pose.
//
// Source: SMPTE RIS-OSVP, OpenTrackIO Documentation v1.0.1, "Description of all fields". Read are:
//   protocol.name        must be OpenTrackIO        protocol.version     [1, x, y]
//   sourceNumber         1 to 200: the pose's id
//   transforms           a list: each has translation {x, y, z} in m and rotation {pan, tilt, roll} in degrees; they
//                        follow one another from the stage to the camera. A scale, if any, must be 1
//   timing.sampleTimestamp {seconds, nanoseconds}   capture time, where it is there
//
// Axes: right-handed, z up. With all angles 0 the camera looks along +y with +x to its right. Rotations are intrinsic
// about z, x, y (pan, tilt, roll) and positive clockwise as seen along the axis, which is the right-hand rule: the
// orientation is Rz(pan) Rx(tilt) Ry(roll), so pan is positive to the left. The body's x is right, y forward, z up.
//
// The protocol has a free text about the tracker's state (tracker.status) but no quality.
#ifndef SIM_TRACKERS_OPENTRACKIO_SAMPLE_H
#define SIM_TRACKERS_OPENTRACKIO_SAMPLE_H

#include <jansson.h>

#include "sim/trackers/tracker.h"

/**
 * @param[in,out] packet  Empty; gets one pose in m when TRACKER_OK is returned, or none and a count in left_out.
 * @return TRACKER_OK; TRACKER_VERSION (protocol); TRACKER_VALUE (sourceNumber); TRACKER_SYNTAX (a field has another
 * shape).
 */
tracker_check_t opentrackio_sample_read(tracker_packet_t *packet, const json_t *sample);

#endif
