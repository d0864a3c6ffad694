// SPDX-License-Identifier: Apache-2.0
// The way of a picture through the card: plane, CRTC, connector; set to a mode, and set back at the end.
#include "hal/linux/display_kms_pipe.h"

#include <errno.h>
#include <xf86drm.h>

#include "hal/linux/board_error.h"

static const char *const COLOUR[KMS_COLOUR_PROPERTIES] = {"CTM", "DEGAMMA_LUT", "GAMMA_LUT"};

static hal_status_t refuse(char error[HAL_BOARD_ERROR_LENGTH], const kms_card_t *card, const char *what)
{
    return board_error(error,
                       "display: card%d:%s: no free %s of driver %s; expected one, end other programs that show "
                       "pictures",
                       card->number, card->connector_name, what, card->driver);
}

/* @return Which CRTCs a connector may have, a bit for each. */
static uint32_t possible_crtcs(const kms_card_t *card, const drmModeConnector *connector)
{
    uint32_t possible = 0;
    for (int i = 0; i < connector->count_encoders; i++) {
        drmModeEncoder *encoder = drmModeGetEncoder(card->file, connector->encoders[i]);
        possible |= encoder == NULL ? 0 : encoder->possible_crtcs;
        drmModeFreeEncoder(encoder);
    }
    return possible;
}

/* The CRTC that the connector has already, else the first that shows nothing. */
static bool find_crtc(kms_pipe_t *pipe, const kms_card_t *card, const drmModeConnector *connector)
{
    uint64_t present = 0;
    pipe->connector_crtc =
        kms_property(card->file, connector->connector_id, DRM_MODE_OBJECT_CONNECTOR, "CRTC_ID", &present);
    const uint32_t possible = possible_crtcs(card, connector);
    drmModeRes *resources = drmModeGetResources(card->file);
    for (int i = 0; resources != NULL && i < resources->count_crtcs && pipe->screen.crtc == 0; i++) {
        uint64_t active = 0;
        (void)kms_property(card->file, resources->crtcs[i], DRM_MODE_OBJECT_CRTC, "ACTIVE", &active);
        if (present == 0 ? (possible >> i & 1) != 0 && active == 0 : resources->crtcs[i] == present) {
            pipe->screen.crtc = resources->crtcs[i];
            pipe->screen.crtc_index = i;
        }
    }
    drmModeFreeResources(resources);
    return pipe->screen.crtc != 0;
}

/* A noted blob may go when the last who uses it does: keep a copy in its place. */
static void note_blob(kms_pipe_t *pipe, int kept, const char *name)
{
    const int32_t noted = pipe->former.count;
    kms_request_add_present(&pipe->former, pipe->screen.card, pipe->screen.crtc, DRM_MODE_OBJECT_CRTC, name);
    if (pipe->former.count == noted)
        return;
    pipe->former_blob[kept] = kms_blob_copy(pipe->screen.card, pipe->former.value[noted]);
    pipe->former.value[noted] = pipe->former_blob[kept];
}

static void find_crtc_properties(kms_pipe_t *pipe)
{
    const int card = pipe->screen.card;
    const uint32_t crtc = pipe->screen.crtc;
    pipe->crtc_mode = kms_property(card, crtc, DRM_MODE_OBJECT_CRTC, "MODE_ID", NULL);
    pipe->crtc_active = kms_property(card, crtc, DRM_MODE_OBJECT_CRTC, "ACTIVE", NULL);
    kms_request_add_present(&pipe->former, card, pipe->connector, DRM_MODE_OBJECT_CONNECTOR, "CRTC_ID");
    kms_request_add_present(&pipe->former, card, crtc, DRM_MODE_OBJECT_CRTC, "ACTIVE");
    note_blob(pipe, KMS_COLOUR_PROPERTIES, "MODE_ID");
    for (int i = 0; i < KMS_COLOUR_PROPERTIES; i++) {
        pipe->colour[i] = kms_property(card, crtc, DRM_MODE_OBJECT_CRTC, COLOUR[i], NULL);
        note_blob(pipe, i, COLOUR[i]);
    }
}

static bool is_wanted(const kms_pipe_t *pipe, uint32_t plane, int formats)
{
    for (int format = 0; format < formats; format++)
        if (pipe->plane[format].id == plane)
            return true;
    return false;
}

/* Others may lie above ours: a pointer's, a video's. */
static void find_idle_planes(kms_pipe_t *pipe)
{
    const int card = pipe->screen.card;
    drmModePlaneRes *resources = drmModeGetPlaneResources(card);
    for (uint32_t i = 0; resources != NULL && i < resources->count_planes; i++) {
        drmModePlane *plane = drmModeGetPlane(card, resources->planes[i]);
        if (plane != NULL && plane->crtc_id == pipe->screen.crtc &&
            !is_wanted(pipe, plane->plane_id, PICTURE_FORMATS) && pipe->idle_count < KMS_MAX_IDLE_PLANES) {
            kms_plane_t *idle = &pipe->idle[pipe->idle_count++];
            idle->id = plane->plane_id;
            idle->framebuffer = kms_property(card, idle->id, DRM_MODE_OBJECT_PLANE, "FB_ID", NULL);
            idle->crtc = kms_property(card, idle->id, DRM_MODE_OBJECT_PLANE, "CRTC_ID", NULL);
            kms_request_add_present(&pipe->former, card, idle->id, DRM_MODE_OBJECT_PLANE, "FB_ID");
            kms_request_add_present(&pipe->former, card, idle->id, DRM_MODE_OBJECT_PLANE, "CRTC_ID");
        }
        drmModeFreePlane(plane);
    }
    drmModeFreePlaneResources(resources);
}

