// SPDX-License-Identifier: Apache-2.0
// Decimal text -> integer in units of a power of ten, without binary floating point.
#ifndef SIM_POSE_DECIMAL_H
#define SIM_POSE_DECIMAL_H

#include <stdint.h>

typedef enum {
    DECIMAL_OK = 0,
    DECIMAL_NOT_A_NUMBER, /**< anything but [+-]digits[.digits][e[+-]digits]; also nan, inf and hexadecimal */
    DECIMAL_TOO_LARGE     /**< the result does not fit 18 digits */
} decimal_status_t;

/**
 * @param      text    The whole of it must be the number: no spaces.
 * @param      places  Unit of the result: 10^-places, 0 to 18.
 * @param[out] value   Written only when DECIMAL_OK is returned: |value| < 10^18, rounded to nearest, ties away from 0.
 */
decimal_status_t decimal_from_text(const char *text, int places, int64_t *value);

#endif
