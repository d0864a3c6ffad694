// SPDX-License-Identifier: Apache-2.0
// Which of the modes that a projector offers is the room's.
#ifndef HAL_LINUX_DISPLAY_KMS_MODE_H
#define HAL_LINUX_DISPLAY_KMS_MODE_H

#include <stddef.h>
#include <stdint.h>
#include <xf86drmMode.h>

enum { KMS_NO_MODE = -1, KMS_RATE_TOLERANCE = 100 };

/** What the room file asks of a mode. */
typedef struct {
    int32_t width, height;                   /**< pixels */
    int32_t refresh_frames, refresh_seconds; /**< a fraction, both 1 to 240240 */
} kms_mode_wanted_t;

/** @return Refreshes in 1000 s, rounded, from pixel clock and totals: 59940 for 60000 / 1001 Hz. 0 for no mode. */
int32_t kms_mode_millihertz(const drmModeModeInfo *mode);

/** @return From one vertical blank to the next, ns, rounded. 0 for no mode. */
int64_t kms_mode_period_ns(const drmModeModeInfo *mode);

/**
 * Choose the mode of the wanted size whose rate is nearest; of equals the one that the projector prefers, else the
 * first. Interlaced and line-doubled modes are never chosen. A rate more than 1 / KMS_RATE_TOLERANCE off is another
 * rate: 59.94 does for 60 where 60 is not offered, and so do the 59.81 Hz that projectors of 1280x800 have.
 *
 * @return Its index, or KMS_NO_MODE.
 */
int32_t kms_mode_choose(const drmModeModeInfo *modes, int32_t count, const kms_mode_wanted_t *wanted);

/**
 * @return What the projector itself prefers: the size and rate of the mode so marked, or else of the largest; never an
 *         interlaced or line-doubled mode, nor one that is larger than pictures can be. 640x480 at 60 when none is
 * left.
 */
kms_mode_wanted_t kms_mode_preferred(const drmModeModeInfo *modes, int32_t count);

/**
 * Write what is offered, for people, the wanted size first: "1920x1080 at 60 59.94 50, 1280x720 at 60". Modes that are
 * never chosen are left out. What does not fit is left out at the end, for which "..." stands.
 *
 * @param[out] text  So many bytes, at least 8; ends with a zero byte.
 */
void kms_mode_list(char *text, size_t size, const drmModeModeInfo *modes, int32_t count,
                   const kms_mode_wanted_t *wanted);

#endif
