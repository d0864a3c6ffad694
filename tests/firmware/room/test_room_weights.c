// SPDX-License-Identifier: Apache-2.0
// Weights of method ls in room files: stored relative to each axis' largest, uniform unless stated, for every board.
#include "firmware/room.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/scratch.h"

static room_t room;

static void write_camera(FILE *file, int width, int height)
{
    fprintf(file, "camera: {width: %d, height: %d, focal_px: [1200, 1200], principal_px: [960, 540]}\nboards:\n", width,
            height);
}

static void write_board(FILE *file, int b)
{
    fprintf(file, "  - name: board%d\n    node: %d\n    projector: {width: 1920, height: 1080}\n", b, b + 1);
    fputs("    wall: {corners_mm: [[-2000, -1125, 0], [2000, -1125, 0], [2000, 1125, 0], [-2000, 1125, 0]]}\n", file);
}

static void load(const char *path)
{
    char error[ROOM_MESSAGE_LENGTH] = "";
    memset(&room, 0xa5, sizeof room);
    if (!room_load(&room, path, NULL, NULL, error))
        fail_msg("%s", error);
}

/* One board with these weights in a room with a picture of 5 x 3. */
static const ls_weights_t *weights_from(void **state, const char *text)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "weights.yaml", path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    write_camera(file, 5, 3);
    write_board(file, 0);
    fputs(text, file);
    fclose(file);
    load(path);
    return &room.board[0].ls_weights;
}

static void check_axis(const uint16_t *stored, int size, const uint16_t *expected)
{
    for (int i = 0; i < size; i++)
        assert_int_equal(stored[i], expected == NULL ? LS_WEIGHT_ONE : expected[i]);
}

static void test_weights_are_relative_to_the_largest(void **state)
{
    static const uint16_t x[5] = {16384, 0, 8192, 32768, 33}, y[3] = {32768, 32768, 16};
    const ls_weights_t *weights = weights_from(state, "    ls_weights: {x: [1, 0, 0.5, 2, 2e-3], y: [7, 7, 0.0035]}\n");
    check_axis(weights->x, 5, x);
    check_axis(weights->y, 3, y);
    weights =
        weights_from(state, "    ls_weights: {x: [1e300, 0, 5e299, 2e300, 2e297], y: [1e-300, 1e-300, 5e-304]}\n");
    static const uint16_t huge[5] = {16384, 0, 8192, 32768, 33};
    check_axis(weights->x, 5, huge);
    check_axis(weights->y, 3, y);
}

static void test_weights_are_uniform_unless_stated(void **state)
{
    static const uint16_t x[5] = {0, 0, 0, 32768, 0}, y[3] = {32768, 0, 0};
    const ls_weights_t *weights = weights_from(state, "");
    check_axis(weights->x, IMAGE_MAX_WIDTH, NULL);
    check_axis(weights->y, IMAGE_MAX_HEIGHT, NULL);
    weights = weights_from(state, "    ls_weights: {}\n");
    check_axis(weights->x, 5, NULL);
    check_axis(weights->y, 3, NULL);
    weights = weights_from(state, "    ls_weights: {x: [0, 0, 0, 9, 0]}\n");
    check_axis(weights->x, 5, x);
    check_axis(weights->y, 3, NULL);
    weights = weights_from(state, "    ls_weights: {y: [1, 0, 0]}\n");
    check_axis(weights->x, 5, NULL);
    check_axis(weights->y, 3, y);
}

static void write_list(FILE *file, const char *name, int count, int b)
{
    fprintf(file, "      %s: [", name);
    for (int i = 0; i < count; i++)
        fprintf(file, "%s%.17f", i == 0 ? "" : ", ", i == b ? 1 : 0.5);
    fputs("]\n", file);
}

/* The largest room there is, with all digits of a double. */
static void test_every_board_can_have_all_its_weights(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "large.yaml", path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    write_camera(file, IMAGE_MAX_WIDTH, IMAGE_MAX_HEIGHT);
    for (int b = 0; b < ROOM_MAX_BOARDS; b++) {
        write_board(file, b);
        fputs("    ls_weights:\n", file);
        write_list(file, "x", IMAGE_MAX_WIDTH, b);
        write_list(file, "y", IMAGE_MAX_HEIGHT, b);
    }
    fclose(file);
    load(path);
    assert_int_equal(room.board_count, ROOM_MAX_BOARDS);
    for (int b = 0; b < ROOM_MAX_BOARDS; b++) {
        for (int i = 0; i < IMAGE_MAX_WIDTH; i++)
            assert_int_equal(room.board[b].ls_weights.x[i], i == b ? LS_WEIGHT_ONE : LS_WEIGHT_ONE / 2);
        for (int j = 0; j < IMAGE_MAX_HEIGHT; j++)
            assert_int_equal(room.board[b].ls_weights.y[j], j == b ? LS_WEIGHT_ONE : LS_WEIGHT_ONE / 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_weights_are_relative_to_the_largest),
        cmocka_unit_test(test_weights_are_uniform_unless_stated),
        cmocka_unit_test(test_every_board_can_have_all_its_weights),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
