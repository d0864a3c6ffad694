// SPDX-License-Identifier: Apache-2.0
// What a watched bus looks like, as a table for people: `wallwarp-pose monitor`.
#ifndef SIM_POSE_BUS_TABLE_H
#define SIM_POSE_BUS_TABLE_H

#include <stdio.h>

#include "sim/pose/bus_watch.h"

/**
 * Print the bus's line, one line per viewer heard, and one per board heard; then bus time, the refreshes compared, and
 * a line per board that tells of either; then one per board that tells how late it is and what it has counted. Rates,
 * jitter and counts are since the start.
 */
void bus_table_print(FILE *file, const char *bus, const bus_watch_t *watch);

#endif
