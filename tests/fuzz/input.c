// SPDX-License-Identifier: Apache-2.0
// What every fuzz target needs: its input as numbers or as a file, and a way to stop when an invariant is broken.
#include "tests/fuzz/input.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

void fuzz_check(bool holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "BROKEN: %s\n", what);
    abort();
}

void fuzz_check_line(const char *line)
{
    fuzz_check(*line != '\0', "a message says something");
    for (; *line != '\0'; line++)
        fuzz_check(*line != '\n', "a message is one line");
}

uint8_t input_byte(input_t *input)
{
    if (input->left == 0)
        return 0;
    input->left--;
    return *input->bytes++;
}

uint64_t input_bits(input_t *input, int bytes)
{
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++)
        value |= (uint64_t)input_byte(input) << (8 * i);
    return value;
}

int32_t input_range(input_t *input, int32_t low, int32_t high)
{
    const uint32_t count = (uint32_t)(high - low) + 1;
    const uint32_t value = (uint32_t)input_bits(input, count > 256 ? 2 : 1);
    return low + (int32_t)(value % count);
}

int64_t input_number(input_t *input, int bits)
{
    const uint8_t kind = input_byte(input);
    const int used = kind % 128 % (bits + 1);
    const uint64_t value = input_bits(input, (used + 7) / 8) & ((UINT64_C(1) << used) - 1);
    return kind < 128 ? (int64_t)value : -(int64_t)value;
}

input_file_t input_file_open(const void *bytes, size_t size)
{
    input_file_t file = {.descriptor = memfd_create("fuzz", 0)};
    fuzz_check(file.descriptor >= 0 && write(file.descriptor, bytes, size) == (ssize_t)size,
               "the scratch file is made");
    snprintf(file.path, sizeof file.path, "/proc/self/fd/%d", file.descriptor);
    return file;
}

void input_file_close(const input_file_t *file)
{
    close(file->descriptor);
}
