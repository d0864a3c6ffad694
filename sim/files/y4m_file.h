// SPDX-License-Identifier: Apache-2.0
// YUV4MPEG2 files (.y4m): uncompressed 8-bit video.
#ifndef SIM_FILES_Y4M_FILE_H
#define SIM_FILES_Y4M_FILE_H

#include <stdint.h>

#include "sim/files/file_io.h"
#include "warp_fixed/image.h"

/**
 * Understood: colour spaces 420jpeg, 420mpeg2, 420paldv, 420, 422, 444 and mono, 8 bits; progressive or unstated; any
 * X parameter. Refused, by name: interlaced video, other colour spaces, header lines over 255 bytes.
 */
typedef struct y4m_file y4m_file_t;

typedef struct {
    int32_t width, height; /**< pixels, up to 4096 x 2160 */
    int32_t frame_count;   /**< 1 or more */
    int32_t rate_frames;   /**< rate_frames pictures in rate_seconds seconds; 30 in 1 when the file does not say */
    int32_t rate_seconds;
} y4m_info_t;

/**
 * Open a file and find all its frames; every frame must be whole. Uses the heap.
 *
 * @param[out] error  On failure: "FILE: what, what was expected", with the frame's number (from 0) where one is broken.
 * @return NULL on failure.
 */
y4m_file_t *y4m_file_open(const char *path, char error[FILE_ERROR_LENGTH]);

/** Close; NULL is allowed. */
void y4m_file_close(y4m_file_t *file);

/** @return What the file holds; valid until it is closed. */
const y4m_info_t *y4m_file_info(const y4m_file_t *file);

/**
 * Read and convert one frame.
 *
 * BT.709 when the picture is 720 lines or higher, else BT.601; limited range unless the header says XCOLORRANGE=FULL
 * (sim/files/yuv_to_rgb.h has the formula). Each chroma sample is used unchanged for all pixels it covers. Gray is the
 * luma (sim/files/pixel.h) of the converted colour.
 *
 * @param index  0 to frame_count - 1.
 * @param image  Of the file's size. Its pixels are written only on success.
 * @return true, or false with the reason in error.
 */
bool y4m_file_frame(y4m_file_t *file, int32_t index, const image_t *image, char error[FILE_ERROR_LENGTH]);

#endif
