// SPDX-License-Identifier: Apache-2.0
// A graphics card's planes and framebuffers as libdrm shows them, played for tests: it notes what it is asked for.
#include "tests/hal/linux/drm_card.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <errno.h>
#include <string.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

drm_card_t drm_card;

/* A property's id is its place here, counted from 1. */
static const char *const properties[] = {"type",  "FB_ID",  "CRTC_ID", "SRC_X",   "SRC_Y",          "SRC_W",
                                         "SRC_H", "CRTC_X", "CRTC_Y",  "CRTC_W",  "CRTC_H",         "unknown to us",
                                         "zpos",  "CTM",    "ACTIVE",  "MODE_ID", "COLOR_ENCODING", "COLOR_RANGE"};

enum { PROPERTIES = sizeof properties / sizeof *properties, PLAIN = PROPERTIES - 2 };

static const drm_card_plane_t *find_plane(uint32_t id)
{
    for (int i = 0; i < DRM_CARD_PLANES; i++)
        if (id != 0 && drm_card.plane[i].id == id)
            return &drm_card.plane[i];
    fail_msg("the card has no plane %u", id);
    return &drm_card.plane[0];
}

drmModePlaneRes *drmModeGetPlaneResources(int card)
{
    static uint32_t ids[DRM_CARD_PLANES];
    static drmModePlaneRes found = {.planes = ids};
    (void)card;
    found.count_planes = 0;
    for (int i = 0; i < DRM_CARD_PLANES; i++)
        if (drm_card.plane[i].id != 0)
            ids[found.count_planes++] = drm_card.plane[i].id;
    return &found;
}

void drmModeFreePlaneResources(drmModePlaneRes *found)
{
    (void)found;
}

drmModePlane *drmModeGetPlane(int card, uint32_t id)
{
    static drmModePlane found;
    static uint32_t formats[DRM_CARD_FORMATS];
    const drm_card_plane_t *plane = find_plane(id);
    (void)card;
    memcpy(formats, plane->format, sizeof formats);
    found = (drmModePlane){.count_formats = DRM_CARD_FORMATS,
                           .formats = formats,
                           .plane_id = id,
                           .crtc_id = plane->crtc,
                           .possible_crtcs = plane->possible_crtcs};
    return &found;
}

void drmModeFreePlane(drmModePlane *found)
{
    (void)found;
}

drmModeObjectProperties *drmModeObjectGetProperties(int card, uint32_t object, uint32_t type)
{
    static uint32_t ids[PROPERTIES];
    static uint64_t values[PROPERTIES];
    static drmModeObjectProperties found = {.props = ids, .prop_values = values};
    const drm_card_plane_t *plane = find_plane(object);
    (void)card;
    assert_int_equal(type, DRM_MODE_OBJECT_PLANE);
    found.count_props = 0;
    for (uint32_t i = 0; i < PROPERTIES; i++)
        if (i < PLAIN || (i == PLAIN ? plane->encodings : plane->ranges)) {
            values[found.count_props] = i == 0 ? plane->type : 0;
            ids[found.count_props++] = i + 1;
        }
    return &found;
}

void drmModeFreeObjectProperties(drmModeObjectProperties *found)
{
    (void)found;
}

drmModePropertyRes *drmModeGetProperty(int card, uint32_t id)
{
    static struct drm_mode_property_enum encodings[] = {
        {DRM_CARD_BT709, "ITU-R BT.709 YCbCr"}, {1, "ITU-R BT.2020 YCbCr"}, {DRM_CARD_BT601, "ITU-R BT.601 YCbCr"}};
    static struct drm_mode_property_enum ranges[] = {{DRM_CARD_FULL, "YCbCr full range"},
                                                     {DRM_CARD_LIMITED, "YCbCr limited range"}};
    static drmModePropertyRes found;
    (void)card;
    assert_in_range(id, 1, PROPERTIES);
    found = (drmModePropertyRes){.prop_id = id};
    (void)strncpy(found.name, properties[id - 1], sizeof found.name - 1);
    if (id == PLAIN + 1) {
        found.enums = encodings;
        found.count_enums = drm_card.without_bt601 ? 2 : 3;
    } else if (id == PLAIN + 2) {
        found.enums = ranges;
        found.count_enums = 2;
    }
    return &found;
}

void drmModeFreeProperty(drmModePropertyPtr found)
{
    (void)found;
}

int drmModeAddFB2(int card, uint32_t width, uint32_t height, uint32_t fourcc, const uint32_t handles[4],
                  const uint32_t pitches[4], const uint32_t offsets[4], uint32_t *id, uint32_t flags)
{
    (void)card;
    assert_int_equal(flags, 0);
    assert_in_range(drm_card.added_count, 0, DRM_CARD_FRAMEBUFFERS - 1);
    if (drm_card.refuses_after != 0 && drm_card.added_count == drm_card.refuses_after) {
        errno = EINVAL;
        return -1;
    }
    drm_card_framebuffer_t *added = &drm_card.added[drm_card.added_count++];
    *added = (drm_card_framebuffer_t){
        .id = 50 + (uint32_t)drm_card.added_count, .width = width, .height = height, .fourcc = fourcc};
    memcpy(added->handle, handles, sizeof added->handle);
    memcpy(added->pitch, pitches, sizeof added->pitch);
    memcpy(added->offset, offsets, sizeof added->offset);
    *id = added->id;
    return 0;
}

int drmModeRmFB(int card, uint32_t id)
{
    (void)card;
    assert_in_range(id, 51, 50 + DRM_CARD_FRAMEBUFFERS);
    assert_int_equal(drm_card.added[id - 51].id, id);
    drm_card.added[id - 51].id = 0;
    return 0;
}

int drmIoctl(int card, unsigned long request, void *argument)
{
    const struct drm_mode_atomic *atomic = argument;
    (void)card;
    assert_int_equal(request, DRM_IOCTL_MODE_ATOMIC);
    const uint32_t *objects = (const uint32_t *)(uintptr_t)atomic->objs_ptr;
    const uint32_t *counts = (const uint32_t *)(uintptr_t)atomic->count_props_ptr;
    const uint32_t *ids = (const uint32_t *)(uintptr_t)atomic->props_ptr;
    const uint64_t *values = (const uint64_t *)(uintptr_t)atomic->prop_values_ptr;
    drm_card.flags = atomic->flags;
    drm_card.token = atomic->user_data;
    drm_card.count = 0;
    for (uint32_t i = 0; i < atomic->count_objs; i++)
        for (uint32_t k = 0; k < counts[i]; k++, drm_card.count++) {
            assert_in_range(drm_card.count, 0, DRM_CARD_VALUES - 1);
            drm_card.object[drm_card.count] = objects[i];
            drm_card.property[drm_card.count] = ids[drm_card.count];
            drm_card.value[drm_card.count] = values[drm_card.count];
        }
    return 0;
}

int64_t drm_card_asked(uint32_t object, const char *property)
{
    for (int32_t i = drm_card.count; i-- > 0;)
        if (drm_card.object[i] == object && strcmp(properties[drm_card.property[i] - 1], property) == 0)
            return (int64_t)drm_card.value[i];
    return -1;
}
