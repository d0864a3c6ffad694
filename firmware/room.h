// SPDX-License-Identifier: Apache-2.0
// The room file: camera, boards with their walls, and the bus.
#ifndef FIRMWARE_ROOM_H
#define FIRMWARE_ROOM_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/frame_rate.h"
#include "firmware/pose_for_frame.h"
#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/ls_fit.h"
#include "warp_fixed/method.h"
#include "warp_fixed/wall_from_corners.h"

enum {
    ROOM_MAX_BOARDS = 32,
    ROOM_MAX_NODE = 63,
    ROOM_VIEWERS = 4,
    ROOM_NAME_LENGTH = 32,
    ROOM_MESSAGE_LENGTH = 512,
    ROOM_NODES_LENGTH = 256, /**< of room_nodes(): 63 of "63, " */
    ROOM_MOST_DISPLAY_MS = 200
};

/** One projector and its wall. */
typedef struct {
    char name[ROOM_NAME_LENGTH]; /**< letters, digits, '-' and '_': it becomes part of file names */
    int32_t node;                /**< CAN node number, 1 to ROOM_MAX_NODE, its own in the room */
    wall_corners_t corners;      /**< as measured, with the projector's size */
    wall_t wall;                 /**< fitted to them */
    const warp_method_t *method;
    uint8_t viewer;          /**< whose poses it follows, 0 to 3; 0 unless stated */
    uint8_t border[3];       /**< R, G, B of unlit pixels */
    int32_t display_us;      /**< what the projector takes from the board's blank to the wall; 0 unless stated */
    bool step_all;           /**< k over the whole wall instead of over what lands in the picture */
    ls_weights_t ls_weights; /**< of the camera's columns and rows; uniform unless stated */
} room_board_t;

typedef struct {
    camera_t camera;
    int32_t board_count; /**< 1 to ROOM_MAX_BOARDS */
    room_board_t board[ROOM_MAX_BOARDS];
    int32_t bitrate, data_bitrate; /**< bit/s; 500000 and 2000000 unless stated */
    bool fd;                       /**< pose as one CAN FD frame; true unless stated */
    frame_rate_t refresh;          /**< of all panels; 60 Hz unless stated */
    bool refresh_stated;
    int32_t pose_delay_us;      /**< see frame_clock_settings_t; 2 ms unless stated */
    int32_t latency_ms;         /**< all boards as late as the slowest, and so late at least; 0, unless stated: not */
    pose_for_frame_rule_t rule; /**< which pose a picture is mapped with; the newest one unless stated */
} room_t;

/** Hears every warning of room_load(): one line without newline, "FILE:LINE: KEY: what". */
typedef void room_warning_fn(void *context, const char *line);

/**
 * Read and check a room file. Start-up only: uses the heap while it runs.
 *
 * @param[out] room     Written only when true is returned.
 * @param      path     The YAML file.
 * @param      warn     Called for what is odd but workable (a mirrored wall, a corner far from its plane); may be NULL.
 * @param      context  For warn.
 * @param[out] error    On failure: "FILE:LINE: KEY: what was found, what was expected". ROOM_MESSAGE_LENGTH bytes.
 * @return true when every key is right and every wall has a plane.
 */
bool room_load(room_t *room, const char *path, room_warning_fn *warn, void *context, char error[ROOM_MESSAGE_LENGTH]);

/** @return The board of that name, or NULL. */
const room_board_t *room_board_named(const room_t *room, const char *name);

/** @return The board with that node number, or NULL. */
const room_board_t *room_board_with_node(const room_t *room, int32_t node);

/** Write the node numbers of all boards as text, in the file's order: "1, 2, 5". */
void room_nodes(const room_t *room, char text[ROOM_NODES_LENGTH]);

#endif
