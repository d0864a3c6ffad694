// SPDX-License-Identifier: Apache-2.0
// The board's own file: every key is read, paths are beside it, what is wrong is refused by line and key.
#include "firmware/board_config.h"

#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "firmware/options.h"
#include "tests/support/scratch.h"

enum { MOST_TEXT = 4096 };

/* The tests that need no board of their own have this one. */
const board_table_t board_table = {
    .name = "bench", .can = "can7", .camera = "camera7", .display = "display7", .workers = {.count = 3}};

static void write_config(const scratch_t *scratch, char path[SCRATCH_PATH_LENGTH], const char *text)
{
    scratch_path(scratch, "wallwarp.yaml", path);
    scratch_write(path, text, strlen(text));
}

static board_config_t load_good(const char *path)
{
    board_config_t config;
    char error[ROOM_MESSAGE_LENGTH] = "";
    if (!board_config_load(&config, path, error))
        fail_msg("refused: %s", error);
    return config;
}

/* Refused with this message after "PATH:", and nothing is read. */
static void expect_refused(const scratch_t *scratch, const char *text, const char *message)
{
    char path[SCRATCH_PATH_LENGTH], error[ROOM_MESSAGE_LENGTH] = "";
    board_config_t config, untouched;
    memset(&config, 0x5a, sizeof config);
    memset(&untouched, 0x5a, sizeof untouched);
    write_config(scratch, path, text);
    if (board_config_load(&config, path, error))
        fail_msg("read, expected the error %s, of:\n%s", message, text);
    const size_t length = strlen(path);
    if (strncmp(error, path, length) != 0 || error[length] != ':' || strcmp(error + length + 1, message) != 0)
        fail_msg("found the error:\n%s\nexpected after the path:\n%s", error, message);
    assert_memory_equal(&config, &untouched, sizeof config);
}

static void test_every_key_is_read(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    write_config(*state, path,
                 "node: 63\nroom: /data/room.yaml\nkey: /data/room.key\ncan: can1\ncamera: v4l2:/dev/video2\n"
                 "display: \"HDMI-A-2\"\nworkers: 4\n");
    const board_config_t config = load_good(path);
    assert_int_equal(config.node, 63);
    assert_string_equal(config.room, "/data/room.yaml");
    assert_string_equal(config.key, "/data/room.key");
    assert_string_equal(config.can, "can1");
    assert_string_equal(config.camera, "v4l2:/dev/video2");
    assert_string_equal(config.display, "HDMI-A-2");
    assert_int_equal(config.workers, 4);
}

/* As editors of other systems write it. */
static void test_line_ends_and_a_byte_order_mark_are_of_no_account(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    write_config(*state, path, "\xef\xbb\xbfnode: 7\r\nroom: /r\r\n# can: can1\r\ndisplay: auto\r\n");
    const board_config_t config = load_good(path);
    assert_int_equal(config.node, 7);
    assert_string_equal(config.room, "/r");
    assert_string_equal(config.can, "");
    assert_string_equal(config.display, "auto");
}

static void test_most_keys_may_be_left_out(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    write_config(*state, path, "room: /r\nnode: 1\n");
    const board_config_t config = load_good(path);
    assert_int_equal(config.node, 1);
    assert_string_equal(config.key, "");
    assert_string_equal(config.can, "");
    assert_string_equal(config.camera, "");
    assert_string_equal(config.display, "");
    assert_int_equal(config.workers, 0);
}

/* The folder that a file was written to, as the system names it. */
static void expect_beside(const char *file, const char *name, const char *found)
{
    char *folder = realpath(file, NULL);
    assert_non_null(folder);
    strrchr(folder, '/')[1] = '\0';
    char expected[PATH_MAX];
    snprintf(expected, sizeof expected, "%.3000s%s", folder, name);
    free(folder);
    assert_string_equal(found, expected);
}

static void test_files_are_beside_the_configuration(void **state)
{
    char path[SCRATCH_PATH_LENGTH], link[SCRATCH_PATH_LENGTH];
    write_config(*state, path, "node: 1\nroom: studio.yaml\nkey: keys/room.key\ncamera: pattern.png\n");
    board_config_t config = load_good(path);
    expect_beside(path, "studio.yaml", config.room);
    expect_beside(path, "keys/room.key", config.key);
    assert_string_equal(config.camera, "pattern.png");

    scratch_t elsewhere;
    scratch_open(&elsewhere);
    scratch_path(&elsewhere, "wallwarp.yaml", link);
    char *whole = realpath(path, NULL);
    assert_non_null(whole);
    assert_int_equal(symlink(whole, link), 0);
    free(whole);
    config = load_good(link);
    scratch_close(&elsewhere);
    expect_beside(path, "studio.yaml", config.room);
}

