// SPDX-License-Identifier: Apache-2.0
// Room files: every good one is read exactly, and odd walls are warned of.
#include "firmware/room.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/scratch.h"

enum { MAX_TEXT = 4096 };

#define FRONT_CORNERS "[[-2000, -1125, 0], [2000, -1125, 0.0006], null, [-2000, 1125, -0.0004]]"
#define LEFT_CORNERS                                                                                                   \
    "        - [-2000, -1125, -4000]\n"                                                                                \
    "        - [-2000, -1125, 0]\n"                                                                                    \
    "        - [-2000, 1125, 0]\n"                                                                                     \
    "        - [-2000, 1125, -4000]\n"

/* Uses every key. */
static const char full_room[] =
    "camera: {width: 4, height: 3, focal_px: [318.75, 322.222222], principal_px: [-1, 1e1]}\n"
    "boards:\n"
    "  - name: front-1_A\n"
    "    node: 63\n"
    "    projector: {width: 1920, height: 1080}\n"
    "    wall: {corners_mm: " FRONT_CORNERS "}\n"
    "    method: gauss+linear\n"
    "    viewer: 3\n"
    "    display_delay_ms: 33.25\n"
    "    border: [1, 2, 255]\n"
    "    step: all\n"
    "    markers: [{px: [960, 540.5], mm: [0, 1.0416667, 0]}]\n"
    "    ls_weights: {x: [1, 0, 0.5, 2], y: [1, 1, 1e-3]}\n"
    "  - name: left\n"
    "    node: 1\n"
    "    projector: {width: 1280, height: 800}\n"
    "    wall:\n"
    "      corners_mm:\n" LEFT_CORNERS "can: {bitrate: 250000, data_bitrate: 1000000, fd: false}\n"
    "frames: {refresh_hz: 59.94, pose_delay_ms: 4.5, latency_ms: 60.5, pose: delay, render_ms: 33.4, content: depth, "
    "depth_mm: 5000}\n";

/* All warnings of one load, one per line. */
typedef struct {
    int count;
    char lines[MAX_TEXT];
} heard_t;

static void hear(void *context, const char *line)
{
    heard_t *heard = context;
    heard->count++;
    const size_t used = strlen(heard->lines);
    snprintf(heard->lines + used, sizeof heard->lines - used, "%s\n", line);
}

static void load_good(room_t *room, const char *path, heard_t *heard)
{
    char error[ROOM_MESSAGE_LENGTH] = "";
    *heard = (heard_t){0};
    if (!room_load(room, path, hear, heard, error))
        fail_msg("refused: %s", error);
}

/* The full room with one piece of its text replaced. */
static void write_changed(const char *path, const char *old, const char *new)
{
    const char *at = strstr(full_room, old);
    assert_non_null(at);
    char text[MAX_TEXT];
    const int length = snprintf(text, sizeof text, "%.*s%s%s", (int)(at - full_room), full_room, new, at + strlen(old));
    scratch_write(path, text, (size_t)length);
}

static void test_oracle_rooms_are_read(void **state)
{
    (void)state;
    static const char *const paths[] = {"room_480x270_eq", "room_480x270_gt", "room_480x270_low", "room_eq",
                                        "room_gt",         "room_low",        "room_grid"};
    static room_t room;
    heard_t heard;
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        char path[SCRATCH_PATH_LENGTH];
        snprintf(path, sizeof path, "tests/oracle/%s.yaml", paths[i]);
        load_good(&room, path, &heard);
        assert_int_equal(room.board_count, i == 6 ? 24 : 1);
    }
    assert_int_equal(room_board_named(&room, "w09")->corners.corner_um[1][2], -7595705);
    load_good(&room, "tests/oracle/room_gt.yaml", &heard);
    assert_int_equal(heard.count, 0);
    assert_int_equal(room.camera.width, 1920);
    assert_int_equal(room.camera.height, 1080);
    assert_int_equal(room.board[0].corners.panel_width, 960);
    assert_int_equal(room.board[0].wall.panel_height, 540);
}

