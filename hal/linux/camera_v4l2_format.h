// SPDX-License-Identifier: Apache-2.0
// Which pictures of V4L2 are pictures of ours: pixel formats, layout in memory, colours.
#ifndef HAL_LINUX_CAMERA_V4L2_FORMAT_H
#define HAL_LINUX_CAMERA_V4L2_FORMAT_H

#include <linux/videodev2.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hal/linux/camera_text.h"
#include "warp_fixed/picture.h"

enum { CAMERA_V4L2_FORMATS = 9 };

typedef struct {
    uint32_t fourcc; /**< V4L2_PIX_FMT_... */
    picture_format_t format;
    int planes; /**< separate memories: 2 for NV12M */
} camera_v4l2_format_t;

/** The best first: full colour, then the fewest bytes. */
extern const camera_v4l2_format_t camera_v4l2_formats[CAMERA_V4L2_FORMATS];

/** Where pictures are in a device's buffers. */
typedef struct {
    picture_t picture;                /**< without data */
    int memories;                     /**< of a buffer */
    size_t bytes[PICTURE_MAX_PLANES]; /**< that the picture needs in each memory */
    size_t chroma_offset;             /**< of the second plane, when it is in the first memory */
} camera_v4l2_layout_t;

/**
 * Judge what a device says it will deliver.
 *
 * Colours: limited range, or full range for RGB (picture.h); BT.601 or BT.709. Default means what V4L2's macros say.
 *
 * @param[out] layout  Written only when true is returned.
 * @param      wanted  The format asked for.
 * @param      got     As VIDIOC_S_FMT has left it; of type VIDEO_CAPTURE or VIDEO_CAPTURE_MPLANE.
 * @param      width, height  That it must have.
 * @param[out] error   Else: what does not fit.
 */
bool camera_v4l2_layout(camera_v4l2_layout_t *layout, const camera_v4l2_format_t *wanted, const struct v4l2_format *got,
                        int32_t width, int32_t height, char error[HAL_BOARD_ERROR_LENGTH]);

/** Fill in what to ask VIDIOC_S_FMT for. */
void camera_v4l2_ask(struct v4l2_format *ask, uint32_t type, const camera_v4l2_format_t *wanted, int32_t width,
                     int32_t height);

#endif
