// SPDX-License-Identifier: Apache-2.0
// FreeD: the camera position message D1 -> pose.
//
// Source: Vinten Radamec free-d Installation Manual V1.4.4, appendix A.1 (checksum), A.3.2 (the message), B (its
// values). 29 bytes, most significant byte first:
//   0 type, D1       1 camera id       2 pan    5 tilt    8 roll      three bytes each, signed, 1/32768 degree
//   11 x             14 y              17 height                      three bytes each, signed, 1/64 mm
//   20 zoom          23 focus          26 user defined                not used here
//   28 checksum: all 29 bytes together make 40 (hex), modulo 256
//
// Axes (B.1): right-handed, z up. With all angles 0 the camera looks along +y with +x to its right (B.2, B.3). Pan is
// positive to the right, clockwise from above; tilt is positive upwards; roll is positive clockwise seen from behind
// the camera. So the body's x is right, y forward, z up, and the orientation is Rz(-pan) Rx(tilt) Ry(roll).
//
// D1 has neither a time nor a quality.
#ifndef SIM_TRACKERS_FREED_H
#define SIM_TRACKERS_FREED_H

#include <stddef.h>

#include "sim/trackers/tracker.h"

enum { FREED_D1_LENGTH = 29 };

/**
 * @param[in,out] packet  Empty; gets one pose in mm when TRACKER_OK is returned, else it is untouched. Angles beyond
 * the ranges of B.2 to B.4 are taken: they name a rotation too.
 * @return TRACKER_OK, _OTHER (another message type), _LENGTH or _CHECKSUM.
 */
tracker_check_t freed_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size);

#endif