hal_status_t kms_pipe_open(kms_pipe_t *pipe, const kms_card_t *card, const drmModeConnector *connector, int32_t width,
                           int32_t height, char error[HAL_BOARD_ERROR_LENGTH])
{
    static const picture_format_t offered[] = {PICTURE_XRGB8888, PICTURE_NV12, PICTURE_YUYV};
    kms_pipe_t opened = {
        .screen = {.card = card->file, .width = width, .height = height},
        .connector = connector->connector_id,
    };
    if (!find_crtc(&opened, card, connector))
        return refuse(error, card, "CRTC");
    for (size_t i = 0; i < sizeof offered / sizeof *offered; i++)
        (void)kms_plane_find(&opened.plane[offered[i]], &opened.screen, offered[i]);
    if (opened.plane[PICTURE_XRGB8888].id == 0)
        return refuse(error, card, "primary plane for XRGB8888");
    find_crtc_properties(&opened);
    for (int format = 0; format < PICTURE_FORMATS; format++)
        if (opened.plane[format].id != 0 && !is_wanted(&opened, opened.plane[format].id, format))
            kms_plane_add_present(&opened.former, &opened.plane[format], card->file);
    find_idle_planes(&opened);
    *pipe = opened;
    return HAL_OK;
}

int kms_pipe_set_mode(kms_pipe_t *pipe, const drmModeModeInfo *mode)
{
    uint32_t blob;
    if (drmModeCreatePropertyBlob(pipe->screen.card, mode, sizeof *mode, &blob) != 0)
        return errno;
    if (pipe->mode != 0)
        (void)drmModeDestroyPropertyBlob(pipe->screen.card, pipe->mode);
    pipe->mode = blob;
    return 0;
}

/* The picture on the plane of its format, and nothing on those of others. */
static void add_scan(kms_request_t *request, const kms_pipe_t *pipe, const kms_scan_t *scan)
{
    const kms_plane_t *shown = &pipe->plane[scan->format];
    for (int format = 0; format < PICTURE_FORMATS; format++)
        if (pipe->plane[format].id != 0 && pipe->plane[format].id != shown->id)
            kms_plane_hide(request, &pipe->plane[format]);
    kms_plane_show(request, shown, &pipe->screen, scan);
}

int kms_pipe_light(const kms_pipe_t *pipe, const kms_scan_t *scan)
{
    kms_request_t request = {0};
    kms_request_add(&request, pipe->connector, pipe->connector_crtc, pipe->screen.crtc);
    kms_request_add(&request, pipe->screen.crtc, pipe->crtc_mode, pipe->mode);
    kms_request_add(&request, pipe->screen.crtc, pipe->crtc_active, 1);
    for (int i = 0; i < KMS_COLOUR_PROPERTIES; i++)
        kms_request_add(&request, pipe->screen.crtc, pipe->colour[i], 0);
    for (int32_t i = 0; i < pipe->idle_count; i++)
        kms_plane_hide(&request, &pipe->idle[i]);
    add_scan(&request, pipe, scan);
    return kms_request_commit(&request, pipe->screen.card, DRM_MODE_ATOMIC_ALLOW_MODESET, 0);
}

int kms_pipe_flip(const kms_pipe_t *pipe, const kms_scan_t *scan, uint64_t token)
{
    kms_request_t request = {0};
    add_scan(&request, pipe, scan);
    return kms_request_commit(&request, pipe->screen.card, DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT, token);
}

int kms_pipe_try(const kms_pipe_t *pipe, const kms_scan_t *scan)
{
    kms_request_t request = {0};
    add_scan(&request, pipe, scan);
    return kms_request_commit(&request, pipe->screen.card, DRM_MODE_ATOMIC_TEST_ONLY, 0);
}

int kms_pipe_darken(const kms_pipe_t *pipe)
{
    kms_request_t request = {0};
    kms_request_add(&request, pipe->connector, pipe->connector_crtc, 0);
    kms_request_add(&request, pipe->screen.crtc, pipe->crtc_mode, 0);
    kms_request_add(&request, pipe->screen.crtc, pipe->crtc_active, 0);
    for (int format = 0; format < PICTURE_FORMATS; format++)
        if (pipe->plane[format].id != 0)
            kms_plane_hide(&request, &pipe->plane[format]);
    return kms_request_commit(&request, pipe->screen.card, DRM_MODE_ATOMIC_ALLOW_MODESET, 0);
}

void kms_pipe_close(kms_pipe_t *pipe)
{
    if (pipe->mode != 0 && kms_request_commit(&pipe->former, pipe->screen.card, DRM_MODE_ATOMIC_ALLOW_MODESET, 0) != 0)
        (void)kms_pipe_darken(pipe); /* refused too when the display is gone, or another program's */
    for (int i = 0; i <= KMS_COLOUR_PROPERTIES; i++)
        if (pipe->former_blob[i] != 0)
            (void)drmModeDestroyPropertyBlob(pipe->screen.card, pipe->former_blob[i]);
    if (pipe->mode != 0)
        (void)drmModeDestroyPropertyBlob(pipe->screen.card, pipe->mode);
    *pipe = (kms_pipe_t){0};
}
