// SPDX-License-Identifier: Apache-2.0
// A simulated display with its clock, for tests: 100 blanks a second.
#ifndef TESTS_SUPPORT_DISPLAY_RIG_H
#define TESTS_SUPPORT_DISPLAY_RIG_H

#include "sim/devices/sim_display.h"

/** Size of the panel; the clock's usual start, after blank 0 and before blank 1. */
enum { DISPLAY_RIG_WIDTH = 5, DISPLAY_RIG_HEIGHT = 3, DISPLAY_RIG_EPOCH_US = 4000 };

typedef struct {
    hal_time_t *clock;
    hal_display_t *display;
} display_rig_t;

/** When blank n is: 3000 + 10000 n. */
int64_t display_rig_blank_us(int64_t n);

/** What display_rig_open() makes its display with. */
sim_display_settings_t display_rig_settings(hal_time_t *clock);

/** Make a virtual clock that starts at epoch_us, and a display. The test fails when that fails. */
display_rig_t display_rig_open(int64_t epoch_us);

void display_rig_close(const display_rig_t *rig);

/** Set the clock, and advance the display to it. */
void display_rig_go_to(const display_rig_t *rig, int64_t time_us);

/** Borrow an XRGB8888 buffer. */
hal_status_t display_rig_borrow(const display_rig_t *rig, picture_t *buffer);

/** Borrow, fill every byte with one value, present. */
hal_status_t display_rig_draw(const display_rig_t *rig, int value);

/** @return The byte that the whole wall shows; -1 when it is dark. */
int display_rig_wall(const display_rig_t *rig);

#endif
