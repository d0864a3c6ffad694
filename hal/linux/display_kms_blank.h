// SPDX-License-Identifier: Apache-2.0
// When the next vertical blank is: from the time of the last ones.
#ifndef HAL_LINUX_DISPLAY_KMS_BLANK_H
#define HAL_LINUX_DISPLAY_KMS_BLANK_H

#include <stdint.h>

/** Blanks so far. Times are of CLOCK_MONOTONIC. */
typedef struct {
    int64_t nominal_ns; /**< period of the mode; 1 or more */
    int64_t period_ns;  /**< as measured, at most 1 / 64 off the nominal one */
    int64_t last_ns;    /**< the newest blank */
    uint32_t sequence;  /**< its number */
} kms_blank_t;

/** Begin with one blank that is known, or guessed. */
void kms_blank_init(kms_blank_t *blank, int64_t period_ns, int64_t last_ns, uint32_t sequence);

/**
 * A blank was seen. The period follows the measured ones slowly: a clock that is not quite the mode's is followed
 * within a second, and one late time stamp moves the next guess by a fraction of its error. What is too far off the
 * nominal period to be one only tells the time of the blank; a blank older than the newest one tells nothing.
 *
 * @param sequence  The driver's number of it; wraps at 2^32.
 */
void kms_blank_add(kms_blank_t *blank, int64_t time_ns, uint32_t sequence);

/** @return The first blank after a time, as far as is known, ns. */
int64_t kms_blank_after(const kms_blank_t *blank, int64_t time_ns);

#endif
