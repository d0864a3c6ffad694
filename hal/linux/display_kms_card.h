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
 * Open a card that has connectors. It need not be free: see kms_card_own().
 *
 * @param[out] card   Written only when HAL_OK is returned: with no connector yet.
 * @param[out] error  Written only when HAL_IO is returned.
 * @return HAL_OK; HAL_EMPTY when there is no such card, or it has no connectors (a GPU that only computes); HAL_IO when
 *         it refuses: one line.
 */
MUST_CHECK hal_status_t kms_card_open(kms_card_t *card, int32_t number, char error[HAL_BOARD_ERROR_LENGTH]);

/** Close it. The kernel drops what it still has of this user's. */
void kms_card_close(const kms_card_t *card);

/** @return One of its connectors, freshly probed, for drmModeFreeConnector(); NULL past the last, or on failure. */
drmModeConnector *kms_card_connector(const kms_card_t *card, int32_t index);

/** Write a connector's name, as HDMI-A-1. */
void kms_connector_name(char name[KMS_NAME_LENGTH], const drmModeConnector *connector);

/**
 * Find the connector, and open its card.
 *
 * @param[out] card       Written only when HAL_OK is returned.
 * @param[out] connector  Likewise: what it offers, for drmModeFreeConnector().
 * @return HAL_OK; HAL_IO: one line in error; what there is in place of the name, when it is that which is wrong.
 */
MUST_CHECK hal_status_t kms_card_find(kms_card_t *card, drmModeConnector **connector, const kms_name_t *name,
                                      char error[HAL_BOARD_ERROR_LENGTH]);

/**
 * Be the one user who may set modes (DRM master), with atomic mode setting and every plane.
 *
 * @return HAL_OK; HAL_IO: one line in error, with the program that has the card, as far as /proc tells.
 */
MUST_CHECK hal_status_t kms_card_own(const kms_card_t *card, char error[HAL_BOARD_ERROR_LENGTH]);

#endif
