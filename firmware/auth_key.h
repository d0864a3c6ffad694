// SPDX-License-Identifier: Apache-2.0
// The option --key of all programs: a key file becomes what makes and checks codes.
#ifndef FIRMWARE_AUTH_KEY_H
#define FIRMWARE_AUTH_KEY_H

#include "firmware/can_auth.h"

static const char auth_key_help[] =
    "The room's key: believe only who has the same one, and sign what is sent (a room without one does neither)";

/**
 * Start-up only: uses the heap. The key itself is wiped.
 *
 * @param      path   As hal_key_load() takes it.
 * @param[out] error  On failure: one line without newline.
 * @return For can_auth_close(); NULL on failure.
 */
can_auth_t *auth_key_open(const char *path, char error[HAL_KEY_ERROR_LENGTH]);

#endif
