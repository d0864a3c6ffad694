// SPDX-License-Identifier: Apache-2.0
// For tests of what `wallwarp-pose check` and `monitor` say of a watched bus.
#ifndef TESTS_SUPPORT_BUS_SAID_H
#define TESTS_SUPPORT_BUS_SAID_H

#include "sim/pose/bus_check.h"

enum { BUS_SAID_ANY = -1 };

/** The running test fails unless check finds so many bad things (or BUS_SAID_ANY), and this text is in what it says. */
void bus_said(const bus_watch_t *watch, int64_t pose_delay_us, int bad, const char *expected);

/** The running test fails unless this text is in monitor's table. */
void bus_shown(const bus_watch_t *watch, const char *expected);

#endif
