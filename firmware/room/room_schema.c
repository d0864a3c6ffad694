// SPDX-License-Identifier: Apache-2.0
// The shape of a room file, as tables for libcyaml.
#include "firmware/room/room_schema.h"

#include "firmware/room.h"

static const cyaml_schema_value_t number = {CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, double)};

static const cyaml_schema_value_t whole_number = {CYAML_VALUE_INT(CYAML_FLAG_DEFAULT, int64_t)};

static const cyaml_schema_value_t corner = {
    CYAML_VALUE_SEQUENCE_FIXED(CYAML_FLAG_POINTER_NULL_STR, double, &number, 3)};

static const cyaml_schema_field_t camera_keys[] = {
    CYAML_FIELD_INT("width", CYAML_FLAG_DEFAULT, room_yaml_camera_t, width),
    CYAML_FIELD_INT("height", CYAML_FLAG_DEFAULT, room_yaml_camera_t, height),
    CYAML_FIELD_SEQUENCE_FIXED("focal_px", CYAML_FLAG_DEFAULT, room_yaml_camera_t, focal_px, &number, 2),
    CYAML_FIELD_SEQUENCE_FIXED("principal_px", CYAML_FLAG_DEFAULT, room_yaml_camera_t, principal_px, &number, 2),
    CYAML_FIELD_END};

static const cyaml_schema_field_t projector_keys[] = {
    CYAML_FIELD_INT("width", CYAML_FLAG_DEFAULT, room_yaml_projector_t, width),
    CYAML_FIELD_INT("height", CYAML_FLAG_DEFAULT, room_yaml_projector_t, height), CYAML_FIELD_END};

static const cyaml_schema_field_t wall_keys[] = {
    CYAML_FIELD_SEQUENCE_FIXED("corners_mm", CYAML_FLAG_DEFAULT, room_yaml_wall_t, corner_mm, &corner, 4),
    CYAML_FIELD_END};

static const cyaml_schema_field_t marker_keys[] = {
    CYAML_FIELD_SEQUENCE_FIXED("px", CYAML_FLAG_DEFAULT, room_yaml_marker_t, px, &number, 2),
    CYAML_FIELD_SEQUENCE_FIXED("mm", CYAML_FLAG_DEFAULT, room_yaml_marker_t, mm, &number, 3), CYAML_FIELD_END};

static const cyaml_schema_value_t marker = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, room_yaml_marker_t, marker_keys)};

static const cyaml_schema_field_t weights_keys[] = {
    CYAML_FIELD_SEQUENCE("x", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_weights_t, x, &number, 1,
                         CYAML_UNLIMITED),
    CYAML_FIELD_SEQUENCE("y", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_weights_t, y, &number, 1,
                         CYAML_UNLIMITED),
    CYAML_FIELD_END};

static const cyaml_strval_t steps[] = {{.str = "in", .val = ROOM_YAML_STEP_IN},
                                       {.str = "all", .val = ROOM_YAML_STEP_ALL}};

static const cyaml_schema_field_t board_keys[] = {
    CYAML_FIELD_STRING_PTR("name", CYAML_FLAG_POINTER, room_yaml_board_t, name, 0, CYAML_UNLIMITED),
    CYAML_FIELD_INT("node", CYAML_FLAG_DEFAULT, room_yaml_board_t, node),
    CYAML_FIELD_MAPPING("projector", CYAML_FLAG_DEFAULT, room_yaml_board_t, projector, projector_keys),
    CYAML_FIELD_MAPPING("wall", CYAML_FLAG_DEFAULT, room_yaml_board_t, wall, wall_keys),
    CYAML_FIELD_STRING_PTR("method", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_board_t, method, 0,
                           CYAML_UNLIMITED),
    CYAML_FIELD_INT("viewer", CYAML_FLAG_OPTIONAL, room_yaml_board_t, viewer),
    CYAML_FIELD_FLOAT("display_delay_ms", CYAML_FLAG_OPTIONAL, room_yaml_board_t, display_delay_ms),
    CYAML_FIELD_SEQUENCE_FIXED("border", CYAML_FLAG_OPTIONAL, room_yaml_board_t, border, &whole_number, 3),
    CYAML_FIELD_ENUM("step", CYAML_FLAG_OPTIONAL | CYAML_FLAG_STRICT, room_yaml_board_t, step, steps,
                     CYAML_ARRAY_LEN(steps)),
    CYAML_FIELD_SEQUENCE_COUNT("markers", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_board_t, marker,
                               marker_count, &marker, 0, WALL_MAX_MARKERS),
    CYAML_FIELD_MAPPING_PTR("ls_weights", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_board_t, weights,
                            weights_keys),
    CYAML_FIELD_END};

static const cyaml_schema_value_t board = {CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, room_yaml_board_t, board_keys)};

static const cyaml_schema_field_t can_keys[] = {
    CYAML_FIELD_INT_PTR("bitrate", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_can_t, bitrate),
    CYAML_FIELD_INT_PTR("data_bitrate", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_can_t, data_bitrate),
    CYAML_FIELD_BOOL_PTR("fd", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_can_t, fd), CYAML_FIELD_END};

static const cyaml_strval_t poses[] = {{.str = "latest", .val = ROOM_YAML_POSE_LATEST},
                                       {.str = "delay", .val = ROOM_YAML_POSE_DELAY},
                                       {.str = "tag", .val = ROOM_YAML_POSE_TAG}};

static const cyaml_strval_t contents[] = {{.str = "wall", .val = ROOM_YAML_CONTENT_WALL},
                                          {.str = "depth", .val = ROOM_YAML_CONTENT_DEPTH},
                                          {.str = "far", .val = ROOM_YAML_CONTENT_FAR}};

static const cyaml_schema_field_t frames_keys[] = {
    CYAML_FIELD_FLOAT_PTR("refresh_hz", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_frames_t, refresh_hz),
    CYAML_FIELD_FLOAT_PTR("pose_delay_ms", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_frames_t, pose_delay_ms),
    CYAML_FIELD_FLOAT_PTR("latency_ms", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_frames_t, latency_ms),
    CYAML_FIELD_ENUM("pose", CYAML_FLAG_OPTIONAL | CYAML_FLAG_STRICT, room_yaml_frames_t, pose, poses,
                     CYAML_ARRAY_LEN(poses)),
    CYAML_FIELD_FLOAT_PTR("render_ms", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_frames_t, render_ms),
    CYAML_FIELD_ENUM("content", CYAML_FLAG_OPTIONAL | CYAML_FLAG_STRICT, room_yaml_frames_t, content, contents,
                     CYAML_ARRAY_LEN(contents)),
    CYAML_FIELD_FLOAT_PTR("depth_mm", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, room_yaml_frames_t, depth_mm),
    CYAML_FIELD_END};

static const cyaml_schema_field_t room_keys[] = {
    CYAML_FIELD_MAPPING("camera", CYAML_FLAG_DEFAULT, room_yaml_t, camera, camera_keys),
    CYAML_FIELD_SEQUENCE_COUNT("boards", CYAML_FLAG_POINTER, room_yaml_t, board, board_count, &board, 1,
                               ROOM_MAX_BOARDS),
    CYAML_FIELD_MAPPING("can", CYAML_FLAG_OPTIONAL, room_yaml_t, can, can_keys),
    CYAML_FIELD_MAPPING("frames", CYAML_FLAG_OPTIONAL, room_yaml_t, frames, frames_keys), CYAML_FIELD_END};

const cyaml_schema_value_t room_schema = {CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, room_yaml_t, room_keys)};
