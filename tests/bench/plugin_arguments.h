// SPDX-License-Identifier: Apache-2.0
// Arguments of QEMU's plugins: name=value, most values being addresses in hexadecimal.
#ifndef TESTS_BENCH_PLUGIN_ARGUMENTS_H
#define TESTS_BENCH_PLUGIN_ARGUMENTS_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/** Cut the argument at its sign of equality. @return What is behind it; NULL when that is nothing. */
static inline char *plugin_value(char *argument)
{
    char *value = strchr(argument, '=');
    if (value == NULL || value[1] == '\0')
        return NULL;
    *value = '\0';
    return value + 1;
}

/** @return The address; 0 when the text is none. */
static inline uint64_t plugin_address(const char *value)
{
    char *rest;
    const uint64_t address = strtoull(value, &rest, 16);
    return *rest == '\0' ? address : 0;
}

#endif
