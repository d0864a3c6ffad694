// SPDX-License-Identifier: Apache-2.0
// What the tests of the tracker protocols all check alike.
#ifndef TESTS_SUPPORT_TRACKER_EXPECT_H
#define TESTS_SUPPORT_TRACKER_EXPECT_H

#include "sim/trackers/tracker.h"

/** Fails the test unless the pose has this position, within 10^-6 of it or of one. */
void tracker_expect_position(const tracker_pose_t *pose, double x, double y, double z);

/** Fails the test unless the pose turns a vector of the body into this one of the tracker, within 10^-5. */
void tracker_expect_turns(const tracker_pose_t *pose, const double body[3], const double expected[3]);

/** Fails the test unless the packet is empty, but for `bodies` left out for this reason. */
void tracker_expect_left_out(const tracker_packet_t *packet, tracker_check_t reason, uint32_t bodies);

#endif
