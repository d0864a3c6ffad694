// SPDX-License-Identifier: Apache-2.0
// The graphics cards and their connectors: find the one that a name means, and be its only user.
#include "hal/linux/display_kms_card.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <xf86drm.h>

#include "hal/linux/board_error.h"
#include "hal/linux/device_user.h"

enum { LIST_LENGTH = 140 };

static void note_driver(kms_card_t *card)
{
    drmVersion *version = drmGetVersion(card->file);
    (void)snprintf(card->driver, sizeof card->driver, "%s", version == NULL ? "unknown" : version->name);
    drmFreeVersion(version);
}

/* @return HAL_OK: with no connector yet; HAL_EMPTY: there is no such card, or it has no connectors (a GPU that only
   computes); HAL_IO: it refuses. */
static hal_status_t open_card(kms_card_t *card, int32_t number, char error[HAL_BOARD_ERROR_LENGTH])
{
    kms_card_t opened = {.number = number};
    (void)snprintf(opened.path, sizeof opened.path, "/dev/dri/card%d", number);
    opened.file = open(opened.path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (opened.file < 0 && (errno == ENOENT || errno == ENODEV || errno == ENXIO))
        return HAL_EMPTY;
    if (opened.file < 0)
        return board_error(error, "display: can't open %s: %s; expected a user of group video (usermod -aG video USER)",
                           opened.path, strerror(errno));
    drmModeRes *resources = drmModeGetResources(opened.file);
    const bool shows = resources != NULL && resources->count_connectors > 0;
    drmModeFreeResources(resources);
    if (!shows) {
        close(opened.file);
        return HAL_EMPTY;
    }
    note_driver(&opened);
    *card = opened;
    return HAL_OK;
}

void kms_card_close(const kms_card_t *card)
{
    close(card->file);
}

/* @return One of its connectors, freshly probed, for drmModeFreeConnector(); NULL past the last, or on failure. */
static drmModeConnector *connector_of(const kms_card_t *card, int32_t index)
{
    drmModeRes *resources = drmModeGetResources(card->file);
    drmModeConnector *connector = resources == NULL || index >= resources->count_connectors
                                      ? NULL
                                      : drmModeGetConnector(card->file, resources->connectors[index]);
    drmModeFreeResources(resources);
    return connector;
}

/* As HDMI-A-1. */
static void write_name(char name[KMS_NAME_LENGTH], const drmModeConnector *connector)
{
    const char *type = drmModeGetConnectorTypeName(connector->connector_type);
    (void)snprintf(name, KMS_NAME_LENGTH, "%s-%u", type == NULL ? "Unknown" : type, connector->connector_type_id);
}

/* Add "card0:HDMI-A-1 off" to what was seen. */
static void note_seen(char seen[LIST_LENGTH], const kms_card_t *card, const char *name, bool connected)
{
    const size_t length = strlen(seen);
    (void)snprintf(seen + length, LIST_LENGTH - length, "%scard%d:%s %s", length == 0 ? "" : ", ", card->number, name,
                   connected ? "on" : "off");
}

/* Look for the connector on one card. @return It, or NULL. */
static drmModeConnector *find_on(kms_card_t *card, const kms_name_t *name, char seen[LIST_LENGTH])
{
    drmModeConnector *connector;
    for (int32_t i = 0; (connector = connector_of(card, i)) != NULL; i++) {
        const bool connected = connector->connection == DRM_MODE_CONNECTED;
        write_name(card->connector_name, connector);
        card->connector = connector->connector_id;
        note_seen(seen, card, card->connector_name, connected);
        if (connected && (name->connector[0] == '\0' || strcmp(name->connector, card->connector_name) == 0))
            return connector;
        drmModeFreeConnector(connector);
    }
    return NULL;
}

hal_status_t kms_card_find(kms_card_t *card, drmModeConnector **connector, const kms_name_t *name,
                           char error[HAL_BOARD_ERROR_LENGTH])
{
    const bool any = name->card == KMS_ANY_CARD;
    char seen[LIST_LENGTH] = "";
    for (int32_t number = any ? 0 : name->card; number < (any ? KMS_MAX_CARDS : name->card + 1); number++) {
        kms_card_t opened;
        const hal_status_t status = open_card(&opened, number, error);
        if (status == HAL_IO)
            return HAL_IO;
        if (status != HAL_OK)
            continue;
        drmModeConnector *found = find_on(&opened, name, seen);
        if (found != NULL) {
            *connector = found;
            *card = opened;
            return HAL_OK;
        }
        kms_card_close(&opened);
    }
    if (seen[0] == '\0' && any)
        return board_error(error, "display: no /dev/dri/card* with a connector; expected a loaded graphics driver (ls "
                                  "/sys/class/drm)");
    if (seen[0] == '\0')
        return board_error(error, "display: no /dev/dri/card%d with a connector; expected one of ls /sys/class/drm",
                           name->card);
    return board_error(error, "display: no projector at %s (%s); check cable and power, or the name",
                       name->connector[0] == '\0' ? "any connector" : name->connector, seen);
}

hal_status_t kms_card_own(const kms_card_t *card, char error[HAL_BOARD_ERROR_LENGTH])
{
    uint64_t monotonic = 0, dumb = 0;
    if (!drmIsMaster(card->file) && drmSetMaster(card->file) != 0) {
        char user[DEVICE_USER_LENGTH];
        (void)device_user(user, card->path);
        return board_error(error, "display: %s is in use by %s; end that program (fuser -v %s)", card->path, user,
                           card->path);
    }
    if (drmSetClientCap(card->file, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) != 0 ||
        drmSetClientCap(card->file, DRM_CLIENT_CAP_ATOMIC, 1) != 0)
        return board_error(
            error,
            "display: driver %s of %s has no atomic mode setting; expected one that has (on a Raspberry Pi: "
            "dtoverlay=vc4-kms-v3d in config.txt)",
            card->driver, card->path);
    if (drmGetCap(card->file, DRM_CAP_TIMESTAMP_MONOTONIC, &monotonic) != 0 || monotonic == 0 ||
        drmGetCap(card->file, DRM_CAP_DUMB_BUFFER, &dumb) != 0 || dumb == 0)
        return board_error(error, "display: driver %s of %s lacks monotonic time stamps or dumb buffers; expected both",
                           card->driver, card->path);
    return HAL_OK;
}
