// SPDX-License-Identifier: Apache-2.0
// The shape of a transform file, as tables for libcyaml.
#include "sim/trackers/transform_schema.h"

#include "firmware/can_protocol.h"

static const cyaml_schema_value_t number = {CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, double)};

static const cyaml_strval_t directions[] = {{.str = "+x", .val = DIRECTION_X}, {.str = "-x", .val = DIRECTION_MINUS_X},
                                            {.str = "+y", .val = DIRECTION_Y}, {.str = "-y", .val = DIRECTION_MINUS_Y},
                                            {.str = "+z", .val = DIRECTION_Z}, {.str = "-z", .val = DIRECTION_MINUS_Z}};

static const cyaml_strval_t units[] = {{.str = "mm", .val = UNIT_MM},
                                       {.str = "cm", .val = UNIT_CM},
                                       {.str = "m", .val = UNIT_M},
                                       {.str = "in", .val = UNIT_INCH}};

static const cyaml_schema_field_t axes_keys[] = {
    CYAML_FIELD_ENUM("x", CYAML_FLAG_STRICT, transform_yaml_axes_t, direction[0], directions,
                     CYAML_ARRAY_LEN(directions)),
    CYAML_FIELD_ENUM("y", CYAML_FLAG_STRICT, transform_yaml_axes_t, direction[1], directions,
                     CYAML_ARRAY_LEN(directions)),
    CYAML_FIELD_ENUM("z", CYAML_FLAG_STRICT, transform_yaml_axes_t, direction[2], directions,
                     CYAML_ARRAY_LEN(directions)),
    CYAML_FIELD_END};

static const cyaml_schema_field_t camera_keys[] = {
    CYAML_FIELD_ENUM("right", CYAML_FLAG_STRICT, transform_yaml_axes_t, direction[0], directions,
                     CYAML_ARRAY_LEN(directions)),
    CYAML_FIELD_ENUM("down", CYAML_FLAG_STRICT, transform_yaml_axes_t, direction[1], directions,
                     CYAML_ARRAY_LEN(directions)),
    CYAML_FIELD_ENUM("forward", CYAML_FLAG_STRICT, transform_yaml_axes_t, direction[2], directions,
                     CYAML_ARRAY_LEN(directions)),
    CYAML_FIELD_END};

static const cyaml_schema_field_t viewer_keys[] = {
    CYAML_FIELD_INT("viewer", CYAML_FLAG_DEFAULT, transform_yaml_viewer_t, viewer),
    CYAML_FIELD_INT("body", CYAML_FLAG_DEFAULT, transform_yaml_viewer_t, body),
    CYAML_FIELD_MAPPING("camera", CYAML_FLAG_DEFAULT, transform_yaml_viewer_t, camera, camera_keys),
    CYAML_FIELD_SEQUENCE_FIXED("eye_mm", CYAML_FLAG_OPTIONAL, transform_yaml_viewer_t, eye_mm, &number, 3),
    CYAML_FIELD_SEQUENCE_FIXED("turn_deg", CYAML_FLAG_OPTIONAL, transform_yaml_viewer_t, turn_deg, &number, 3),
    CYAML_FIELD_END};

static const cyaml_schema_value_t viewer = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, transform_yaml_viewer_t, viewer_keys)};

static const cyaml_schema_field_t transform_keys[] = {
    CYAML_FIELD_MAPPING("axes", CYAML_FLAG_DEFAULT, transform_yaml_t, axes, axes_keys),
    CYAML_FIELD_SEQUENCE_COUNT("viewers", CYAML_FLAG_POINTER, transform_yaml_t, viewer, viewer_count, &viewer, 1,
                               CAN_VIEWERS),
    CYAML_FIELD_SEQUENCE_FIXED("origin_mm", CYAML_FLAG_OPTIONAL, transform_yaml_t, origin_mm, &number, 3),
    CYAML_FIELD_ENUM("unit", CYAML_FLAG_OPTIONAL | CYAML_FLAG_STRICT, transform_yaml_t, unit, units,
                     CYAML_ARRAY_LEN(units)),
    CYAML_FIELD_FLOAT("latency_ms", CYAML_FLAG_OPTIONAL, transform_yaml_t, latency_ms),
    CYAML_FIELD_INT("tracker", CYAML_FLAG_OPTIONAL, transform_yaml_t, tracker),
    CYAML_FIELD_END};

const cyaml_schema_value_t transform_schema = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, transform_yaml_t, transform_keys)};
