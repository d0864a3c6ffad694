// SPDX-License-Identifier: Apache-2.0
// Contract of random numbers that nobody can guess: taken at start, to begin sessions and numbers for commands with.
#ifndef HAL_HAL_RANDOM_H
#define HAL_HAL_RANDOM_H

#include <stdint.h>

#include "hal/hal_status.h"

/**
 * A random number from the system. May wait until the system has gathered enough chance, soon after it has booted.
 *
 * @param[out] number  Written only when HAL_OK is returned.
 * @return HAL_OK; HAL_IO when the system has none.
 */
MUST_CHECK hal_status_t hal_random(uint64_t *number);

#endif
