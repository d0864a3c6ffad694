// SPDX-License-Identifier: Apache-2.0
// Boards of a room file, one pose, one picture -> corrected panels, with the product's own code.
#include "sim/eval/warp_once.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/files/pixel.h"
#include "sim/files/png_file.h"
#include "sim/pose/pose_text.h"

__attribute__((format(printf, 2, 3))) static void say(char error[ROOM_MESSAGE_LENGTH], const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error, ROOM_MESSAGE_LENGTH, format, arguments);
    va_end(arguments);
}

static void say_boards(char error[ROOM_MESSAGE_LENGTH], const room_t *room, const warp_once_place_t *place)
{
    char names[ROOM_MESSAGE_LENGTH] = "";
    for (int32_t b = 0; b < room->board_count; b++) {
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", b > 0 ? ", " : "", room->board[b].name);
    }
    say(error, "--board %.40s: %.200s has no such board, expected one of %.220s", place->board, place->room, names);
}

static void warn_if_mirrored(const warp_once_t *once, room_warning_fn *warn)
{
    char line[ROOM_MESSAGE_LENGTH];
    if (warn == NULL || !homography_is_mirrored(&once->homography))
        return;
    say(line,
        "--pose: sees the wall of board %s from behind, its picture is mirrored (rear projection, or corners in the "
        "wrong order)",
        once->board.name);
    warn(NULL, line);
}

/* Of the room's boards from `first` on. Only the pose can be refused, so nothing is written before it is not. */
static warp_once_status_t see_walls(warp_once_t *wall, int32_t walls, const room_t *room, const room_board_t *first,
                                    const warp_once_place_t *place, char error[ROOM_MESSAGE_LENGTH])
{
    pose_t pose;
    char reason[256];
    if (!pose_from_text(place->pose, &pose, reason)) {
        say(error, "--pose: %s", reason);
        return WARP_ONCE_BAD_USAGE;
    }
    for (int32_t n = 0; n < walls; n++) {
        homography_t homography;
        if (!homography_from_pose(&homography, &room->camera, &first[n].wall, &pose)) {
            say(error, "--pose %.200s: the quaternion is zero, expected one of unit length", place->pose);
            return WARP_ONCE_BAD_USAGE;
        }
        wall[n] = (warp_once_t){
            .camera = room->camera, .board = first[n], .homography = homography, .kernels = warp_kernels_best()};
    }
    return WARP_ONCE_OK;
}

static warp_once_status_t open_in_room(warp_once_t *wall, int32_t *walls, const room_t *room,
                                       const warp_once_place_t *place, char error[ROOM_MESSAGE_LENGTH])
{
    const room_board_t *first = room->board;
    int32_t count = room->board_count;
    if (place->board != NULL) {
        first = room_board_named(room, place->board);
        count = 1;
    }
    if (first == NULL) {
        say_boards(error, room, place);
        return WARP_ONCE_BAD_USAGE;
    }
    warp_t *warp = malloc(sizeof *warp);
    if (warp == NULL) {
        say(error, "out of memory");
        return WARP_ONCE_FAILED;
    }
    const warp_once_status_t status = see_walls(wall, count, room, first, place, error);
    if (status != WARP_ONCE_OK) {
        free(warp);
        return status;
    }
    for (int32_t n = 0; n < count; n++)
        wall[n].warp = warp;
    *walls = count;
    return WARP_ONCE_OK;
}

warp_once_status_t warp_once_open_walls(warp_once_t *wall, int32_t *walls, const warp_once_place_t *place,
                                        room_warning_fn *warn, char error[ROOM_MESSAGE_LENGTH])
{
    room_t *room = malloc(sizeof *room);
    if (room == NULL) {
        say(error, "out of memory");
        return WARP_ONCE_FAILED;
    }
    warp_once_status_t status = WARP_ONCE_FAILED;
    if (room_load(room, place->room, warn, NULL, error))
        status = open_in_room(wall, walls, room, place, error);
    free(room);
    for (int32_t n = 0; status == WARP_ONCE_OK && n < *walls; n++)
        warn_if_mirrored(&wall[n], warn);
    return status;
}

warp_once_status_t warp_once_open(warp_once_t *once, const warp_once_place_t *place, room_warning_fn *warn,
                                  char error[ROOM_MESSAGE_LENGTH])
{
    int32_t one;
    return warp_once_open_walls(once, &one, place, warn, error);
}

void warp_once_close(warp_once_t *once)
{
    free(once->warp);
    once->warp = NULL;
}

bool warp_once_read(const warp_once_t *once, const char *path, image_format_t format, image_t *picture,
                    char error[ROOM_MESSAGE_LENGTH])
{
    image_t image;
    if (!png_file_load(path, format, &image, error))
        return false;
    if (image.width != once->camera.width || image.height != once->camera.height) {
        say(error, "%s: %d x %d pixels, expected %d x %d: the room's camera", path, image.width, image.height,
            once->camera.width, once->camera.height);
        free(image.data);
        return false;
    }
    *picture = image;
    return true;
}

bool warp_once_panel(const warp_once_t *once, image_format_t format, image_t *panel)
{
    const int32_t width = once->homography.panel_width, height = once->homography.panel_height;
    const int32_t stride = width * (int32_t)format;
    uint8_t *data = calloc((size_t)height, (size_t)stride);
    if (data == NULL)
        return false;
    *panel = (image_t){.data = data, .width = width, .height = height, .stride = stride, .format = format};
    return true;
}

bool warp_once(warp_once_t *once, const warp_method_t *method, const image_t *panel, const image_t *picture)
{
    const uint8_t *rgb = once->board.border;
    const uint8_t luma = luma_from_rgb(rgb[0], rgb[1], rgb[2]);
    const uint8_t gray[3] = {luma, luma, luma};
    warp_init(once->warp, method != NULL ? *method : *once->board.method, once->board.step_all,
              picture->format == IMAGE_GRAY8 ? gray : rgb);
    warp_set_ls_weights(once->warp, &once->board.ls_weights);
    return warp_frame(once->warp, once->kernels, NULL, &once->homography, panel, picture);
}
