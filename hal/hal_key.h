// SPDX-License-Identifier: Apache-2.0
// Contract of the room's secret key: read once at start, from where nobody else can read it. What it is for:
// can_auth.h.
#ifndef HAL_HAL_KEY_H
#define HAL_HAL_KEY_H

#include <stdint.h>

#include "hal/hal_status.h"

enum { HAL_KEY_BYTES = 16, HAL_KEY_ERROR_LENGTH = 512 };

typedef struct {
    uint8_t bytes[HAL_KEY_BYTES];
} hal_key_t;

/**
 * Read the key from a file: 32 hexadecimal digits, and at most one newline after them. A new one:
 * `(umask 077; od -An -N16 -tx1 /dev/urandom | tr -d ' ' >FILE)`.
 *
 * The file must be a regular one (no link, no pipe), belong to the user who reads it, and give nobody else any right:
 * mode 0600 or less. Root, who looks after a board, may read the firmware's.
 *
 * @param[out] key    Written only when HAL_OK is returned. Wipe it with hal_key_wipe() when it has been used.
 * @param[out] error  On failure: one line, "FILE: what was found, what was expected". It holds nothing of the key.
 * @return HAL_OK; HAL_BAD_CALL when owner, rights, kind or text are wrong; HAL_IO when the file can't be read.
 */
MUST_CHECK hal_status_t hal_key_load(hal_key_t *key, const char *path, char error[HAL_KEY_ERROR_LENGTH]);

/** Overwrite a key, so that no compiler leaves it out. */
void hal_key_wipe(hal_key_t *key);

#endif
