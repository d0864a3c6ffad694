// SPDX-License-Identifier: Apache-2.0
// A built-in test picture: discs of all sizes, each before the ones drawn earlier, like fallen leaves.
#ifndef SIM_EVAL_LEAVES_PICTURE_H
#define SIM_EVAL_LEAVES_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"

/**
 * Make a GRAY8 picture and its finer original. Radii r are spread as r^-2.5, so the picture has edges at every
 * scale and an amplitude spectrum of about 1 / f, as photographs have, whatever its size. The same bytes on every call.
 *
 * @param      width,height  Of the picture, pixels, 1 to 4096 each.
 * @param      finer         The original has so many times as many pixels along each axis, 1 to 16.
 * @param[out] picture       finer x finer means of the original, rounded half up. The caller frees its data.
 * @param[out] original      The same.
 * @return false, with nothing written, when memory is out.
 */
bool leaves_picture(int32_t width, int32_t height, int32_t finer, image_t *picture, image_t *original);

#endif
