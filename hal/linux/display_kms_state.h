// SPDX-License-Identifier: Apache-2.0
// What an open display keeps, and how its dark times end.
#ifndef HAL_LINUX_DISPLAY_KMS_STATE_H
#define HAL_LINUX_DISPLAY_KMS_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_display.h"
#include "hal/linux/display_kms_blank.h"
#include "hal/linux/display_kms_buffers.h"
#include "hal/linux/display_kms_card.h"
#include "hal/linux/display_kms_mode.h"
#include "hal/linux/display_kms_pipe.h"

enum { KMS_NO_BUFFER = -1, KMS_NO_FILE = -1 };

typedef struct {
    picture_format_t format;
    picture_matrix_t matrix;
} kms_look_t;

struct hal_display {
    kms_card_t card;
    kms_pipe_t pipe;
    kms_buffers_t buffers;
    kms_blank_t blank;
    kms_mode_wanted_t wanted;
    bool by_clock; /**< the driver has no vertical blanks: they are the mode's, on the clock */

    kms_look_t look[KMS_BUFFERS];             /**< what is in each buffer */
    int32_t shown, flying, waiting, borrowed; /**< which buffer has that part, or KMS_NO_BUFFER; all different */
    uint64_t asked, flight, answered;         /**< tokens: of the newest request, the last flip, the newest answer */

    int status;        /**< file of the connector's state */
    int64_t looked_ns; /**< when it was read last */
    bool dark;         /**< nothing can be shown */
    bool hangs;        /**< a wait had no answer, and none has come since */
    int64_t lit_ns;    /**< when lighting it was tried last */
};

/** @return The picture in a buffer, to be scanned out. */
kms_scan_t kms_state_scan(const hal_display_t *display, int32_t buffer);

/** Open the file of the connector's state. @return 0, or an errno. */
int kms_state_watch(hal_display_t *display);

/**
 * Set the mode that the connector offers now, and show the newest picture there is. Blocks for tens of milliseconds.
 *
 * @param connector  What it offers.
 * @return 0, or an errno: nothing is changed; ENOENT when it does not offer the wanted mode.
 */
int kms_state_light(hal_display_t *display, const drmModeConnector *connector);

/** Look, when it is time to, whether the projector is still there, or there again, and light it in that case. */
void kms_state_look(hal_display_t *display, int64_t now_ns);

#endif
