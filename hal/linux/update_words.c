// SPDX-License-Identifier: Apache-2.0
// What is a source of an update, and what is a version.
#include <stddef.h>
#include <string.h>

#include "hal/hal_update.h"

/* @return Of 1 to length - 1 characters, all visible ones of ASCII. */
static bool is_word(const char *text, size_t length)
{
    size_t used = 0;
    while (used < length && text[used] >= '!' && text[used] <= '~')
        used++;
    return used >= 1 && used < length && text[used] == '\0';
}

bool hal_update_is_source(const char *source)
{
    return is_word(source, HAL_UPDATE_SOURCE_LENGTH) &&
           (strcmp(source, "usb") == 0 || source[0] == '/' || strncmp(source, "http://", 7) == 0 ||
            strncmp(source, "https://", 8) == 0);
}

bool hal_update_is_version(const char *version)
{
    return is_word(version, HAL_UPDATE_VERSION_LENGTH);
}
