// SPDX-License-Identifier: Apache-2.0
// The key file: read when it is the reader's own and private, refused with a clear line when it is not.
#include "hal/hal_key.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/scratch.h"

static const char GOOD[] = "000102030405060708090a0B0c0D0e0F";
static const hal_key_t GOOD_KEY = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}};

static char path[SCRATCH_PATH_LENGTH];

/* A file with that text and mode, in place of the last one. */
static void write_key(void **state, const char *text, size_t length, mode_t mode)
{
    scratch_path(*state, "room.key", path);
    (void)unlink(path);
    scratch_write(path, text, length);
    assert_int_equal(chmod(path, mode), 0);
}

/* The line must name the file, have the words in it, and nothing of the key. */
static void assert_refused(hal_status_t status, const char *words)
{
    static const hal_key_t untouched = {{0xA5, 0xA5}};
    hal_key_t key = untouched;
    char error[HAL_KEY_ERROR_LENGTH] = "";
    assert_int_equal(hal_key_load(&key, path, error), status);
    assert_memory_equal(&key, &untouched, sizeof key);
    if (strncmp(error, path, strlen(path)) != 0 || strstr(error, words) == NULL || strchr(error, '\n') != NULL ||
        strstr(error, "0001") != NULL)
        fail_msg("%s", error);
}

static void good_files_are_read(void **state)
{
    static const mode_t modes[] = {0400, 0600};
    for (int m = 0; m < 2; m++)
        for (size_t newline = 0; newline < 2; newline++) {
            char text[sizeof GOOD + 1], error[HAL_KEY_ERROR_LENGTH] = "";
            hal_key_t key = {{1}};
            snprintf(text, sizeof text, "%s\n", GOOD);
            write_key(state, text, strlen(GOOD) + newline, modes[m]);
            assert_int_equal(hal_key_load(&key, path, error), HAL_OK);
            assert_string_equal(error, "");
            assert_memory_equal(&key, &GOOD_KEY, sizeof key);
            hal_key_wipe(&key);
            assert_memory_equal(&key, (const uint8_t[HAL_KEY_BYTES]){0}, HAL_KEY_BYTES);
        }
}

static void files_that_others_may_use_are_refused(void **state)
{
    for (mode_t bit = 1; bit <= 040; bit *= 2) {
        char mode[40];
        snprintf(mode, sizeof mode, "has mode %04o, ", (unsigned)(0600 | bit));
        write_key(state, GOOD, strlen(GOOD), 0600 | bit);
        assert_refused(HAL_BAD_CALL, mode);
    }
}

static void files_of_others_are_refused_but_by_root(void **state)
{
    const bool root = geteuid() == 0;
    char error[HAL_KEY_ERROR_LENGTH] = "";
    hal_key_t key;
    write_key(state, GOOD, strlen(GOOD), 0600);
    if (root) {
        assert_int_equal(chown(path, 1, 1), 0);
        assert_int_equal(hal_key_load(&key, path, error), HAL_OK);
        assert_int_equal(seteuid(1), 0);
    }
    snprintf(path, sizeof path, "/etc/passwd");
    assert_refused(HAL_BAD_CALL, "belongs to user 0, expected the reader, user ");
    if (root)
        assert_int_equal(seteuid(0), 0);
}

static void texts_that_are_no_key_are_refused(void **state)
{
    const size_t length = strlen(GOOD);
    char text[sizeof GOOD + 3];
    snprintf(text, sizeof text, "%s\n\n", GOOD);
    write_key(state, text, length + 2, 0600);
    assert_refused(HAL_BAD_CALL, "is no key, expected 32 hexadecimal digits");
    snprintf(text, sizeof text, "%s\r\n", GOOD);
    write_key(state, text, length + 2, 0600);
    assert_refused(HAL_BAD_CALL, "is no key");
    snprintf(text, sizeof text, "%s0", GOOD);
    write_key(state, text, length + 1, 0600);
    assert_refused(HAL_BAD_CALL, "is no key");
    for (size_t shorter = 0; shorter < length; shorter++) {
        write_key(state, GOOD, shorter, 0600);
        assert_refused(HAL_BAD_CALL, "is no key");
    }
    for (size_t place = 0; place < length; place++) {
        static const char bad[] = {'\0', ' ', '\n', '/', ':', '@', 'G', '`', 'g', '\x10', '\xb0'};
        for (size_t b = 0; b < sizeof bad; b++) {
            memcpy(text, GOOD, sizeof GOOD);
            text[place] = bad[b];
            write_key(state, text, length, 0600);
            assert_refused(HAL_BAD_CALL, "is no key");
        }
    }
}

static void what_is_no_file_is_refused(void **state)
{
    char target[SCRATCH_PATH_LENGTH];
    write_key(state, GOOD, strlen(GOOD), 0600);
    memcpy(target, path, sizeof target);
    scratch_path(*state, "link", path);
    assert_int_equal(symlink(target, path), 0);
    assert_refused(HAL_IO, "it is a link");
    scratch_path(*state, "pipe", path);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_refused(HAL_BAD_CALL, "is not a regular file");
    scratch_path(*state, "missing", path);
    assert_refused(HAL_IO, "No such file");
    snprintf(path, sizeof path, "build");
    assert_refused(HAL_BAD_CALL, "is not a regular file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_files_are_read),
        cmocka_unit_test(files_that_others_may_use_are_refused),
        cmocka_unit_test(files_of_others_are_refused_but_by_root),
        cmocka_unit_test(texts_that_are_no_key_are_refused),
        cmocka_unit_test(what_is_no_file_is_refused),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