static void test_optional_keys_have_their_defaults(void **state)
{
    (void)state;
    static room_t room;
    heard_t heard;
    load_good(&room, "tests/oracle/room_eq.yaml", &heard);
    assert_string_equal(room.board[0].method->name, "mean+cubic");
    assert_int_equal(room.board[0].border[0] + room.board[0].border[1] + room.board[0].border[2], 0);
    assert_int_equal(room.board[0].viewer, 0);
    assert_int_equal(room.board[0].display_us, 0);
    assert_int_equal(room.latency_ms, 0);
    assert_false(room.board[0].step_all);
    assert_int_equal(room.board[0].corners.marker_count, 0);
    assert_int_equal(room.bitrate, 500000);
    assert_int_equal(room.data_bitrate, 2000000);
    assert_true(room.fd);
    assert_true(room.refresh.frames == 60 && room.refresh.seconds == 1 && !room.refresh_stated);
    assert_int_equal(room.pose_delay_us, 2000);
    assert_true(room.rule.mode == POSE_FOR_FRAME_LATEST && room.rule.content == POSE_FOR_FRAME_WALL);
}

static void test_every_key_is_read(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "full.yaml", path);
    scratch_write(path, full_room, strlen(full_room));
    static room_t room;
    heard_t heard;
    load_good(&room, path, &heard);
    assert_string_equal(heard.lines, "");
    assert_true(room.camera.focal_upx[0] == 318750000 && room.camera.focal_upx[1] == 322222222);
    assert_true(room.camera.principal_upx[0] == -1000000 && room.camera.principal_upx[1] == 10000000);
    assert_int_equal(room.board_count, 2);
    assert_int_equal(room.bitrate, 250000);
    assert_int_equal(room.data_bitrate, 1000000);
    assert_false(room.fd);
    assert_true(room.refresh.frames == 60000 && room.refresh.seconds == 1001 && room.refresh_stated);
    assert_int_equal(room.pose_delay_us, 4500);
    assert_int_equal(room.latency_ms, 61);
    assert_true(room.rule.mode == POSE_FOR_FRAME_DELAY && room.rule.content == POSE_FOR_FRAME_DEPTH);
    assert_int_equal(room.rule.render_us, 33400);
    assert_int_equal(room.rule.depth_um, 5000000);
    const room_board_t *front = room_board_named(&room, "front-1_A");
    assert_ptr_equal(front, &room.board[0]);
    assert_int_equal(front->node, 63);
    assert_string_equal(front->method->name, "gauss+linear");
    static const uint8_t border[3] = {1, 2, 255};
    assert_memory_equal(front->border, border, sizeof border);
    assert_int_equal(front->viewer, 3);
    assert_int_equal(front->display_us, 33250);
    assert_true(front->step_all);
}

static void test_lengths_are_rounded_to_micrometres(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "full.yaml", path);
    scratch_write(path, full_room, strlen(full_room));
    static room_t room;
    heard_t heard;
    load_good(&room, path, &heard);
    const wall_corners_t *front = &room.board[0].corners;
    static const int32_t expected[4][3] = {
        {-2000000, -1125000, 0}, {2000000, -1125000, 1}, {0}, {-2000000, 1125000, 0}};
    assert_memory_equal(front->corner_um, expected, sizeof expected);
    assert_true(front->corner_known[0] && front->corner_known[1] && !front->corner_known[2] && front->corner_known[3]);
    assert_int_equal(front->marker_count, 1);
    assert_int_equal(front->marker[0].px_q16[0], 960 * 65536);
    assert_int_equal(front->marker[0].px_q16[1], 540 * 65536 + 32768);
    assert_int_equal(front->marker[0].um[1], 1042);
    write_changed(path, "0.0006]", "-999999.9996]");
    char error[ROOM_MESSAGE_LENGTH];
    assert_true(room_load(&room, path, NULL, NULL, error));
    assert_int_equal(room.board[0].corners.corner_um[1][2], -1000000000);
}

