// SPDX-License-Identifier: Apache-2.0
// Comparison of names, without a C library.
#ifndef WARP_FIXED_SAME_TEXT_H
#define WARP_FIXED_SAME_TEXT_H

#include <stdbool.h>

static inline bool same_text(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

#endif
