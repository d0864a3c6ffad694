// SPDX-License-Identifier: Apache-2.0
// Open Sound Control: messages of one address pattern -> poses. Messages are read by liblo.
//
// Source: Open Sound Control 1.0 Specification (messages, bundles, time tags). OSC names no poses; this is ours:
//   /pose     [id] x y z qw qx qy qz [quality]
//   /pose/ID  x y z qw qx qy qz [quality]
// id and quality are int32 (i); the seven numbers are float32 (f) or double (d). The id is 0 where none is given, the
// quality 1: 0 lost, 1 tracked, 2 predicted by the tracker. The quaternion turns the body's vectors into the tracker's.
// A bundle carries any number of such messages; its time tag, unless it is "immediately", is their capture time (NTP).
#ifndef SIM_TRACKERS_OSC_H
#define SIM_TRACKERS_OSC_H

#include <stddef.h>

#include "sim/trackers/tracker.h"

/**
 * Uses the heap (liblo's), and gives it back before it returns.
 *
 * @param[in,out] packet  Empty; gets poses in the sender's unit when TRACKER_OK is returned, else to be thrown away.
 * @return TRACKER_OK, _OTHER (no message /pose in it), _LENGTH (no multiple of 4, or an element of a bundle reaches
 * beyond it) or _SYNTAX (no OSC; other arguments than the above; a bundle in a bundle).
 */
tracker_check_t osc_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size);

#endif