static void test_boards_are_found_by_name_and_node(void **state)
{
    (void)state;
    static room_t room;
    heard_t heard;
    load_good(&room, "tests/oracle/room_grid.yaml", &heard);
    assert_ptr_equal(room_board_named(&room, "w23"), &room.board[23]);
    assert_ptr_equal(room_board_with_node(&room, 24), &room.board[23]);
    assert_null(room_board_named(&room, "w24"));
    assert_null(room_board_named(&room, "w2"));
    assert_null(room_board_with_node(&room, 0));
    assert_null(room_board_with_node(&room, 25));
    char nodes[ROOM_NODES_LENGTH];
    room_nodes(&room, nodes);
    assert_string_equal(nodes, "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24");
}

static void test_odd_walls_are_warned_of(void **state)
{
    static const struct {
        const char *old, *new, *warning;
    } odd[] = {
        {"[-2000, 1125, -0.0004]", "[-1900, 1125, 0]", "6: boards[0].wall.corners_mm: three corners make an angle 2.5"},
        {"1.0416667, 0]", "1.0416667, 30]", "6: boards[0].wall.corners_mm: a point lies "},
        {"[960, 540.5]", "[950, 540.5]", "6: boards[0].wall.corners_mm: a marker lies 20.8 mm "},
        {FRONT_CORNERS, "[[2000, -1125, 0], [-2000, -1125, 0], null, [2000, 1125, 0]]",
         "6: boards[0].wall.corners_mm: mirrored as seen from the other walls"},
        {LEFT_CORNERS, "        [[-2000, -1125, 0], [-2000, -1125, -4000], [-2000, 1125, -4000], [-2000, 1125, 0]]\n",
         "18: boards[1].wall.corners_mm: mirrored as seen from the other walls"},
        {FRONT_CORNERS, "[[-2, -1.125, 0], [2, -1.125, 0], null, [-2, 1.125, 0]]",
         "6: boards[0].wall.corners_mm: the wall is 4.59 mm from corner to corner: are these metres?"},
    };
    char path[SCRATCH_PATH_LENGTH], expected[MAX_TEXT];
    scratch_path(*state, "odd.yaml", path);
    static room_t room;
    heard_t heard;
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        write_changed(path, odd[i].old, odd[i].new);
        load_good(&room, path, &heard);
        snprintf(expected, sizeof expected, "%s:%s", path, odd[i].warning);
        if (strstr(heard.lines, expected) == NULL)
            fail_msg("heard:\n%sexpected:\n%s", heard.lines, expected);
        char error[ROOM_MESSAGE_LENGTH];
        assert_true(room_load(&room, path, NULL, NULL, error));
    }
}

static void test_walls_side_by_side_are_not_mirrored(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "wide.yaml", path);
    write_changed(path, LEFT_CORNERS,
                  "        [[-6000, -1125, 20], [-2000, -1125, 20], [-2000, 1125, 20], [-6000, 1125, 20]]\n");
    static room_t room;
    heard_t heard;
    load_good(&room, path, &heard);
    assert_string_equal(heard.lines, "");
    write_changed(path, LEFT_CORNERS,
                  "        [[-6000, -1125, -20], [-2000, -1125, -20], [-2000, 1125, -20], [-6000, 1125, -20]]\n");
    load_good(&room, path, &heard);
    assert_string_equal(heard.lines, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_oracle_rooms_are_read),
        cmocka_unit_test(test_optional_keys_have_their_defaults),
        cmocka_unit_test(test_every_key_is_read),
        cmocka_unit_test(test_lengths_are_rounded_to_micrometres),
        cmocka_unit_test(test_boards_are_found_by_name_and_node),
        cmocka_unit_test(test_odd_walls_are_warned_of),
        cmocka_unit_test(test_walls_side_by_side_are_not_mirrored),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
