// SPDX-License-Identifier: Apache-2.0
// Comparing a table of loops with the scalar one, byte for byte, in the manner of dav1d's checkasm.
#ifndef TESTS_KERNELS_CHECK_H
#define TESTS_KERNELS_CHECK_H

#include <stddef.h>
#include <stdint.h>

#include "tests/kernels/fenced.h"
#include "tests/support/rng.h"
#include "warp_fixed/kernels.h"

enum { CHECK_MAX_COUNT = 70, CHECK_FILLS = 5 };

/** Where both tables write: the same bytes before the loop runs, and all of them compared afterwards. */
typedef struct {
    fenced_t memory[2];
    size_t size;
    void *expected, *found; /**< of `size` bytes, up to the fence; more bytes before them are watched too */
} outputs_t;

/** Say which case runs: printed when it differs, or when it touches a fence. */
void check_case(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Begin a case that writes size bytes. */
void outputs_begin(outputs_t *outputs, size_t size);

/** Compare; a difference is printed with the case and counted. */
void outputs_compare(const outputs_t *outputs);

/** Fill with 0, 255, both in turn, either at random, or anything. @param kind  0 to CHECK_FILLS - 1. */
void check_fill(uint8_t *bytes, size_t size, int kind, rng_t *rng);

/** The groups; each runs one part of the table. */
typedef void check_group_fn(const warp_kernels_t *tested);
check_group_fn check_grid_points, check_filters, check_nearest, check_windows, check_coefficients, check_ls,
    check_conversions, check_frames;

#endif
