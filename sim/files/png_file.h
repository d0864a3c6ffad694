// SPDX-License-Identifier: Apache-2.0
// PNG files: read into, and written from, the pictures of this project.
#ifndef SIM_FILES_PNG_FILE_H
#define SIM_FILES_PNG_FILE_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/files/file_io.h"
#include "warp_fixed/image.h"

/**
 * Reading takes every PNG: any colour type, 1 to 16 bits, interlaced or not, up to 4096 x 2160 pixels.
 *
 * 16 bits become 8 by rounding v * 255 / 65535. Transparent pixels are laid on black: each channel becomes
 * (channel * alpha + 127) / 255. Values are taken as they are: gamma and colour profiles are ignored.
 * To XRGB8888, X is 0 and a gray v becomes B = G = R = v. To GRAY8, colour becomes luma (sim/files/pixel.h).
 *
 * Every function uses the heap and returns true, or false with one line "FILE: what, what was expected" in error
 * (which is not touched on success). A broken file is always an error, never half a picture.
 */

/** Read only the size of the picture. Outputs are written only on success. */
bool png_file_size(const char *path, int32_t *width, int32_t *height, char error[FILE_ERROR_LENGTH]);

/**
 * Read into an existing picture.
 *
 * @param image  Says size and format; the PNG must have exactly this size. Its pixels are written only on success.
 */
bool png_file_read(const char *path, const image_t *image, char error[FILE_ERROR_LENGTH]);

/**
 * Read a picture of any size.
 *
 * @param[out] image  Written only on success: stride is width * format; the caller frees image->data.
 */
bool png_file_load(const char *path, image_format_t format, image_t *image, char error[FILE_ERROR_LENGTH]);

/**
 * Write a picture: 8-bit gray, or 8-bit RGB (X is dropped). Fast rather than small.
 *
 * The pixels go to PATH.part, which is then renamed: whoever opens PATH sees the old file or the whole new one. On
 * failure PATH is untouched and PATH.part is deleted. A device or pipe is written directly.
 */
bool png_file_write(const char *path, const image_t *image, char error[FILE_ERROR_LENGTH]);

#endif
