// SPDX-License-Identifier: Apache-2.0
// A video, whatever it is made of: one PNG, numbered PNGs, Y4M, raw pixels, or the test pattern.
#ifndef SIM_FILES_VIDEO_FILE_H
#define SIM_FILES_VIDEO_FILE_H

#include <stdint.h>

#include "sim/files/file_io.h"
#include "warp_fixed/image.h"

/**
 * What a name may be:
 * - "pattern": the built-in test pattern (sim/devices/test_pattern.h); a file of that name is "./pattern";
 * - with one %d or %0Nd in it (frame_%05d.png): numbered PNGs, from 0 or 1 up to the first one missing, at most
 *   VIDEO_MAX_FRAMES; "%%" stands for one %;
 * - ending in .raw, .xrgb or .bgrx: frames of width * height * 4 bytes B, G, R, X, nothing else;
 * - any other file: PNG or Y4M, told apart by its first bytes.
 */
typedef struct video video_t;

enum { VIDEO_MAX_FRAMES = 1000000 };

typedef struct {
    int32_t frame_count;               /**< 1 for a still; TEST_PATTERN_STEPS for the pattern */
    int32_t rate_frames, rate_seconds; /**< as the file says (Y4M), else 30 in 1 */
} video_info_t;

/**
 * Open a video. Every frame is looked for, and the size of each is checked. Uses the heap.
 *
 * @param      width, height  The size of the room's camera, which every frame must have.
 * @param[out] error          On failure: "FILE: what, what was expected".
 * @return NULL on failure.
 */
video_t *video_open(const char *name, int32_t width, int32_t height, char error[FILE_ERROR_LENGTH]);

/** Close; NULL is allowed. */
void video_close(video_t *video);

/** @return What the video holds; valid until it is closed. */
const video_info_t *video_info(const video_t *video);

/**
 * Decode one frame. The newest decoded one is kept, so asking for it again, for another camera, is only a copy.
 * Uses the heap.
 *
 * @param index  0 or more; behind the end the video begins again: frame index % frame_count.
 * @param image  Of the size given to video_open(), XRGB8888 or GRAY8. Its pixels are written only on success.
 * @return true, or false with the reason in error (the file changed or went away since it was opened).
 */
bool video_frame(video_t *video, int64_t index, const image_t *image, char error[FILE_ERROR_LENGTH]);

#endif
