// SPDX-License-Identifier: Apache-2.0
// The way of a picture through the card: plane, CRTC, connector; set to a mode, and set back at the end.
#ifndef HAL_LINUX_DISPLAY_KMS_PIPE_H
#define HAL_LINUX_DISPLAY_KMS_PIPE_H

#include <stdbool.h>
#include <stdint.h>
#include <xf86drmMode.h>

#include "hal/hal_board.h"
#include "hal/hal_status.h"
#include "hal/linux/display_kms_card.h"
#include "hal/linux/display_kms_plane.h"
#include "hal/linux/display_kms_request.h"
#include "warp_fixed/picture.h"

enum { KMS_MAX_IDLE_PLANES = 8, KMS_COLOUR_PROPERTIES = 3 };

typedef struct {
    kms_screen_t screen;
    uint32_t connector, connector_crtc;     /**< object, and its property CRTC_ID */
    uint32_t crtc_mode, crtc_active;        /**< the CRTC's properties MODE_ID, ACTIVE */
    uint32_t colour[KMS_COLOUR_PROPERTIES]; /**< and those that change its colours: CTM, DEGAMMA_LUT, GAMMA_LUT */
    uint32_t mode;                          /**< blob of the mode; 0: none yet */
    kms_plane_t plane[PICTURE_FORMATS];     /**< that shows the format; formats may share one; id 0: not taken */
    kms_plane_t idle[KMS_MAX_IDLE_PLANES];  /**< that were on this CRTC and are not wanted */
    int32_t idle_count;
    kms_request_t former;                            /**< what everything was that is changed */
    uint32_t former_blob[KMS_COLOUR_PROPERTIES + 1]; /**< copies of the blobs among it, 0 for none */
} kms_pipe_t;

/**
 * Find CRTC and planes for a connector, and note the values they have. Changes nothing. Uses the heap.
 *
 * @param[out] pipe    Written only when HAL_OK is returned.
 * @param      width   Of the pictures, pixels; and height.
 * @return HAL_OK; HAL_IO: one line in error.
 */
MUST_CHECK hal_status_t kms_pipe_open(kms_pipe_t *pipe, const kms_card_t *card, const drmModeConnector *connector,
                                      int32_t width, int32_t height, char error[HAL_BOARD_ERROR_LENGTH]);

/**
 * Choose the mode of the next kms_pipe_light(), of the pictures' size.
 *
 * @return 0, or an errno: the mode is then as before.
 */
int kms_pipe_set_mode(kms_pipe_t *pipe, const drmModeModeInfo *mode);

/** Set mode and picture, and wait until that is done: tens of milliseconds. @return 0, or an errno. */
int kms_pipe_light(const kms_pipe_t *pipe, const kms_scan_t *scan);

/**
 * Show a picture from the next blank on, without waiting; an event tells when it is there.
 *
 * @param token  Comes back with the event.
 * @return 0, or an errno: EBUSY while the last one is still on its way, EACCES when another program has the display.
 */
int kms_pipe_flip(const kms_pipe_t *pipe, const kms_scan_t *scan, uint64_t token);

/** Could it be shown in place of what is there? Nothing is changed. @return 0, or an errno. */
int kms_pipe_try(const kms_pipe_t *pipe, const kms_scan_t *scan);

/**
 * Switch the output off. Lighting it afterwards begins with it anew, which a projector that was without power needs:
 * the kernel leaves out what seems to be as it was.
 *
 * @return 0, or an errno.
 */
int kms_pipe_darken(const kms_pipe_t *pipe);

/** Set everything back to the noted values; where that is refused, switch the output off. */
void kms_pipe_close(kms_pipe_t *pipe);

#endif
