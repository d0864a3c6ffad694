// SPDX-License-Identifier: Apache-2.0
// The shape of a room file: its keys, their types, and the structs they are read into.
#ifndef FIRMWARE_ROOM_ROOM_SCHEMA_H
#define FIRMWARE_ROOM_ROOM_SCHEMA_H

#include <stdbool.h>
#include <stdint.h>

#include <cyaml/cyaml.h>

/** All values as they stand in the file: unchecked but for their type. A pointer is NULL where the key is left out. */
typedef struct {
    int64_t width, height;
    double focal_px[2], principal_px[2];
} room_yaml_camera_t;

typedef struct {
    int64_t width, height;
} room_yaml_projector_t;

typedef struct {
    double *corner_mm[4]; /**< three numbers each, or NULL where unknown */
} room_yaml_wall_t;

typedef struct {
    double px[2], mm[3];
} room_yaml_marker_t;

typedef struct {
    double *x, *y; /**< NULL where left out */
    uint32_t x_count, y_count;
} room_yaml_weights_t;

typedef enum { ROOM_YAML_STEP_IN, ROOM_YAML_STEP_ALL } room_yaml_step_t;

typedef struct {
    char *name;
    int64_t node;
    room_yaml_projector_t projector;
    room_yaml_wall_t wall;
    char *method;
    int64_t viewer;          /**< 0 unless stated */
    double display_delay_ms; /**< 0 unless stated */
    int64_t border[3];       /**< black unless stated */
    room_yaml_step_t step;   /**< in unless stated */
    room_yaml_marker_t *marker;
    uint32_t marker_count;
    room_yaml_weights_t *weights;
} room_yaml_board_t;

typedef struct {
    int64_t *bitrate, *data_bitrate;
    bool *fd;
} room_yaml_can_t;

typedef enum { ROOM_YAML_POSE_LATEST, ROOM_YAML_POSE_DELAY, ROOM_YAML_POSE_TAG } room_yaml_pose_t;

typedef enum { ROOM_YAML_CONTENT_WALL, ROOM_YAML_CONTENT_DEPTH, ROOM_YAML_CONTENT_FAR } room_yaml_content_t;

typedef struct {
    double *refresh_hz, *pose_delay_ms, *latency_ms, *render_ms, *depth_mm;
    room_yaml_pose_t pose;       /**< latest unless stated */
    room_yaml_content_t content; /**< wall unless stated */
} room_yaml_frames_t;

typedef struct {
    room_yaml_camera_t camera;
    room_yaml_board_t *board;
    uint32_t board_count;
    room_yaml_can_t can;
    room_yaml_frames_t frames;
} room_yaml_t;

/** Of the whole file: a mapping into a room_yaml_t that libcyaml allocates. */
extern const cyaml_schema_value_t room_schema;

#endif
