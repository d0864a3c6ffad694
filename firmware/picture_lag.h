// SPDX-License-Identifier: Apache-2.0
// What a camera needs: from the capture of a picture to the refresh that can show it, whatever the two rates are.
//
// A picture can be shown at the first blank after it was delivered; its age is then at least what the camera takes, and
// up to a period more. When pictures and blanks go together, all ages are alike, and the lag is that age. Else the
// room's rule (frame_clock.h), which takes pictures a quarter of a period before the lag is over, needs the least age
// and that quarter.
#ifndef FIRMWARE_PICTURE_LAG_H
#define FIRMWARE_PICTURE_LAG_H

#include <stdint.h>

enum { PICTURE_LAG_PICTURES = 16 /**< of which the lag is made */ };

/** All zero bytes has seen no picture. */
typedef struct {
    int32_t lag_us; /**< 0: not known yet, at once after the first picture */

    int32_t count, least_us, most_us; /**< the module's own: ages since the lag was made */
} picture_lag_t;

/** A picture came. @param age_us  At the first blank after its delivery: the blank less its capture. */
void picture_lag_add(picture_lag_t *lag, int32_t age_us, int32_t period_us);

#endif
