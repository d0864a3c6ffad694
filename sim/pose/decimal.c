// SPDX-License-Identifier: Apache-2.0
// Decimal text -> integer in units of a power of ten.
#include "sim/pose/decimal.h"

#include <stdbool.h>

enum { MOST_DIGITS = 18, MOST_EXPONENT = 10000 };

/* digits * 10^exponent; what follows the first 18 significant digits is cut off. */
typedef struct {
    bool negative;
    int64_t digits;
    int exponent;
} decimal_t;

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Cutting off keeps rounding right: half a unit is never reached by the lost digits alone. */
static void take_digit(decimal_t *number, char digit, int *significant)
{
    if (*significant < MOST_DIGITS) {
        number->digits = 10 * number->digits + (digit - '0');
        *significant += number->digits != 0;
    } else if (number->exponent < MOST_EXPONENT) {
        number->exponent++;
    }
}

static bool read_mantissa(const char **text, decimal_t *number)
{
    const char *at = *text;
    int significant = 0;
    int digits = 0;
    for (; is_digit(*at); at++, digits++)
        take_digit(number, *at, &significant);
    if (*at == '.') {
        for (at++; is_digit(*at); at++, digits++) {
            take_digit(number, *at, &significant);
            if (number->exponent > -MOST_EXPONENT)
                number->exponent--;
        }
    }
    *text = at;
    return digits > 0;
}

static bool read_exponent(const char **text, decimal_t *number)
{
    const char *at = *text;
    if (*at != 'e' && *at != 'E')
        return true;
    at++;
    const bool negative = *at == '-';
    if (*at == '-' || *at == '+')
        at++;
    if (!is_digit(*at))
        return false;
    int exponent = 0;
    for (; is_digit(*at); at++)
        if (exponent < MOST_EXPONENT)
            exponent = 10 * exponent + (*at - '0');
    number->exponent += negative ? -exponent : exponent;
    *text = at;
    return true;
}

decimal_status_t decimal_from_text(const char *text, int places, int64_t *value)
{
    decimal_t number = {.negative = *text == '-'};
    if (*text == '-' || *text == '+')
        text++;
    if (!read_mantissa(&text, &number) || !read_exponent(&text, &number) || *text != '\0')
        return DECIMAL_NOT_A_NUMBER;

    int64_t scaled = number.digits;
    int shift = number.exponent + places;
    for (; shift > 0 && scaled != 0; shift--) {
        if (scaled >= INT64_C(100000000000000000))
            return DECIMAL_TOO_LARGE;
        scaled *= 10;
    }
    if (shift < 0) {
        /* All digits but the last one to go cannot decide a tie. */
        for (; shift < -1 && scaled != 0; shift++)
            scaled /= 10;
        scaled = scaled / 10 + (scaled % 10 >= 5);
    }
    *value = number.negative ? -scaled : scaled;
    return DECIMAL_OK;
}
