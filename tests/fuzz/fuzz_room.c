// SPDX-License-Identifier: Apache-2.0
// Fuzzes the room file: any bytes are a sound room, or an error of one line and the room untouched.
#include "firmware/room.h"

#include <string.h>

#include "tests/fuzz/input.h"
#include "warp_fixed/footprint_from_homography.h"

enum { UNTOUCHED = 0xa5 };

static void hear_warning(void *context, const char *line)
{
    (void)context;
    fuzz_check_line(line);
}

static void check_untouched(const room_t *room)
{
    const uint8_t *byte = (const uint8_t *)room;
    for (size_t i = 0; i < sizeof *room; i++)
        fuzz_check(byte[i] == UNTOUCHED, "a refused file leaves the room untouched");
}

static void check_size(int32_t width, int32_t height)
{
    fuzz_check(width >= 1 && width <= IMAGE_MAX_WIDTH, "a width fits the buffers");
    fuzz_check(height >= 1 && height <= IMAGE_MAX_HEIGHT, "a height fits the buffers");
}

static void check_board(const room_t *room, const room_board_t *board)
{
    check_size(board->corners.panel_width, board->corners.panel_height);
    fuzz_check(board->wall.panel_width == board->corners.panel_width, "the wall has the projector's width");
    fuzz_check(board->wall.panel_height == board->corners.panel_height, "the wall has the projector's height");
    fuzz_check(memchr(board->name, '\0', sizeof board->name) != NULL, "a name ends");
    fuzz_check(board->name[0] != '\0' && strpbrk(board->name, "/\\ \n.%") == NULL, "a name fits into a file's name");
    fuzz_check(room_board_named(room, board->name) == board, "a name is its own in the room");
    fuzz_check(board->node >= 1 && board->node <= ROOM_MAX_NODE, "a node number is in range");
    fuzz_check(room_board_with_node(room, board->node) == board, "a node number is its own in the room");
    fuzz_check(board->method != NULL && warp_method_from_name(board->method->name) == board->method, "a known method");

    const pose_t pose = {.quaternion_q30 = {1 << 30}};
    homography_t homography;
    fuzz_check(homography_from_pose(&homography, &room->camera, &board->wall, &pose), "a wall has a homography");
    const footprint_step_t step = footprint_step(&homography);
    fuzz_check(step.in_q16 >= 0 && step.in_q16 <= FOOTPRINT_MAX_STEP_Q16, "k is in range");
    fuzz_check(step.all_q16 >= 0 && step.all_q16 <= FOOTPRINT_MAX_STEP_Q16, "k is in range over the wall");
}

static void check_room(const room_t *room)
{
    check_size(room->camera.width, room->camera.height);
    fuzz_check(room->camera.focal_upx[0] > 0 && room->camera.focal_upx[1] > 0, "focal lengths are positive");
    fuzz_check(room->board_count >= 1 && room->board_count <= ROOM_MAX_BOARDS, "there are boards, and not too many");
    fuzz_check(room->bitrate >= 10000 && room->data_bitrate >= 500000, "bit rates are in range");
    for (int32_t b = 0; b < room->board_count; b++)
        check_board(room, &room->board[b]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    room_t room;
    char error[ROOM_MESSAGE_LENGTH] = "";
    memset(&room, UNTOUCHED, sizeof room);
    const input_file_t file = input_file_open(data, size);
    if (room_load(&room, file.path, hear_warning, NULL, error)) {
        check_room(&room);
    } else {
        check_untouched(&room);
        fuzz_check(memchr(error, '\0', sizeof error) != NULL, "an error ends");
        fuzz_check_line(error);
    }
    input_file_close(&file);
    return 0;
}
