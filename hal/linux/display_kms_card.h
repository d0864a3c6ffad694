// SPDX-License-Identifier: Apache-2.0
// The graphics cards and their connectors: find the one that a name means, and be its only user.
#ifndef HAL_LINUX_DISPLAY_KMS_CARD_H
#define HAL_LINUX_DISPLAY_KMS_CARD_H

#include <stdbool.h>
#include <stdint.h>
#include <xf86drmMode.h>

#include "hal/hal_board.h"
#include "hal/hal_status.h"
#include "hal/linux/display_kms_name.h"

enum { KMS_PATH_LENGTH = 32 };

/** An open card, and the connector of the projector. */
typedef struct {
    int file;                   /**< of /dev/dri/cardN, non-blocking */
    int32_t number;             /**< N */
    char path[KMS_PATH_LENGTH]; /**< /dev/dri/cardN */
    char driver[KMS_NAME_LENGTH];
    char connector_name[KMS_NAME_LENGTH];
    uint32_t connector;
} kms_card_t;

/**
 * Find the connector, with a projector on it, and open its card.
 *
 * @param[out] card       Written only when HAL_OK is returned.
 * @param[out] connector  Likewise: what it offers, for drmModeFreeConnector().
 * @return HAL_OK; HAL_IO: one line in error; what there is in place of the name, when it is that which is wrong.
 */
MUST_CHECK hal_status_t kms_card_find(kms_card_t *card, drmModeConnector **connector, const kms_name_t *name,
                                      char error[HAL_BOARD_ERROR_LENGTH]);

/** Close it. The kernel drops what it still has of this user's. */
void kms_card_close(const kms_card_t *card);

/**
 * Be the one user who may set modes (DRM master), with atomic mode setting and every plane.
 *
 * @return HAL_OK; HAL_IO: one line in error, with the program that has the card, as far as /proc tells.
 */
MUST_CHECK hal_status_t kms_card_own(const kms_card_t *card, char error[HAL_BOARD_ERROR_LENGTH]);

#endif
