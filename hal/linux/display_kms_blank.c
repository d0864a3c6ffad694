// SPDX-License-Identifier: Apache-2.0
// When the next vertical blank is: from the time of the last ones.
#include "hal/linux/display_kms_blank.h"

enum { FOLLOW = 8, PLAUSIBLE = 64, MEASURED_BLANKS = 16 };

void kms_blank_init(kms_blank_t *blank, int64_t period_ns, int64_t last_ns, uint32_t sequence)
{
    *blank = (kms_blank_t){period_ns, period_ns, last_ns, sequence};
}

void kms_blank_add(kms_blank_t *blank, int64_t time_ns, uint32_t sequence)
{
    const int64_t passed_ns = time_ns - blank->last_ns;
    const uint32_t blanks = sequence - blank->sequence;
    if (passed_ns < 0)
        return;
    if (blanks >= 1 && blanks <= MEASURED_BLANKS) {
        const int64_t measured_ns = passed_ns / blanks, off_ns = measured_ns - blank->nominal_ns;
        if (off_ns <= blank->nominal_ns / PLAUSIBLE && -off_ns <= blank->nominal_ns / PLAUSIBLE)
            blank->period_ns += (measured_ns - blank->period_ns) / FOLLOW;
    }
    blank->last_ns = time_ns;
    blank->sequence = sequence;
}

int64_t kms_blank_after(const kms_blank_t *blank, int64_t time_ns)
{
    const int64_t passed_ns = time_ns - blank->last_ns;
    return passed_ns < 0 ? blank->last_ns : blank->last_ns + (passed_ns / blank->period_ns + 1) * blank->period_ns;
}
