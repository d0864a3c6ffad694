// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): a camera of libcamera's. It is taken for a moment, unless another program has it.
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "hal/linux/camera_libcamera_choice.h"
#include "hal/linux/check.h"
#include "hal/linux/device_user.h"

enum { MEDIA_NODES = 64 };

/* @return Are there media devices, in which libcamera finds cameras, and may all be opened? */
static bool has_media(check_t *check, const char *which)
{
    char path[CHECK_WORD_LENGTH];
    int media = 0, refused = 0;
    for (int n = 0; n < MEDIA_NODES; n++) {
        (void)snprintf(path, sizeof path, "%s/dev/media%d", check->root, n);
        if (access(path, F_OK) != 0)
            continue;
        media++;
        refused += access(path, R_OK | W_OK) != 0;
    }
    if (media == 0)
        check_miss(check, "plug it in, or load its overlay as the page of the board has it; cam --list",
                   "camera: libcamera has no media device to find \"%s\" in", which);
    else if (refused > 0)
        check_miss(check, "sudo usermod -aG video $USER, then log in anew",
                   "camera: this user may not open %d of %d media devices", refused, media);
    return media > 0 && refused == 0;
}

/* Miss a camera, or find that a program has it: libcamera does not list those of others that run. */
static void tell_missing(check_t *check, const char *error)
{
    char path[CHECK_WORD_LENGTH], who[DEVICE_USER_LENGTH];
    for (int n = 0; n < MEDIA_NODES; n++) {
        (void)snprintf(path, sizeof path, "%s/dev/media%d", check->root, n);
        if (access(path, F_OK) != 0 || !device_user(who, path))
            continue;
        check_held(check, "camera", path, who, "stop that program");
        return;
    }
    check_miss(check, NULL, "camera: %s %s", check->table->camera, error);
}

static void check_pictures(check_t *check, libcamera_session_t *session, int camera, const camera_name_t *name)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    picture_t picture;
    if (check->needs == NULL)
        return;
    const camera_wanted_t wanted = {
        .name = *name,
        .width = check->needs->picture_width,
        .height = check->needs->picture_height,
    };
    if (camera_libcamera_fit(session, camera, &wanted, &picture, error))
        check_found(check, "camera: %s gives %s of %dx%d", check->table->camera, camera_format_name(picture.format),
                    picture.width, picture.height);
    else
        check_miss(check, NULL, "camera: %s %s", check->table->camera, error);
}

void check_libcamera(check_t *check, const camera_name_t *name)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    libcamera_session_t *session;
    if (!has_media(check, name->which))
        return;
    if (!camera_libcamera_start(&session, error)) {
        check_miss(check, NULL, "camera: %s", error);
        return;
    }
    for (int i = 0; i < libcamera_count(session); i++) {
        libcamera_name_t about;
        libcamera_name(session, i, &about);
        check_found(check, "camera: libcamera:%d, %s, \"%s\"", i, about.model, about.id);
    }
    const int camera = camera_libcamera_find(session, name->which, error);
    if (camera < 0)
        tell_missing(check, error);
    else if (libcamera_acquire(session, camera) == -EBUSY)
        tell_missing(check, "is used by another program; close that");
    else
        check_pictures(check, session, camera, name);
    libcamera_close(session);
}
