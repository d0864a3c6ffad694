// SPDX-License-Identifier: Apache-2.0
// File names with a number in them: frame_%05d.png.
#ifndef SIM_FILES_NUMBERED_NAME_H
#define SIM_FILES_NUMBERED_NAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/**
 * Put a number into a pattern, without ever using the pattern as a printf format.
 *
 * @param[out] name     Complete string on success; unspecified on failure.
 * @param      size     Bytes of name.
 * @param      pattern  With exactly one %d or %0Nd (N 1 to 9); "%%" stands for one %.
 * @param      number   0 or more.
 * @return false when the pattern is none, or the name does not fit.
 */
bool numbered_name(char *name, size_t size, const char *pattern, int32_t number);

#endif
