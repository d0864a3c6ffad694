// SPDX-License-Identifier: Apache-2.0
// Planes: which of the card's shows pictures of a format on a CRTC, and what it must be told for that.
#ifndef HAL_LINUX_DISPLAY_KMS_PLANE_H
#define HAL_LINUX_DISPLAY_KMS_PLANE_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/linux/display_kms_request.h"
#include "warp_fixed/picture.h"

enum { KMS_PLACE_PROPERTIES = 8 };

/** Where planes may show something. */
typedef struct {
    int card;
    uint32_t crtc;
    int32_t crtc_index; /**< its place in the card's list of them */
    int32_t width, height;
} kms_screen_t;

/** A plane: ids of its properties, 0 for one that it does not have. */
typedef struct {
    uint32_t id; /**< 0: no plane */
    uint32_t framebuffer, crtc;
    uint32_t place[KMS_PLACE_PROPERTIES]; /**< SRC_X, _Y, _W, _H, CRTC_X, _Y, _W, _H */
    uint32_t encoding, range;
    uint64_t encoding_value[2]; /**< by picture_matrix_t */
    uint64_t limited_value;
} kms_plane_t;

/** What is shown: a framebuffer, its format and matrix. */
typedef struct {
    uint32_t framebuffer;
    picture_format_t format;
    picture_matrix_t matrix;
} kms_scan_t;

/**
 * Find a plane for pictures of a format: the CRTC's primary one, else for luma and chroma an overlay that no other CRTC
 * has. For those it must also be able to tell the two matrices apart, and limited range. Uses the heap.
 *
 * @param[out] plane  Written only when true is returned.
 */
bool kms_plane_find(kms_plane_t *plane, const kms_screen_t *screen, picture_format_t format);

/** Ask for a picture on the whole screen. */
void kms_plane_show(kms_request_t *request, const kms_plane_t *plane, const kms_screen_t *screen,
                    const kms_scan_t *scan);

/** Ask for nothing on that plane. */
void kms_plane_hide(kms_request_t *request, const kms_plane_t *plane);

/** Add the present value of everything that kms_plane_show() changes. Uses the heap. */
void kms_plane_add_present(kms_request_t *request, const kms_plane_t *plane, int card);

#endif
