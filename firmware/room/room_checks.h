// SPDX-License-Identifier: Apache-2.0
// The values of a room file: ranges, names and numbers of their own, conversion to integers.
#ifndef FIRMWARE_ROOM_ROOM_CHECKS_H
#define FIRMWARE_ROOM_ROOM_CHECKS_H

#include <stdbool.h>

#include "firmware/room.h"
#include "firmware/room/room_places.h"
#include "firmware/room/room_report.h"
#include "firmware/room/room_schema.h"

/** What every check needs to refuse a value by its name. */
typedef struct {
    const room_report_t *report;
    const room_places_t *places; /**< of the file that the values came from */
} room_checker_t;

/**
 * Check all values and convert them, but for the walls, which are left zero: room_walls_fit() makes them.
 *
 * @param[out] room  Half written when false is returned.
 * @return false with the report's error written at the first value out of range.
 */
bool room_checks(const room_checker_t *checker, const room_yaml_t *yaml, room_t *room);

#endif
