// SPDX-License-Identifier: Apache-2.0
// Boards of a room file, one pose, one picture -> corrected panels, with the product's own code.
#ifndef SIM_EVAL_WARP_ONCE_H
#define SIM_EVAL_WARP_ONCE_H

#include "firmware/room.h"
#include "warp_fixed/image.h"
#include "warp_fixed/warp.h"

/** Values are exit statuses of programs. */
typedef enum {
    WARP_ONCE_OK = 0,
    WARP_ONCE_FAILED = 1,   /**< a file is missing or wrong, or no memory */
    WARP_ONCE_BAD_USAGE = 2 /**< a board that the room does not have, or a text that is no pose */
} warp_once_status_t;

/** One wall seen from one pose. */
typedef struct {
    camera_t camera;
    room_board_t board;
    homography_t homography;
    warp_t *warp;                  /**< of the last method used */
    const warp_kernels_t *kernels; /**< the fastest; may be changed */
} warp_once_t;

/** Which wall, seen from where: as on a command line. */
typedef struct {
    const char *room;  /**< path of the room file */
    const char *board; /**< name of the board; NULL for every board of the room */
    const char *pose;  /**< "x_mm y_mm z_mm qw qx qy qz" */
} warp_once_place_t;

/**
 * Read the room and the pose.
 *
 * @param[out] once   Written only when WARP_ONCE_OK is returned; to be given to warp_once_close().
 * @param      place  The three texts; none may be NULL here.
 * @param      warn   Hears the room file's warnings, and of a wall seen from behind, with context NULL; may be NULL.
 * @param[out] error  On failure: one line, which input, what was found, what was expected.
 */
warp_once_status_t warp_once_open(warp_once_t *once, const warp_once_place_t *place, room_warning_fn *warn,
                                  char error[ROOM_MESSAGE_LENGTH]);

/**
 * The same for the boards that the place names: one, or every one of the room, in its order.
 *
 * @param[out] wall   Room for ROOM_MAX_BOARDS, or for 1 where a board is named. They share one warp: only the first is
 *                    to be given to warp_once_close().
 * @param[out] walls  How many.
 */
warp_once_status_t warp_once_open_walls(warp_once_t *wall, int32_t *walls, const warp_once_place_t *place,
                                        room_warning_fn *warn, char error[ROOM_MESSAGE_LENGTH]);

/** Give back its memory. */
void warp_once_close(warp_once_t *once);

/**
 * Read a PNG that must have the camera's size.
 *
 * @param[out] picture  Written only on success; the caller frees picture->data.
 * @param[out] error    On failure: one line "FILE: what, what was expected".
 */
bool warp_once_read(const warp_once_t *once, const char *path, image_format_t format, image_t *picture,
                    char error[ROOM_MESSAGE_LENGTH]);

/**
 * Make an empty panel of the board's size.
 *
 * @param[out] panel  Written only on success; the caller frees panel->data.
 * @return false when memory is out.
 */
bool warp_once_panel(const warp_once_t *once, image_format_t format, image_t *panel);

/**
 * Correct a picture with warp_frame(), with the board's border and choice of step.
 *
 * @param method   NULL for the board's own.
 * @param panel    From warp_once_panel(), of the picture's format.
 * @param picture  Of the camera's size. The border of a GRAY8 picture is the colour's luma.
 * @return false, and nothing written, when sizes or formats disagree.
 */
bool warp_once(warp_once_t *once, const warp_method_t *method, const image_t *panel, const image_t *picture);

#endif
