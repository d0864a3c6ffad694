// SPDX-License-Identifier: Apache-2.0
// A.R.T. DTrack: its ASCII output over UDP -> poses of the standard 6DOF bodies.
//
// Source: ARTtrack / DTrack2 User's Guide, appendix B.1.3 (rotations) and B.2.1 to B.2.4 (output via Ethernet). A
// packet is lines of text, ended by LF or CR LF, each beginning with its identifier; numbers have spaces between them:
//   fr COUNT                                        always the first line
//   ts SECONDS                                      capture, since midnight UTC; back to 0 at midnight
//   6d N [id qu][x y z eta theta phi][b0 ... b8]    N times: bodies seen, in mm
//   6di N [id st er][x y z][b0 ... b8]              N times: all bodies; st 0 lost, 1 by inertia only, 2 and 3 seen
// Other lines (6df2, 6dmt2, 3d, gl ...) are passed over. Where 6d and 6di both are there, 6di counts: it says more.
//
// Axes: right-handed, as calibrated. b0 to b8 are the rotation matrix column by column: b0 b1 b2 is the body's x axis
// in the room. The angles are not read: the guide itself advises against it.
#ifndef SIM_TRACKERS_DTRACK_H
#define SIM_TRACKERS_DTRACK_H

#include <stddef.h>

#include "sim/trackers/tracker.h"

/**
 * @param[in,out] packet  Empty; gets poses in mm when TRACKER_OK is returned. Else it is to be thrown away.
 * @return TRACKER_OK; TRACKER_OTHER (no 6d or 6di line); TRACKER_SYNTAX (the lines above are not built like that).
 */
tracker_check_t dtrack_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size);

#endif
