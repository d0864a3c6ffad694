// SPDX-License-Identifier: Apache-2.0
// The EDID that an HDMI receiver shows to the video source: one mode, the room's.
#ifndef HAL_LINUX_EDID_H
#define HAL_LINUX_EDID_H

#include <stdbool.h>
#include <stdint.h>

enum { EDID_BLOCK_BYTES = 128, EDID_BLOCKS = 2, EDID_BYTES = EDID_BLOCK_BYTES * EDID_BLOCKS };

/** A video mode, all of it: sizes in pixels and lines, the pixel clock in kHz. */
typedef struct {
    int32_t width, height;
    int32_t front_px, sync_px, back_px;          /**< the pause of a line, from its last pixel on */
    int32_t front_lines, sync_lines, back_lines; /**< the pause of a picture */
    int32_t clock_khz;
    bool positive_h, positive_v; /**< sync pulses */
    int32_t vic;                 /**< its code in CTA-861, or 0 */
} edid_mode_t;

/**
 * The timing of pictures of some size and rate: CTA-861's where it has one (its rates / 1.001 too), else VESA's CVT
 * with reduced blanking, version 1 (VESA Coordinated Video Timings Standard 1.2, section 3.4).
 *
 * @param[out] mode  Written only when true is returned.
 * @param      rate_frames, rate_seconds  Pictures a second, as a fraction; both at least 1.
 * @return false when EDID or HDMI 1.4 can't state it: width or height outside 64 to 4095, more than 340 MHz, less than
 *         25 MHz.
 */
bool edid_mode(edid_mode_t *mode, int32_t width, int32_t height, int32_t rate_frames, int32_t rate_seconds);

/**
 * Write an EDID 1.3 (VESA E-EDID A.1) with the mode as preferred timing, and a CTA-861 block that says HDMI, so that
 * sources take no other: only 640x480, which every HDMI display must offer, is there besides. RGB, no sound.
 *
 * @param mode  From edid_mode().
 */
void edid_write(uint8_t edid[EDID_BYTES], const edid_mode_t *mode);

#endif
