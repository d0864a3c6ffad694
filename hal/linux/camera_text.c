// SPDX-License-Identifier: Apache-2.0
// What cameras say when something is wrong: see the header.
#include "hal/linux/camera_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool camera_fail(char error[HAL_BOARD_ERROR_LENGTH], const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(error, HAL_BOARD_ERROR_LENGTH, format, arguments);
    va_end(arguments);
    return false;
}

bool camera_tell(camera_told_t *told, const char *name, const char *text)
{
    if (strcmp(told->line, text) == 0)
        return false;
    (void)snprintf(told->line, sizeof told->line, "%s", text);
    (void)fprintf(stderr, "camera %s: %s\n", name, text);
    return true;
}
