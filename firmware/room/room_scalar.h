// SPDX-License-Identifier: Apache-2.0
// Single values of a room file: do they have the type asked for, and how to name them in a message.
#ifndef FIRMWARE_ROOM_ROOM_SCALAR_H
#define FIRMWARE_ROOM_ROOM_SCALAR_H

#include <stdbool.h>

#include <cyaml/cyaml.h>
#include <yaml.h>

/** A part of a message. */
typedef struct {
    char text[192];
} room_phrase_t;

/** @return Is the node YAML's null: nothing, ~ or null, not in quotes? */
bool room_scalar_is_null(const yaml_node_t *node);

/**
 * @return Is the node a scalar that libcyaml reads as exactly what is written, by a schema of the types int, float,
 *         bool, string or enum?
 */
bool room_scalar_fits(const yaml_node_t *node, const cyaml_schema_value_t *schema);

/** @return The text, cut to 40 bytes at a whole UTF-8 character. */
room_phrase_t room_phrase_cut(const char *text);

/** @return What stands in the file, such as "'wide'" or "a list of 3". */
room_phrase_t room_phrase_found(const yaml_node_t *node);

/** @return What should stand there, such as "a whole number" or "a list of 3, or null". */
room_phrase_t room_phrase_expected(const cyaml_schema_value_t *schema);

/** @return The names of the fields, "a, b, c". */
room_phrase_t room_phrase_keys(const cyaml_schema_field_t *fields);

#endif
