// SPDX-License-Identifier: Apache-2.0
// The projector's display (hal/hal_display.h) on Linux: a connector of a graphics card, by DRM/KMS without a desktop.
#ifndef HAL_LINUX_DISPLAY_KMS_H
#define HAL_LINUX_DISPLAY_KMS_H

#include <stdint.h>

#include "hal/hal_board.h"
#include "hal/hal_display.h"
#include "hal/hal_status.h"

typedef struct {
    const char *name;                        /**< HDMI-A-1, card1:HDMI-A-1, auto: see kms_name_parse() */
    int32_t width, height;                   /**< of the projector, pixels; width 0: size and rate that it prefers */
    int32_t refresh_frames, refresh_seconds; /**< of the projector, refreshes a second as a fraction */
} display_kms_settings_t;

/**
 * Set the projector's mode, and show black. What was chosen is told on stderr.
 *
 * The card must have atomic mode setting, monotonic time stamps and dumb buffers, and no other user who sets modes. The
 * mode is the offered one of that size whose rate is nearest, at most 1 % off: see kms_mode_choose(). NV12 and YUYV are
 * taken where a plane shows them full screen and can be told the matrix (COLOR_ENCODING) and limited range.
 *
 * Buffers. Three dumb buffers, mapped once and shared by all formats. On real boards they are write-combined: writing
 * is fast, reading is slow, and the firmware only writes. Camera pictures are not imported as DMABUF: the display never
 * shows one, every pixel of a panel is made by the CPU, so there is no copy to save.
 *
 * Flips. A presented picture is given to the kernel at once, which shows it from the next vertical blank on and never
 * tears. The kernel does not give it back: of several presented before one blank the first is shown for one refresh,
 * then the last, and those between never.
 *
 * Blanks. Times are the kernel's, of the first line that is scanned out after the blank; between two of them the next
 * is told from the measured period. Drivers of virtual displays that have no vertical blanks (virtio-gpu, bochs) show
 * pictures as they come: blanks are then those of the mode's rate, on the board's own clock.
 *
 * Cable out, projector off, or another program has taken the display: hal_display_back_buffer() and _present() return
 * HAL_IO, hal_display_wait_vblank() too when a blank would have come. The connector is looked at within
 * hal_display_wait_vblank(), 20 times a second (a projector that changes what it is must be off for 100 ms:
 * HDMI 1.4b, 8.5), at the cost of one read of a file that the kernel keeps. When it is back the mode is chosen and set
 * again, and the last picture shown; that takes tens of milliseconds, is tried twice a second, and needs the same size
 * and rate to be offered.
 *
 * @param[out] display  Written only when HAL_OK is returned.
 * @param[out] error    Else: one line, what failed, with which device, what was expected.
 * @return HAL_OK; HAL_BAD_CALL when a setting is wrong; HAL_IO when the device is missing or refuses, or offers no such
 *         mode.
 */
MUST_CHECK hal_status_t display_kms_open(hal_display_t **display, const display_kms_settings_t *settings,
                                         char error[HAL_BOARD_ERROR_LENGTH]);

/** Set the display back to what it was before. NULL is allowed. */
void display_kms_close(hal_display_t *display);

#endif
