// SPDX-License-Identifier: Apache-2.0
// What a camera needs: from the capture of a picture to the refresh that can show it.
#include "firmware/picture_lag.h"

void picture_lag_add(picture_lag_t *lag, int32_t age_us, int32_t period_us)
{
    if (lag->count == 0)
        lag->least_us = lag->most_us = age_us;
    lag->least_us = age_us < lag->least_us ? age_us : lag->least_us;
    lag->most_us = age_us > lag->most_us ? age_us : lag->most_us;
    lag->count++;
    if (lag->count < PICTURE_LAG_PICTURES && lag->lag_us != 0)
        return;
    const int32_t rule_us = lag->least_us + period_us / 4, lag_us = lag->most_us < rule_us ? lag->most_us : rule_us;
    lag->lag_us = lag_us > 1 ? lag_us : 1;
    if (lag->count == PICTURE_LAG_PICTURES)
        lag->count = 0;
}
