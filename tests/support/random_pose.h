// SPDX-License-Identifier: Apache-2.0
// Random poses for the tests of the bus: the same ones from the same seed.
#ifndef TESTS_SUPPORT_RANDOM_POSE_H
#define TESTS_SUPPORT_RANDOM_POSE_H

#include <stdint.h>

#include "firmware/can_protocol.h"
#include "tests/support/rng.h"

/** @return Position within +-limit_nm, components of the quaternion within +-1 each (any length), counter below
 * counters. */
can_pose_t random_pose(rng_t *rng, int64_t limit_nm, int counters);

/** @return The same with a quaternion of unit length within 10^-6, tracked, of viewer 0. */
can_pose_t random_pose_sane(rng_t *rng, int64_t limit_nm, int counters);

#endif
