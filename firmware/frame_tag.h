// SPDX-License-Identifier: Apache-2.0
// The code in a picture's top rows that says which pose it was drawn from: its definition, its decoder, how to hide it.
//
// A render engine draws the code over its finished picture (sim/tag/paint_tag.h and paint_tag.glsl do it), so that a
// board knows the pose that a picture was drawn from, whatever the time that drawing and sending took.
//
// The code is 120 square blocks, each black or white, in rows from the picture's top left corner:
//
//   side       of a block: 8 px; 4 px where the picture is narrower than 320 px (for tests: no margin for JPEG)
//   columns    as many as are whole, picture width / side, but 120 at most
//   rows       120 / columns, rounded up; the last row may be shorter
//   hidden     rows * side + 2: boards do not show so many pixel rows; the picture must be at least twice as high
//
// From 960 px on that is one row of 960 x 8 px, from 480 px on two. Nothing else is drawn: what is beside and below the
// code stays the picture's. Blocks follow one another from left to right, then row by row. Black is 0, white is 1;
// each number has its highest bit first:
//
//   blocks     what
//   16         1111 0011 0101 0000: where black and white are learnt
//   4          version of this code: 1
//   4          viewer, 0 to 3
//   32         capture time of the pose that the picture was drawn from, in microseconds, as its message on the bus has
//              it: modulo 2^32 of the FD frame; modulo 6553600 and a multiple of 100 of the classic set
//   32         frame number: one more with every picture, the same for all boards
//   32         CRC of the 72 bits from the version on, as 9 bytes: CRC-32 of IEEE 802.3 and zlib (reflected polynomial
//              0xEDB88320, start and final xor 0xFFFFFFFF)
//
// Viewer 2, capture time 305419896 us, frame 1000000 give F350 12 12345678 000F4240 AA37A280.
//
// Black is R = G = B = 32 and white 224, as the cable carries them, after any transfer function. The decoder takes the
// mean of each block's middle half, and calls white what is lighter than the middle between the first 16 blocks' black
// and white. So it needs no exact levels: it survives limited and full range, other gammas, JPEG and 4:2:0, a blur and
// a shift of one pixel each. It does not survive scaling, cropping at the top or left, and mirroring.
#ifndef FIRMWARE_FRAME_TAG_H
#define FIRMWARE_FRAME_TAG_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/picture.h"

enum {
    FRAME_TAG_BLOCKS = 120,
    FRAME_TAG_SYNC = 0xF350, /**< the first 16 blocks */
    FRAME_TAG_VERSION = 1,
    FRAME_TAG_VIEWERS = 4,
    FRAME_TAG_MIN_CONTRAST = 48, /**< levels between black and white as captured; painted are 192 */
    FRAME_TAG_MARGIN_PX = 2      /**< hidden below the code: what a blur and a shift take of it there */
};

/** What a code says. */
typedef struct {
    uint32_t capture_time_us; /**< of the pose, as above */
    uint32_t frame_number;
    uint8_t viewer; /**< 0 to FRAME_TAG_VIEWERS - 1 */
} frame_tag_t;

/** Where the code is in pictures of one size. */
typedef struct {
    int32_t side_px; /**< of a block */
    int32_t columns, rows;
    int32_t hidden_px; /**< rows of pixels that must not be seen; even */
} frame_tag_layout_t;

typedef enum {
    FRAME_TAG_OK = 0,
    FRAME_TAG_NONE,    /**< no code: the first 16 blocks are not there, or the picture has no room for it */
    FRAME_TAG_DAMAGED, /**< those are there, but the CRC is wrong: compressed or scaled too much, or torn */
    FRAME_TAG_FOREIGN  /**< the CRC is right, but the version or the viewer is none of those above */
} frame_tag_status_t;

/** @return false when pictures of this size have no room for the code; *layout is then untouched. */
bool frame_tag_layout(frame_tag_layout_t *layout, int32_t width_px, int32_t height_px);

/**
 * Read the code.
 *
 * A picture without it is as good as never taken for one with it: noise must meet 16 + 32 bits, 2^-48; a plain picture
 * has no contrast. Up to 7 blocks read wrong behind the first 16 are always found out, more with 1 - 2^-32.
 *
 * @param[out] tag      Written only when FRAME_TAG_OK is returned.
 * @param      picture  Of any format; YUV of limited or full range. Reads 16 pixels of each block.
 */
frame_tag_status_t frame_tag_decode(frame_tag_t *tag, const picture_t *picture);

/**
 * @return Was the picture drawn from that pose?
 * @param capture_time_us  Of a pose, as its message has it or more than that: it is taken modulo wrap_us.
 * @param wrap_us          CAN_POSE_FD_WRAP_US or CAN_POSE_SET_WRAP_US, whichever message brought the pose.
 */
bool frame_tag_is_of(const frame_tag_t *tag, uint8_t viewer, uint64_t capture_time_us, uint64_t wrap_us);

/**
 * The rows below the code as a picture of their own, in the same memory: it begins `rows_px` further down and is as
 * much less high. Together with frame_tag_camera_below() every pixel keeps its place on the wall, nothing is copied,
 * and nothing of the code is seen, because filters mirror at the new edge. The wall loses what these rows would have
 * lit.
 *
 * A board that reads tags does so with all pictures, whether their code could be read or not. The same rows of
 * ls_weights_t go too: row y of what is left has the weight of row y + rows_px.
 *
 * @param rows_px  Even, 0 to less than the height: the layout's hidden_px.
 */
picture_t frame_tag_picture_below(const picture_t *picture, int32_t rows_px);

/** The viewer's camera for these rows. */
camera_t frame_tag_camera_below(const camera_t *camera, int32_t rows_px);

#endif
