// SPDX-License-Identifier: Apache-2.0
// A YAML file of which every value has the shape that a schema asks for: the values, and their places in the file.
#ifndef FIRMWARE_ROOM_ROOM_YAML_FILE_H
#define FIRMWARE_ROOM_ROOM_YAML_FILE_H

#include <stdbool.h>

#include <cyaml/cyaml.h>

#include "firmware/room/room_places.h"
#include "firmware/room/room_report.h"

typedef struct {
    room_places_t places;
    void *data; /**< the struct that the schema describes */
    const cyaml_schema_value_t *schema;
} room_yaml_file_t;

/**
 * Read report->path. Start-up only: uses the heap.
 *
 * @param[out] file    Written only when true is returned; then end with room_yaml_file_free().
 * @param      schema  Of the whole file: a mapping into a struct that libcyaml allocates. Must outlive the file.
 * @return false with the report's error written.
 */
bool room_yaml_file_read(room_yaml_file_t *file, const cyaml_schema_value_t *schema, const room_report_t *report);

void room_yaml_file_free(room_yaml_file_t *file);

#endif
