// SPDX-License-Identifier: Apache-2.0
// How a device of Linux says why it can't be opened.
#include "hal/linux/board_error.h"

#include <stdarg.h>
#include <stdio.h>

hal_status_t board_error(char error[HAL_BOARD_ERROR_LENGTH], const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(error, HAL_BOARD_ERROR_LENGTH, format, arguments);
    va_end(arguments);
    return HAL_IO;
}
