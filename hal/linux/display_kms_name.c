// SPDX-License-Identifier: Apache-2.0
// The name of a display, as a board's table has it: a connector, and the card it is on.
#include "hal/linux/display_kms_name.h"

#include <stdlib.h>
#include <string.h>

#include "hal/linux/board_error.h"

static const char CARD[] = "card";

/* The part before the colon. @return Its number, or KMS_ANY_CARD when it is none. */
static int32_t card_number(const char *text, const char *colon)
{
    const char *digits = text + strlen(CARD);
    if (strncmp(text, CARD, strlen(CARD)) != 0 || *digits < '0' || *digits > '9')
        return KMS_ANY_CARD;
    char *end;
    const unsigned long number = strtoul(digits, &end, 10);
    return end == colon && number < KMS_MAX_CARDS ? (int32_t)number : KMS_ANY_CARD;
}

bool kms_name_parse(kms_name_t *name, const char *text, char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *colon = strchr(text, ':');
    const char *connector = colon == NULL ? text : colon + 1;
    const size_t length = strlen(connector);
    const int32_t card = colon == NULL ? KMS_ANY_CARD : card_number(text, colon);
    if ((colon != NULL && card == KMS_ANY_CARD) || length == 0 || length >= KMS_NAME_LENGTH ||
        strpbrk(connector, ":/") != NULL) {
        (void)board_error(error,
                          "display: found \"%.40s\", expected a connector as ls /sys/class/drm shows it (HDMI-A-1, "
                          "card1:HDMI-A-1; cards 0 to %d), or auto",
                          text, KMS_MAX_CARDS - 1);
        return false;
    }
    *name = (kms_name_t){.card = card};
    if (strcmp(connector, "auto") != 0)
        memcpy(name->connector, connector, length + 1);
    return true;
}
