// SPDX-License-Identifier: Apache-2.0
// Random numbers from Linux.
#include "hal/hal_random.h"

#include <sys/random.h>

hal_status_t hal_random(uint64_t *number)
{
    uint64_t taken;
    if (getrandom(&taken, sizeof taken, 0) != (ssize_t)sizeof taken)
        return HAL_IO;
    *number = taken;
    return HAL_OK;
}
