// SPDX-License-Identifier: Apache-2.0
// Damaged room files: flipped bytes, missing lines and ends never crash and are never half accepted.
#include "firmware/room.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/rng.h"
#include "tests/support/scratch.h"
#include "warp_fixed/image.h"

enum { ROUNDS = 6000, MAX_TEXT = 4096, MAX_DAMAGES = 4 };

static const char good_room[] =
    "camera: {width: 5, height: 4, focal_px: [12.5, 12], principal_px: [2.5, 2]}\n"
    "boards:\n"
    "  - name: front\n"
    "    node: 1\n"
    "    projector: {width: 1920, height: 1080}\n"
    "    wall: {corners_mm: [[-2000, -1125, 0], [2000, -1125, 0], null, [-2000, 1125, 0]]}\n"
    "    ls_weights:\n"
    "      x: [1, 2, 3, 4, 5]\n"
    "      y: [1, 1, 1, 1]\n"
    "  - name: left\n"
    "    node: 2\n"
    "    projector: {width: 1280, height: 800}\n"
    "    wall:\n"
    "      corners_mm:\n"
    "        - [-2000, -1125, -4000]\n"
    "        - [-2000, -1125, 0]\n"
    "        - [-2000, 1125, 0]\n"
    "        - [-2000, 1125, -4000]\n"
    "    method: mean+cubic\n"
    "    border: [0, 128, 255]\n"
    "    step: in\n"
    "    markers: [{px: [640, 400], mm: [-2000, 0, -2000]}]\n"
    "can: {bitrate: 500000, data_bitrate: 2000000, fd: true}\n";

typedef struct {
    char bytes[2 * MAX_TEXT];
    size_t length;
} text_t;

static void delete_bytes(text_t *text, size_t at, size_t count)
{
    memmove(text->bytes + at, text->bytes + at + count, text->length - at - count);
    text->length -= count;
}

static void insert_bytes(text_t *text, size_t at, const char *bytes, size_t count)
{
    if (text->length + count > sizeof text->bytes)
        return;
    memmove(text->bytes + at + count, text->bytes + at, text->length - at);
    memcpy(text->bytes + at, bytes, count);
    text->length += count;
}

/* [begin, end) of the line around a position. */
static void line_around(const text_t *text, size_t at, size_t *begin, size_t *end)
{
    *begin = *end = at;
    while (*begin > 0 && text->bytes[*begin - 1] != '\n')
        (*begin)--;
    while (*end < text->length && text->bytes[(*end)++] != '\n')
        ;
}

static void damage(text_t *text, rng_t *rng)
{
    static const char *const pieces[] = {"[",    "]",     "{",    "}",   ":",   ", ",   "-",     "\n",  "\t",  "0",
                                         "9",    "null",  ".nan", "1e9", "&a ", "*a",   "!!str", "\"",  "'",   "|\n",
                                         "<<: ", "---\n", "# ",   "? ",  "%",   "true", "0x1",   "1.5", "\\0", "~"};
    if (text->length == 0)
        return;
    const size_t at = (size_t)rng_int(rng, 0, (int64_t)text->length - 1);
    size_t begin, end;
    line_around(text, at, &begin, &end);
    const int64_t kind = rng_int(rng, 0, 5);
    if (kind == 0) {
        text->bytes[at] = (char)((unsigned char)text->bytes[at] ^ (1u << rng_int(rng, 0, 7)));
    } else if (kind == 1) {
        text->bytes[at] = (char)(unsigned char)rng_int(rng, 0, 255);
    } else if (kind == 2) {
        delete_bytes(text, begin, end - begin);
    } else if (kind == 3) {
        char line[MAX_TEXT];
        const size_t count = end - begin < sizeof line ? end - begin : sizeof line;
        memcpy(line, text->bytes + begin, count);
        insert_bytes(text, begin, line, count);
    } else if (kind == 4) {
        const char *piece = pieces[rng_int(rng, 0, (int64_t)(sizeof pieces / sizeof pieces[0]) - 1)];
        insert_bytes(text, at, piece, strlen(piece));
    } else if (rng_int(rng, 0, 7) == 0) {
        text->length = at;
    } else {
        delete_bytes(text, at, 1);
    }
}

static const char *board_fault(const room_board_t *board)
{
    int known = 0;
    for (int c = 0; c < 4; c++)
        known += board->corners.corner_known[c];
    if (known < 3)
        return "fewer than three corners";
    if (board->name[0] == '\0' || board->node < 1 || board->node > ROOM_MAX_NODE || board->method == NULL)
        return "no name, node or method";
    if (board->corners.panel_width < 1 || board->corners.panel_width > IMAGE_MAX_WIDTH ||
        board->corners.panel_height < 1 || board->corners.panel_height > IMAGE_MAX_HEIGHT)
        return "bad panel size";
    if (board->wall.panel_width != board->corners.panel_width || real_sign(board->wall.weight[2]) <= 0)
        return "no wall";
    return NULL;
}

static const char *room_fault(const room_t *room)
{
    if (room->camera.width < 1 || room->camera.width > IMAGE_MAX_WIDTH || room->camera.height < 1 ||
        room->camera.height > IMAGE_MAX_HEIGHT || room->camera.focal_upx[0] <= 0 || room->camera.focal_upx[1] <= 0)
        return "bad camera";
    if (room->board_count < 1 || room->board_count > ROOM_MAX_BOARDS)
        return "bad number of boards";
    if (room->bitrate < 10000 || room->bitrate > 1000000 || room->data_bitrate < room->bitrate)
        return "bad bit rate";
    for (int32_t b = 0; b < room->board_count; b++)
        if (board_fault(&room->board[b]) != NULL)
            return board_fault(&room->board[b]);
    return NULL;
}

/* "PATH:LINE: KEY: found, expected" in one line, and never left to libcyaml's words. */
static const char *message_fault(const char *error, const char *path)
{
    const size_t length = strlen(path);
    if (strncmp(error, path, length) != 0 || error[length] != ':')
        return "does not begin with the path";
    char *end = NULL;
    if (strtol(error + length + 1, &end, 10) < 1 || strncmp(end, ": ", 2) != 0)
        return "has no line";
    if (strstr(end, "expected ") == NULL)
        return "does not say what was expected";
    for (const char *c = error; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20)
            return "holds a control character";
    return strstr(error, "libcyaml") == NULL ? NULL : "was left to libcyaml";
}

static void test_damaged_rooms_are_refused_or_sound(void **state)
{
    const uint64_t seed = 20240607;
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "damaged.yaml", path);
    static room_t room;
    int good = 0;
    for (uint64_t round = 0; round < ROUNDS; round++) {
        rng_t rng = {seed + round};
        text_t text = {.length = strlen(good_room)};
        memcpy(text.bytes, good_room, text.length);
        for (int64_t count = rng_int(&rng, 1, MAX_DAMAGES); count > 0; count--)
            damage(&text, &rng);
        scratch_write(path, text.bytes, text.length);
        char error[ROOM_MESSAGE_LENGTH] = "";
        const bool read = room_load(&room, path, NULL, NULL, error);
        good += read;
        const char *fault = read ? room_fault(&room) : message_fault(error, path);
        if (fault != NULL)
            fail_msg("seed %llu, round %llu: %s\n%s\n%.*s", (unsigned long long)seed, (unsigned long long)round, fault,
                     error, (int)text.length, text.bytes);
    }
    /* Both outcomes must be common, or the damage is of the wrong kind. */
    assert_true(good > ROUNDS / 50 && good < ROUNDS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_damaged_rooms_are_refused_or_sound),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
