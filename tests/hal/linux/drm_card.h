// SPDX-License-Identifier: Apache-2.0
// A graphics card's planes and framebuffers as libdrm shows them, played for tests: it notes what it is asked for.
#ifndef TESTS_HAL_LINUX_DRM_CARD_H
#define TESTS_HAL_LINUX_DRM_CARD_H

#include <stdbool.h>
#include <stdint.h>

enum { DRM_CARD_PLANES = 3, DRM_CARD_FORMATS = 3, DRM_CARD_VALUES = 96, DRM_CARD_FRAMEBUFFERS = 8 };

/** Values of the enumerations; other cards have others. */
enum { DRM_CARD_BT601 = 7, DRM_CARD_BT709 = 3, DRM_CARD_LIMITED = 5, DRM_CARD_FULL = 2 };

typedef struct {
    uint32_t id; /**< 0: no plane */
    uint64_t type;
    uint32_t possible_crtcs, crtc;
    uint32_t format[DRM_CARD_FORMATS]; /**< fourcc; 0: none */
    bool encodings, ranges;            /**< COLOR_ENCODING, COLOR_RANGE */
} drm_card_plane_t;

typedef struct {
    uint32_t id, width, height, fourcc;
    uint32_t handle[4], pitch[4], offset[4];
} drm_card_framebuffer_t;

typedef struct {
    drm_card_plane_t plane[DRM_CARD_PLANES];
    bool without_bt601;                                  /**< an encoding less */
    drm_card_framebuffer_t added[DRM_CARD_FRAMEBUFFERS]; /**< id 0: removed again */
    int32_t added_count, refuses_after;                  /**< framebuffers taken until one is refused; 0: all */
    uint32_t flags;                                      /**< of the last atomic request, and what follows */
    uint64_t token;
    int32_t count;
    uint32_t object[DRM_CARD_VALUES], property[DRM_CARD_VALUES];
    uint64_t value[DRM_CARD_VALUES];
} drm_card_t;

extern drm_card_t drm_card;

/** @return What the last atomic request asks for, the latter of two; -1 when it says nothing of it. */
int64_t drm_card_asked(uint32_t object, const char *property);

#endif
