// SPDX-License-Identifier: Apache-2.0
// The shape of a transform file: its keys, their types, and the structs they are read into.
#ifndef SIM_TRACKERS_TRANSFORM_SCHEMA_H
#define SIM_TRACKERS_TRANSFORM_SCHEMA_H

#include <stdint.h>

#include <cyaml/cyaml.h>

/** A direction along an axis: 2 * axis, + 1 when negative. */
typedef enum {
    DIRECTION_X,
    DIRECTION_MINUS_X,
    DIRECTION_Y,
    DIRECTION_MINUS_Y,
    DIRECTION_Z,
    DIRECTION_MINUS_Z
} direction_t;

typedef enum { UNIT_OF_PROTOCOL, UNIT_MM, UNIT_CM, UNIT_M, UNIT_INCH, UNITS } unit_t;

typedef struct {
    direction_t direction[3];
} transform_yaml_axes_t;

/** All values as they stand in the file: unchecked but for their type, zero where left out. */
typedef struct {
    int64_t viewer, body;
    transform_yaml_axes_t camera;
    double eye_mm[3], turn_deg[3];
} transform_yaml_viewer_t;

typedef struct {
    transform_yaml_axes_t axes;
    transform_yaml_viewer_t *viewer;
    uint32_t viewer_count;
    double origin_mm[3];
    unit_t unit;
    double latency_ms;
    int64_t tracker;
} transform_yaml_t;

/** Of the whole file: a mapping into a transform_yaml_t that libcyaml allocates. */
extern const cyaml_schema_value_t transform_schema;

#endif
