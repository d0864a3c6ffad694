// SPDX-License-Identifier: Apache-2.0
// A folder for the files that a test makes.
#include "tests/support/scratch.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

void scratch_open(scratch_t *scratch)
{
    const char *temporary = getenv("TMPDIR");
    if (temporary == NULL)
        temporary = "/tmp";
    const char *parent = access("build", W_OK) == 0 ? "build" : temporary;
    assert_true(snprintf(scratch->folder, sizeof scratch->folder, "%s/test-XXXXXX", parent) <
                (int)sizeof scratch->folder);
    assert_non_null(mkdtemp(scratch->folder));
}

void scratch_close(const scratch_t *scratch)
{
    DIR *folder = opendir(scratch->folder);
    assert_non_null(folder);
    for (const struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder))
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            assert_int_equal(unlinkat(dirfd(folder), entry->d_name, 0), 0);
    closedir(folder);
    assert_int_equal(rmdir(scratch->folder), 0);
}

int scratch_set_up(void **state)
{
    scratch_t *scratch = malloc(sizeof *scratch);
    assert_non_null(scratch);
    scratch_open(scratch);
    *state = scratch;
    return 0;
}

int scratch_tear_down(void **state)
{
    scratch_close(*state);
    free(*state);
    return 0;
}

void scratch_path(const scratch_t *scratch, const char *name, char path[SCRATCH_PATH_LENGTH])
{
    assert_true(snprintf(path, SCRATCH_PATH_LENGTH, "%s/%s", scratch->folder, name) < SCRATCH_PATH_LENGTH);
}

void scratch_write(const char *path, const void *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

uint8_t *scratch_read(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *length = (size_t)ftell(file);
    rewind(file);
    uint8_t *bytes = malloc(*length + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *length, file), *length);
    fclose(file);
    return bytes;
}
