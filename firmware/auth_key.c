// SPDX-License-Identifier: Apache-2.0
// A key file becomes what makes and checks codes.
#include "firmware/auth_key.h"

#include <stdio.h>

can_auth_t *auth_key_open(const char *path, char error[HAL_KEY_ERROR_LENGTH])
{
    hal_key_t key;
    if (hal_key_load(&key, path, error) != HAL_OK)
        return NULL;
    can_auth_t *auth = can_auth_open(&key);
    hal_key_wipe(&key);
    if (auth == NULL)
        snprintf(error, HAL_KEY_ERROR_LENGTH, "%.400s: no memory for the key, or Mbed TLS refuses AES-CMAC", path);
    return auth;
}
