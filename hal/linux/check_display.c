// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): the projector.
#include <xf86drm.h>
#include <xf86drmMode.h>

#include "hal/linux/check.h"
#include "hal/linux/device_user.h"
#include "hal/linux/display_kms_card.h"
#include "hal/linux/display_kms_mode.h"
#include "hal/linux/display_kms_name.h"

/* Whoever opens a card that nobody uses is its master from then on: give that back at once. @return Is it free? */
static bool is_free(const kms_card_t *card)
{
    if (drmIsMaster(card->file) == 0)
        return false;
    (void)drmDropMaster(card->file);
    return true;
}

static void check_mode(check_t *check, const kms_card_t *card, const drmModeConnector *connector)
{
    const hal_board_needs_t *n = check->needs;
    const drmModeModeInfo *modes = connector->modes;
    const int32_t count = connector->count_modes;
    kms_mode_wanted_t wanted = {.width = 0}; /* no mode's size */
    char text[CHECK_LINE_LENGTH / 2];
    if (n != NULL)
        wanted = (kms_mode_wanted_t){n->panel_width, n->panel_height, n->refresh_frames, n->refresh_seconds};
    kms_mode_list(text, sizeof text, modes, count, &wanted);
    if (n != NULL && kms_mode_choose(modes, count, &wanted) == KMS_NO_MODE) {
        check_miss(check, "write a size and a refresh_hz that it offers into the room file",
                   "display: %s offers no %dx%d at %.2f Hz; it has %s", card->connector_name, (int)n->panel_width,
                   (int)n->panel_height, (double)n->refresh_frames / n->refresh_seconds, text);
        return;
    }
    check_found(check, "display: %s of %s (%s): %s", card->connector_name, card->path, card->driver, text);
}

void check_display(check_t *check)
{
    kms_name_t name;
    kms_card_t card;
    drmModeConnector *connector;
    char error[HAL_BOARD_ERROR_LENGTH], who[DEVICE_USER_LENGTH];
    if (!kms_name_parse(&name, check->table->display, error) ||
        kms_card_find(&card, &connector, &name, error) != HAL_OK) {
        check_miss(check, NULL, "%s", error);
        return;
    }
    if (!is_free(&card)) {
        (void)device_user(who, card.path);
        check_held(check, "display", card.path, who,
                   "stop that program; a desktop: sudo systemctl isolate multi-user.target");
    }
    check_mode(check, &card, connector);
    drmModeFreeConnector(connector);
    kms_card_close(&card);
}
