// SPDX-License-Identifier: Apache-2.0
// Planes: which of the card's shows pictures of a format on a CRTC, and what it must be told for that.
#include "hal/linux/display_kms_plane.h"

#include <xf86drm.h>
#include <xf86drmMode.h>

#include "hal/linux/display_kms_buffers.h"

static const char *const PLACE[KMS_PLACE_PROPERTIES] = {"SRC_X",  "SRC_Y",  "SRC_W",  "SRC_H",
                                                        "CRTC_X", "CRTC_Y", "CRTC_W", "CRTC_H"};
static const char *const ENCODING[] = {"ITU-R BT.709 YCbCr", "ITU-R BT.601 YCbCr"};

_Static_assert(PICTURE_BT709 == 0 && PICTURE_BT601 == 1, "the order of ENCODING");

static uint32_t property(const kms_screen_t *screen, uint32_t plane, const char *name)
{
    return kms_property(screen->card, plane, DRM_MODE_OBJECT_PLANE, name, NULL);
}

/* @return Can the plane be told which matrix and range its pictures have? */
static bool find_colour(kms_plane_t *plane, const kms_screen_t *screen)
{
    plane->encoding = property(screen, plane->id, "COLOR_ENCODING");
    plane->range = property(screen, plane->id, "COLOR_RANGE");
    if (plane->encoding == 0 || plane->range == 0)
        return false;
    const int64_t limited = kms_enum_value(screen->card, plane->range, "YCbCr limited range");
    for (int i = 0; i < 2; i++) {
        const int64_t value = kms_enum_value(screen->card, plane->encoding, ENCODING[i]);
        if (value < 0)
            return false;
        plane->encoding_value[i] = (uint64_t)value;
    }
    plane->limited_value = (uint64_t)limited;
    return limited >= 0;
}

static bool find_properties(kms_plane_t *plane, const kms_screen_t *screen, picture_format_t format)
{
    plane->framebuffer = property(screen, plane->id, "FB_ID");
    plane->crtc = property(screen, plane->id, "CRTC_ID");
    for (int i = 0; i < KMS_PLACE_PROPERTIES; i++)
        plane->place[i] = property(screen, plane->id, PLACE[i]);
    return !picture_is_yuv(format) || find_colour(plane, screen);
}

static bool has_format(const drmModePlane *plane, uint32_t fourcc)
{
    for (uint32_t i = 0; i < plane->count_formats; i++)
        if (plane->formats[i] == fourcc)
            return true;
    return false;
}

/* Is it a plane of that type which this CRTC may have, and which shows the format? */
static bool is_fit(const kms_screen_t *screen, const drmModePlane *plane, uint64_t type, picture_format_t format)
{
    uint64_t found_type = DRM_PLANE_TYPE_CURSOR;
    (void)kms_property(screen->card, plane->plane_id, DRM_MODE_OBJECT_PLANE, "type", &found_type);
    return found_type == type && (plane->possible_crtcs >> screen->crtc_index & 1) != 0 &&
           (plane->crtc_id == 0 || plane->crtc_id == screen->crtc) && has_format(plane, kms_fourcc(format));
}

static bool find_of_type(kms_plane_t *plane, const kms_screen_t *screen, uint64_t type, picture_format_t format)
{
    drmModePlaneRes *resources = drmModeGetPlaneResources(screen->card);
    bool found = false;
    for (uint32_t i = 0; resources != NULL && i < resources->count_planes && !found; i++) {
        drmModePlane *candidate = drmModeGetPlane(screen->card, resources->planes[i]);
        if (candidate != NULL && is_fit(screen, candidate, type, format)) {
            kms_plane_t read = {.id = candidate->plane_id};
            found = find_properties(&read, screen, format);
            if (found)
                *plane = read;
        }
        drmModeFreePlane(candidate);
    }
    drmModeFreePlaneResources(resources);
    return found;
}

bool kms_plane_find(kms_plane_t *plane, const kms_screen_t *screen, picture_format_t format)
{
    return find_of_type(plane, screen, DRM_PLANE_TYPE_PRIMARY, format) ||
           (picture_is_yuv(format) && find_of_type(plane, screen, DRM_PLANE_TYPE_OVERLAY, format));
}

void kms_plane_show(kms_request_t *request, const kms_plane_t *plane, const kms_screen_t *screen,
                    const kms_scan_t *scan)
{
    const uint64_t width = (uint64_t)screen->width, height = (uint64_t)screen->height;
    const uint64_t place[KMS_PLACE_PROPERTIES] = {0, 0, width << 16, height << 16, 0, 0, width, height};
    kms_request_add(request, plane->id, plane->framebuffer, scan->framebuffer);
    kms_request_add(request, plane->id, plane->crtc, screen->crtc);
    for (int i = 0; i < KMS_PLACE_PROPERTIES; i++)
        kms_request_add(request, plane->id, plane->place[i], place[i]);
    if (!picture_is_yuv(scan->format))
        return;
    kms_request_add(request, plane->id, plane->encoding, plane->encoding_value[scan->matrix]);
    kms_request_add(request, plane->id, plane->range, plane->limited_value);
}

void kms_plane_hide(kms_request_t *request, const kms_plane_t *plane)
{
    kms_request_add(request, plane->id, plane->framebuffer, 0);
    kms_request_add(request, plane->id, plane->crtc, 0);
}

void kms_plane_add_present(kms_request_t *request, const kms_plane_t *plane, int card)
{
    static const char *const others[] = {"FB_ID", "CRTC_ID", "COLOR_ENCODING", "COLOR_RANGE"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        kms_request_add_present(request, card, plane->id, DRM_MODE_OBJECT_PLANE, others[i]);
    for (int i = 0; i < KMS_PLACE_PROPERTIES; i++)
        kms_request_add_present(request, card, plane->id, DRM_MODE_OBJECT_PLANE, PLACE[i]);
}
