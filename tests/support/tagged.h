// SPDX-License-Identifier: Apache-2.0
// Pictures with the engine's code in them, in the formats of cameras.
#ifndef TESTS_SUPPORT_TAGGED_H
#define TESTS_SUPPORT_TAGGED_H

#include "firmware/frame_tag.h"
#include "sim/tag/paint_tag.h"
#include "tests/support/rng.h"
#include "warp_fixed/image.h"

enum { TAGGED_BYTES = FRAME_TAG_BLOCKS / 8, TAGGED_WIDTH = 96, TAGGED_HEIGHT = 54 };

/** Draw the code; the test fails when there is no room. @param image  XRGB8888 or GRAY8. */
void tagged_paint(const image_t *image, const frame_tag_t *tag);

/** Make a camera's picture of it. @param to  Of any format; GRAY8 has one channel of the image's. */
void tagged_convert(const picture_t *to, const image_t *from);

/** Draw any bits, by the header's words. @return A gray picture of TAGGED_WIDTH x TAGGED_HEIGHT in `pixels`. */
picture_t tagged_draw_bits(uint8_t *pixels, const uint8_t bits[TAGGED_BYTES]);

/** The test fails when the codes differ. */
void tagged_assert(const frame_tag_t *found, const frame_tag_t *expected);

frame_tag_t tagged_random(rng_t *rng);

#endif
