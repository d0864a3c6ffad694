// SPDX-License-Identifier: Apache-2.0
// What the tests of the tracker protocols all check alike.
#include "tests/support/tracker_expect.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "sim/trackers/tracker_rotation.h"

void tracker_expect_position(const tracker_pose_t *pose, double x, double y, double z)
{
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        if (!(fabs(pose->position[i] - expected[i]) <= 1e-6 * fmax(1.0, fabs(expected[i]))))
            fail_msg("position is %.9g %.9g %.9g, expected %.9g %.9g %.9g", pose->position[0], pose->position[1],
                     pose->position[2], x, y, z);
}

void tracker_expect_turns(const tracker_pose_t *pose, const double body[3], const double expected[3])
{
    double turned[3];
    tracker_rotation_apply(turned, pose->quaternion, body);
    for (int i = 0; i < 3; i++)
        if (!(fabs(turned[i] - expected[i]) <= 1e-5))
            fail_msg("%g %g %g is turned into %.6f %.6f %.6f, expected %.6f %.6f %.6f", body[0], body[1], body[2],
                     turned[0], turned[1], turned[2], expected[0], expected[1], expected[2]);
}

void tracker_expect_left_out(const tracker_packet_t *packet, tracker_check_t reason, uint32_t bodies)
{
    assert_int_equal(packet->count, 0);
    for (int c = 0; c < TRACKER_CHECKS; c++)
        if (packet->left_out[c] != (c == (int)reason ? bodies : 0))
            fail_msg("%u bodies are left out as \"%s\"", packet->left_out[c], tracker_check_text[c]);
}