static void test_what_is_wrong_is_refused(void **state)
{
    static const struct {
        const char *text, *message;
    } wrong[] = {
        {"", "1: file: empty, expected the keys node, room"},
        {"node: 0\nroom: r\n", "1: node: found 0, expected 1 to 63"},
        {"room: r\nnode: 64\n", "2: node: found 64, expected 1 to 63"},
        {"node: one\nroom: r\n", "1: node: found 'one', expected a whole number"},
        {"node: 1\n", "1: room: missing, expected a text"},
        {"room: r\n", "1: node: missing, expected a whole number"},
        {"node: 1\nroom: [r]\n", "2: room: found a list of 1, expected a text"},
        {"node: 1\nroom: \"\"\n", "2: room: found \"\", expected a name"},
        {"node: 1\nroom: r\ncan: \"a\\nb\"\n",
         "3: can: found a line end or another control character, expected a name"},
        {"node: 1\nroom: r\ncan: \"\\x1b[2J\"\n",
         "3: can: found a line end or another control character, expected a name"},
        {"node: 1\nroom: r\ncan: \"\\x7f\"\n",
         "3: can: found a line end or another control character, expected a name"},
        {"node: 1\nroom: r\nworkers: 5\n", "3: workers: found 5, expected 1 to 4"},
        {"node: 1\nroom: r\nworkers: 0\n", "3: workers: found 0, expected 1 to 4"},
        {"node: 1\nroom: r\nNODE: 2\n", "3: NODE: unknown key, expected one of node, room, key, can, camera, display, "
                                        "workers"},
        {"node: 1\nroom: r\nnode: 2\n", "3: node: found a second time, expected only the one of line 1"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        expect_refused(*state, wrong[i].text, wrong[i].message);
}

static void test_long_names_are_refused(void **state)
{
    char text[MOST_TEXT], message[MOST_TEXT], name[BOARD_CONFIG_PATH_LENGTH + 1];
    memset(name, 'x', sizeof name);
    name[0] = '/';
    name[BOARD_CONFIG_NAME_LENGTH] = '\0';
    snprintf(text, sizeof text, "node: 1\nroom: r\ndisplay: %s\n", name);
    expect_refused(*state, text, "3: display: found a name of 256 bytes, expected 255 at most");
    name[BOARD_CONFIG_NAME_LENGTH] = 'x';
    name[BOARD_CONFIG_PATH_LENGTH] = '\0';
    snprintf(text, sizeof text, "node: 1\nroom: %s\n", name);
    expect_refused(*state, text, "2: room: found a name of 1024 bytes, expected 1023 at most");

    char path[SCRATCH_PATH_LENGTH];
    write_config(*state, path, "node: 1\nroom: r\n");
    const size_t folder = strlen(load_good(path).room) - 1;
    snprintf(text, sizeof text, "node: 1\nroom: %s\n", name + 1);
    snprintf(message, sizeof message, "2: room: found a name of %zu bytes with its folder, expected 1023 at most",
             folder + BOARD_CONFIG_PATH_LENGTH - 1);
    expect_refused(*state, text, message);
    name[BOARD_CONFIG_PATH_LENGTH - folder] = '\0'; /* fits, with its folder and end */
    snprintf(text, sizeof text, "node: 1\nroom: %s\n", name + 1);
    write_config(*state, path, text);
    assert_int_equal(strlen(load_good(path).room), BOARD_CONFIG_PATH_LENGTH - 1);
}

static void test_a_missing_file_is_refused(void **state)
{
    char path[SCRATCH_PATH_LENGTH], error[ROOM_MESSAGE_LENGTH] = "";
    scratch_path(*state, "none.yaml", path);
    board_config_t config;
    assert_false(board_config_load(&config, path, error));
    assert_non_null(strstr(error, "1: file: cannot be opened (No such file or directory), expected a board's "
                                  "configuration in YAML"));
}

/* Whatever else is wrong, a board is to say so with its node, on its bus and wall. */
static void test_what_can_be_made_out_of_a_wrong_file(void **state)
{
    static const struct {
        const char *text;
        int32_t node;
        const char *can, *display;
    } wrong[] = {
        {"node: 3\nroom: r\ncan: can1\ndisplay: HDMI-A-2\nNODE: 2\n", 3, "can1", "HDMI-A-2"},
        {"node: 63 # of twelve\r\n  can: can1#\r\nroom: [r\r\n", 63, "", ""},
        {" node:\t4\n\tcan: can1\n", 4, "can1", ""},
        {"node: 0\nnode: 5\nnode: 6\ncan: \"can1\"\ncan: can2\ncan: can3\n", 5, "can2", ""},
        {"node: 64\nnode: 7x\nnode: 99999999999999999999\nnode:\nnode\nnode: 1 2\nnodes: 1\n", 0, "", ""},
        {"node: one\ncan: \x1b[2J\ndisplay: a\x7f\n", 0, "", ""},
        {"", 0, "", ""},
    };
    char path[SCRATCH_PATH_LENGTH];
    board_config_t config;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        write_config(*state, path, wrong[i].text);
        memset(&config, 0x5a, sizeof config);
        board_config_glimpse(&config, path);
        if (config.node != wrong[i].node || strcmp(config.can, wrong[i].can) != 0 ||
            strcmp(config.display, wrong[i].display) != 0)
            fail_msg("made out node %d, can \"%s\", display \"%s\" of:\n%s", (int)config.node, config.can,
                     config.display, wrong[i].text);
        assert_string_equal(config.room, "");
        assert_string_equal(config.key, "");
        assert_string_equal(config.camera, "");
        assert_int_equal(config.workers, 0);
    }
    scratch_path(*state, "none.yaml", path);
    board_config_glimpse(&config, path);
    assert_int_equal(config.node, 0);
}

static void test_the_command_line_wins(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    write_config(*state, path,
                 "node: 2\nroom: /r\nkey: /k\ncan: can1\ncamera: camera1\ndisplay: display1\nworkers: 2\n");
    const board_config_t config = load_good(path);
    options_t options = {.config = path};
    options_complete(&options, &config);
    board_table_t devices = options_devices(&options);
    assert_int_equal(options.node, 2);
    assert_string_equal(options.room, "/r");
    assert_string_equal(options.key, "/k");
    assert_string_equal(devices.can, "can1");
    assert_string_equal(devices.camera, "camera1");
    assert_string_equal(devices.display, "display1");
    assert_int_equal(devices.workers.count, 2);

    options = (options_t){.node = 3, .room = "R", .key = "K", .can = "C", .camera = "V", .display = "D", .workers = 1};
    options_complete(&options, &config);
    devices = options_devices(&options);
    assert_int_equal(options.node, 3);
    assert_string_equal(options.room, "R");
    assert_string_equal(options.key, "K");
    assert_string_equal(devices.can, "C");
    assert_string_equal(devices.camera, "V");
    assert_string_equal(devices.display, "D");
    assert_int_equal(devices.workers.count, 1);
}

static void test_the_boards_own_devices_stay(void **state)
{
    (void)state;
    const board_config_t config = {.node = 1, .room = "/r"};
    options_t options = {.config = "wallwarp.yaml"};
    options_complete(&options, &config);
    const board_table_t devices = options_devices(&options);
    assert_null(options.key);
    assert_string_equal(devices.can, "can7");
    assert_string_equal(devices.camera, "camera7");
    assert_string_equal(devices.display, "display7");
    assert_int_equal(devices.workers.count, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_key_is_read),
        cmocka_unit_test(test_line_ends_and_a_byte_order_mark_are_of_no_account),
        cmocka_unit_test(test_most_keys_may_be_left_out),
        cmocka_unit_test(test_files_are_beside_the_configuration),
        cmocka_unit_test(test_what_is_wrong_is_refused),
        cmocka_unit_test(test_long_names_are_refused),
        cmocka_unit_test(test_a_missing_file_is_refused),
        cmocka_unit_test(test_what_can_be_made_out_of_a_wrong_file),
        cmocka_unit_test(test_the_command_line_wins),
        cmocka_unit_test(test_the_boards_own_devices_stay),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
