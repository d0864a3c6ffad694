// SPDX-License-Identifier: Apache-2.0
// File names with a number in them: frame_%05d.png.
#include "sim/files/numbered_name.h"

#include <stdio.h>

/* The number of digits a conversion asks for, 0 when it says nothing; -1 when it is none. *end is set behind it. */
static int digits_of_conversion(const char *conversion, const char **end)
{
    int digits = 0;
    const char *at = conversion + 1;
    if (at[0] == '0' && at[1] >= '1' && at[1] <= '9') {
        digits = at[1] - '0';
        at += 2;
    }
    *end = at + 1;
    return *at == 'd' ? digits : -1;
}

bool numbered_name(char *name, size_t size, const char *pattern, int32_t number)
{
    size_t length = 0;
    int conversions = 0;
    for (const char *at = pattern; *at != '\0';) {
        int added = 1;
        if (length >= size)
            return false;
        if (at[0] == '%' && at[1] != '%') {
            const int digits = digits_of_conversion(at, &at);
            if (digits < 0)
                return false;
            added = snprintf(name + length, size - length, "%0*d", digits, number);
            conversions++;
        } else {
            name[length] = at[0];
            at += at[0] == '%' ? 2 : 1;
        }
        length += (size_t)added;
    }
    if (length >= size || conversions != 1)
        return false;
    name[length] = '\0';
    return true;
}
