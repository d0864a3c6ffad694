// SPDX-License-Identifier: Apache-2.0
// The values of a room file: ranges, names and numbers of their own, conversion to integers.
#include "firmware/room/room_checks.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "firmware/room/room_frames.h"
#include "firmware/room/room_scalar.h"
#include "warp_fixed/image.h"

/* One axis of ls_weights; weight is NULL where it is left out. */
typedef struct {
    const double *weight;
    uint32_t count;
    int32_t expected;
    const char *each;
} weight_list_t;

static const double max_mm = 1e6, max_px = 1e6;

__attribute__((format(printf, 3, 4))) static bool refuse(const room_checker_t *checker, room_key_t key,
                                                         const char *format, ...)
{
    char message[ROOM_MESSAGE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return room_refuse(checker->report, room_places_line(checker->places, key.text), key.text, "%s", message);
}

static bool check_whole(const room_checker_t *checker, room_key_t key, int64_t value, int64_t low, int64_t high)
{
    if (value >= low && value <= high)
        return true;
    return refuse(checker, key, "found %" PRId64 ", expected %" PRId64 " to %" PRId64, value, low, high);
}

static bool check_size(const room_checker_t *checker, const char *parent, int64_t width, int64_t height)
{
    return check_whole(checker, room_key("%s.width", parent), width, 1, IMAGE_MAX_WIDTH) &&
           check_whole(checker, room_key("%s.height", parent), height, 1, IMAGE_MAX_HEIGHT);
}

static bool check_mm(const room_checker_t *checker, const char *parent, const double mm[3], int32_t um[3])
{
    for (int axis = 0; axis < 3; axis++) {
        if (fabs(mm[axis]) > max_mm) {
            const room_key_t key = room_key("%s[%d]", parent, axis);
            return refuse(checker, key, "found %.12g mm, expected -%.0f to %.0f", mm[axis], max_mm, max_mm);
        }
        um[axis] = (int32_t)lround(mm[axis] * 1000.0); /* |um| <= 10^9, fits */
    }
    return true;
}

static bool check_camera(const room_checker_t *checker, const room_yaml_camera_t *yaml, camera_t *camera)
{
    if (!check_size(checker, "camera", yaml->width, yaml->height))
        return false;
    camera->width = (int32_t)yaml->width;
    camera->height = (int32_t)yaml->height;
    for (int axis = 0; axis < 2; axis++) {
        const double focal = yaml->focal_px[axis], principal = yaml->principal_px[axis];
        if (!(focal >= 1e-6 && focal <= max_px)) {
            const room_key_t key = room_key("camera.focal_px[%d]", axis);
            return refuse(checker, key, "found %.12g px, expected 0.000001 to %.0f", focal, max_px);
        }
        if (fabs(principal) > max_px) {
            const room_key_t key = room_key("camera.principal_px[%d]", axis);
            return refuse(checker, key, "found %.12g px, expected -%.0f to %.0f", principal, max_px, max_px);
        }
        camera->focal_upx[axis] = llround(focal * 1e6);
        camera->principal_upx[axis] = llround(principal * 1e6);
    }
    return true;
}

static bool is_name(const char *name)
{
    const size_t length = strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-");
    return length > 0 && length < ROOM_NAME_LENGTH && name[length] == '\0';
}

static bool check_identity(const room_checker_t *checker, const room_yaml_board_t *yaml, room_t *room, int32_t b)
{
    const room_key_t name_key = room_key("boards[%d].name", b), node_key = room_key("boards[%d].node", b);
    if (!is_name(yaml->name)) {
        return refuse(checker, name_key, "found '%s', expected 1 to %d letters, digits, '-' or '_'",
                      room_phrase_cut(yaml->name).text, ROOM_NAME_LENGTH - 1);
    }
    if (!check_whole(checker, node_key, yaml->node, 1, ROOM_MAX_NODE))
        return false;
    for (int32_t other = 0; other < b; other++) {
        if (strcmp(room->board[other].name, yaml->name) == 0) {
            return refuse(checker, name_key, "'%s' is boards[%d] already, expected another name", yaml->name, other);
        }
        if (room->board[other].node == yaml->node) {
            return refuse(checker, node_key, "%" PRId64 " is boards[%d] already, expected another node number",
                          yaml->node, other);
        }
    }
    snprintf(room->board[b].name, ROOM_NAME_LENGTH, "%s", yaml->name);
    room->board[b].node = (int32_t)yaml->node;
    return true;
}

static bool check_corners(const room_checker_t *checker, const room_yaml_board_t *yaml, wall_corners_t *corners,
                          int32_t b)
{
    const room_key_t projector = room_key("boards[%d].projector", b);
    if (!check_size(checker, projector.text, yaml->projector.width, yaml->projector.height))
        return false;
    corners->panel_width = (int32_t)yaml->projector.width;
    corners->panel_height = (int32_t)yaml->projector.height;
    int known = 0;
    for (int c = 0; c < 4; c++) {
        const room_key_t key = room_key("boards[%d].wall.corners_mm[%d]", b, c);
        corners->corner_known[c] = yaml->wall.corner_mm[c] != NULL;
        known += corners->corner_known[c];
        if (corners->corner_known[c] && !check_mm(checker, key.text, yaml->wall.corner_mm[c], corners->corner_um[c]))
            return false;
    }
    if (known >= 3)
        return true;
    const room_key_t key = room_key("boards[%d].wall.corners_mm", b);
    return refuse(checker, key, "found %d known corners, expected 3 or 4", known);
}

static bool check_markers(const room_checker_t *checker, const room_yaml_board_t *yaml, wall_corners_t *corners,
                          int32_t b)
{
    const int32_t size[2] = {corners->panel_width, corners->panel_height};
    for (uint32_t m = 0; m < yaml->marker_count && m < WALL_MAX_MARKERS; m++) {
        wall_marker_t *marker = &corners->marker[m];
        const room_key_t mm_key = room_key("boards[%d].markers[%u].mm", b, m);
        for (int axis = 0; axis < 2; axis++) {
            const double px = yaml->marker[m].px[axis];
            if (!(px >= 0.0 && px <= size[axis])) {
                const room_key_t key = room_key("boards[%d].markers[%u].px[%d]", b, m, axis);
                return refuse(checker, key, "found %.12g, expected 0 to %d, inside the panel", px, size[axis]);
            }
            marker->px_q16[axis] = (int32_t)lround(px * 65536.0); /* <= 2^28 */
        }
        if (!check_mm(checker, mm_key.text, yaml->marker[m].mm, marker->um))
            return false;
        corners->marker_count = (int32_t)m + 1;
    }
    return true;
}

/* One axis of the weights: one for each `each` of the picture, stored with the largest as LS_WEIGHT_ONE. */
static bool check_weights(const room_checker_t *checker, room_key_t key, const weight_list_t *list, uint16_t *stored)
{
    if (list->weight == NULL)
        return true;
    if (list->count != (uint32_t)list->expected)
        return refuse(checker, key, "found a list of %u, expected %d: one per picture %s", list->count, list->expected,
                      list->each);
    double largest = 0.0;
    for (uint32_t i = 0; i < list->count; i++) {
        if (list->weight[i] < 0.0) {
            const room_key_t at = room_key("%s[%u]", key.text, i);
            return refuse(checker, at, "found %.12g, expected 0 or more", list->weight[i]);
        }
        largest = fmax(largest, list->weight[i]);
    }
    if (!(largest > 0.0))
        return refuse(checker, key, "found zeros only, expected at least one weight above 0");
    for (uint32_t i = 0; i < list->count; i++)
        stored[i] = (uint16_t)lround(list->weight[i] / largest * LS_WEIGHT_ONE);
    return true;
}

static bool check_both_weights(const room_checker_t *checker, const room_yaml_weights_t *yaml, room_t *room, int32_t b)
{
    ls_weights_t *stored = &room->board[b].ls_weights;
    ls_weights_init(stored);
    if (yaml == NULL)
        return true;
    const weight_list_t columns = {yaml->x, yaml->x_count, room->camera.width, "column"};
    const weight_list_t rows = {yaml->y, yaml->y_count, room->camera.height, "row"};
    return check_weights(checker, room_key("boards[%d].ls_weights.x", b), &columns, stored->x) &&
           check_weights(checker, room_key("boards[%d].ls_weights.y", b), &rows, stored->y);
}

static bool check_method(const room_checker_t *checker, const char *name, room_board_t *board, int32_t b)
{
    board->method = name == NULL ? warp_method_default() : warp_method_from_name(name);
    if (board->method != NULL)
        return true;
    const room_key_t key = room_key("boards[%d].method", b);
    char names[ROOM_MESSAGE_LENGTH] = "";
    size_t used = 0;
    for (int i = 0; i < WARP_METHODS && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i == 0 ? "" : ", ", warp_methods[i].name);
    return room_refuse(checker->report, room_places_line(checker->places, key.text), key.text,
                       "found '%s', expected one of %s", room_phrase_cut(name).text, names);
}

static bool check_display_delay(const room_checker_t *checker, double ms, room_board_t *board, int32_t b)
{
    if (!(ms >= 0 && ms <= ROOM_MOST_DISPLAY_MS))
        return refuse(checker, room_key("boards[%d].display_delay_ms", b), "found %.12g, expected 0 to %d", ms,
                      ROOM_MOST_DISPLAY_MS);
    board->display_us = (int32_t)lround(ms * 1000.0);
    return true;
}

static bool check_look(const room_checker_t *checker, const room_yaml_board_t *yaml, room_t *room, int32_t b)
{
    room_board_t *board = &room->board[b];
    if (!check_method(checker, yaml->method, board, b) ||
        !check_display_delay(checker, yaml->display_delay_ms, board, b) ||
        !check_whole(checker, room_key("boards[%d].viewer", b), yaml->viewer, 0, ROOM_VIEWERS - 1))
        return false;
    board->viewer = (uint8_t)yaml->viewer;
    for (int channel = 0; channel < 3; channel++) {
        if (!check_whole(checker, room_key("boards[%d].border[%d]", b, channel), yaml->border[channel], 0, 255))
            return false;
        board->border[channel] = (uint8_t)yaml->border[channel];
    }
    board->step_all = yaml->step == ROOM_YAML_STEP_ALL;
    return check_both_weights(checker, yaml->weights, room, b);
}

static bool check_can(const room_checker_t *checker, const room_yaml_can_t *yaml, room_t *room)
{
    const int64_t bitrate = yaml->bitrate == NULL ? 500000 : *yaml->bitrate;
    const int64_t data_bitrate = yaml->data_bitrate == NULL ? 2000000 : *yaml->data_bitrate;
    const room_key_t data_key = room_key("can.data_bitrate");
    if (!check_whole(checker, room_key("can.bitrate"), bitrate, 10000, 1000000) ||
        !check_whole(checker, data_key, data_bitrate, 500000, 8000000))
        return false;
    if (data_bitrate < bitrate) {
        return refuse(checker, data_key, "found %" PRId64 ", expected at least the bitrate, %" PRId64, data_bitrate,
                      bitrate);
    }
    room->bitrate = (int32_t)bitrate;
    room->data_bitrate = (int32_t)data_bitrate;
    room->fd = yaml->fd == NULL || *yaml->fd;
    return true;
}

bool room_checks(const room_checker_t *checker, const room_yaml_t *yaml, room_t *room)
{
    *room = (room_t){.board_count = (int32_t)yaml->board_count};
    if (!check_camera(checker, &yaml->camera, &room->camera))
        return false;
    for (int32_t b = 0; b < room->board_count; b++) {
        wall_corners_t *corners = &room->board[b].corners;
        if (!check_identity(checker, &yaml->board[b], room, b) ||
            !check_corners(checker, &yaml->board[b], corners, b) ||
            !check_markers(checker, &yaml->board[b], corners, b) || !check_look(checker, &yaml->board[b], room, b))
            return false;
    }
    return check_can(checker, &yaml->can, room) && room_frames_check(checker, &yaml->frames, room);
}
