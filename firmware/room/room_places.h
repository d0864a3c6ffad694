// SPDX-License-Identifier: Apache-2.0
// Every value of a room file: its full name, its line, and whether it has the shape that the schema asks for.
//
// libcyaml checks the same, but cannot say the line of a value that it accepted, and its words for what it refuses
// differ between its versions. So the file is first walked here, by libcyaml's own schema tables.
#ifndef FIRMWARE_ROOM_ROOM_PLACES_H
#define FIRMWARE_ROOM_ROOM_PLACES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cyaml/cyaml.h>
#include <yaml.h>

#include "firmware/room/room_report.h"
#include "firmware/room/room_text.h"

/** One value. */
typedef struct {
    yaml_node_t *node;
    const cyaml_schema_value_t *schema;
    size_t line;     /**< from 1; of its key where it has one */
    int32_t parent;  /**< place of the mapping or list it is in; -1 for the root */
    const char *key; /**< in the parent mapping; NULL in a list */
    int32_t index;   /**< in the parent list */
} room_place_t;

typedef struct {
    yaml_document_t document; /**< owned */
    room_place_t *place;      /**< owned; parents before children */
    int32_t count, capacity;
} room_places_t;

/**
 * Walk the text by the schema. Refuses unknown, missing and repeated keys, wrong types and lists of wrong length.
 * Narrower than libcyaml where that would guess: whole numbers are decimal, booleans are true or false, numbers are
 * finite and not in quotes.
 *
 * @param[out] places  Written only when true is returned; then end with room_places_free().
 */
bool room_places_read(room_places_t *places, const room_text_t *text, const cyaml_schema_value_t *schema,
                      const room_report_t *report);

void room_places_free(room_places_t *places);

/** @return The line of the value of that full name; 1 when the file has none. */
size_t room_places_line(const room_places_t *places, const char *key);

#endif
