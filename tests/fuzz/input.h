// SPDX-License-Identifier: Apache-2.0
// What every fuzz target needs: its input as numbers or as a file, and a way to stop when an invariant is broken.
#ifndef TESTS_FUZZ_INPUT_H
#define TESTS_FUZZ_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** libFuzzer's entry points; a target defines the first, and the second where something must be prepared once. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerInitialize(int *argc, char ***argv);

/** Print `what` and abort when `holds` is false: libFuzzer then keeps the input. */
void fuzz_check(bool holds, const char *what);

/** Check that an error or warning is one line of text with something in it. */
void fuzz_check_line(const char *line);

/** What is left of the input. Behind its end there are zeros, so that the shortest input is the plainest case. */
typedef struct {
    const uint8_t *bytes;
    size_t left;
} input_t;

uint8_t input_byte(input_t *input);

/** @return The next `bytes` bytes, first one lowest; 0 to 8 of them. */
uint64_t input_bits(input_t *input, int bytes);

/** @return An integer in [low, high], both included; high - low < 2^16. 0 in the input gives low. */
int32_t input_range(input_t *input, int32_t low, int32_t high);

/** @return An integer with |value| < 2^bits, of any magnitude alike: the first byte says how many bits. bits <= 62. */
int64_t input_number(input_t *input, int bits);

enum { INPUT_PATH_LENGTH = 32 };

/** A file in memory that has a path: no disk is touched. */
typedef struct {
    int descriptor;
    char path[INPUT_PATH_LENGTH];
} input_file_t;

input_file_t input_file_open(const void *bytes, size_t size);
void input_file_close(const input_file_t *file);

#endif
