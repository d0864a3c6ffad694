// SPDX-License-Identifier: Apache-2.0
// Bad room files: every one is refused by line and key, and leaves the room untouched.
#include "firmware/room.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/scratch.h"

enum { BIG = 1 << 23 };

/* Refused with exactly this message after "PATH:", and the room untouched. */
static void expect_refused(const char *path, const char *message)
{
    static room_t room, untouched;
    memset(&room, 0x5a, sizeof room);
    memset(&untouched, 0x5a, sizeof untouched);
    char error[ROOM_MESSAGE_LENGTH] = "";
    if (room_load(&room, path, NULL, NULL, error))
        fail_msg("%s was read, expected the error: %s", path, message);
    const size_t length = strlen(path);
    if (strncmp(error, path, length) != 0 || error[length] != ':' || strcmp(error + length + 1, message) != 0)
        fail_msg("found the error:\n%s\nexpected after the path:\n%s", error, message);
    assert_memory_equal(&room, &untouched, sizeof room);
}

/* The first line of each bad room is a comment: the message that it must give. */
static void expect_as_stated(const char *path)
{
    char message[ROOM_MESSAGE_LENGTH] = "";
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(message, sizeof message, file));
    fclose(file);
    message[strcspn(message, "\n")] = '\0';
    assert_int_equal(strncmp(message, "# ", 2), 0);
    expect_refused(path, message + 2);
}

static void test_bad_rooms_are_refused(void **state)
{
    (void)state;
    static const char folder_name[] = "tests/firmware/room/bad_rooms";
    DIR *folder = opendir(folder_name);
    assert_non_null(folder);
    int count = 0;
    for (const struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        if (entry->d_name[0] == '.')
            continue;
        char path[SCRATCH_PATH_LENGTH];
        snprintf(path, sizeof path, "%s/%.200s", folder_name, entry->d_name);
        expect_as_stated(path);
        count++;
    }
    closedir(folder);
    assert_true(count >= 95);
}

static void test_unreadable_files_are_refused(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "none.yaml", path);
    expect_refused(path, "1: file: cannot be opened (No such file or directory), expected a room file in YAML");
    expect_refused("tests", "1: file: cannot be read (Is a directory), expected a room file in YAML");
    scratch_write(path, "", 0);
    expect_refused(path, "1: file: empty, expected the keys camera, boards");
}

static void test_huge_files_are_refused(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "huge.yaml", path);
    char *text = malloc(BIG + 1);
    assert_non_null(text);
    memset(text, '#', BIG + 1);
    scratch_write(path, text, BIG + 1);
    expect_refused(path, "1: file: more than 8388608 bytes, expected a room file of at most that");
    scratch_write(path, text, BIG);
    expect_refused(path, "1: file: empty, expected the keys camera, boards");
    free(text);
}

/* libyaml alone would take minutes over these. */
static void test_deep_nesting_is_refused(void **state)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(*state, "deep.yaml", path);
    char *text = malloc(BIG);
    assert_non_null(text);
    static const char *const units[] = {"[", "- ", "? ", "{a: "};
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        const size_t unit = strlen(units[i]);
        for (size_t at = 0; at + unit <= BIG; at += unit)
            memcpy(text + at, units[i], unit);
        scratch_write(path, text, BIG);
        expect_refused(path, "1: syntax: found more than 16 lists and mappings within each other, expected 6 at most");
    }
    free(text);
}

static void test_long_paths_leave_room_for_the_message(void **state)
{
    (void)state;
    char path[2000] = "";
    for (size_t at = 0; at + 8 < sizeof path; at += 2)
        memcpy(path + at, "./", 3);
    char error[ROOM_MESSAGE_LENGTH] = "";
    static room_t room;
    assert_false(room_load(&room, path, NULL, NULL, error));
    assert_non_null(strstr(error, "./:1: file: cannot be read (Is a directory), expected a room file in YAML"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_rooms_are_refused),
        cmocka_unit_test(test_unreadable_files_are_refused),
        cmocka_unit_test(test_huge_files_are_refused),
        cmocka_unit_test(test_deep_nesting_is_refused),
        cmocka_unit_test(test_long_paths_leave_room_for_the_message),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
