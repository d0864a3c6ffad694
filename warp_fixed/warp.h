// SPDX-License-Identifier: Apache-2.0
// One corrected frame: homography + picture -> what the projector must show.
#ifndef WARP_FIXED_WARP_H
#define WARP_FIXED_WARP_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/footprint_from_homography.h"
#include "warp_fixed/grid_from_homography.h"
#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/image.h"
#include "warp_fixed/kernels.h"
#include "warp_fixed/levels.h"
#include "warp_fixed/ls_fit.h"
#include "warp_fixed/method.h"
#include "warp_fixed/prefilter.h"
#include "warp_fixed/window_weights.h"

/** Which weights and which level of the picture serve a block, along both axes. */
typedef struct {
    window_side_t x, y;
} warp_block_t;

enum { WARP_TABLES = 4 };

/** The weights of one resampler. */
typedef struct {
    warp_resampler_t resampler;
    bool of_coefficients;
    window_weights_t weights;
} warp_table_t;

/** Everything a board needs between and within frames; about 162 MB, most of it never touched by small pictures. */
typedef struct {
    warp_method_t method;       /**< of the next frames */
    bool filters;               /**< that method filters or makes splines, at some steps at least */
    bool fits;                  /**< ready for WARP_LS, else for methods that filter */
    bool step_all;              /**< take k over the whole wall, not only over what lands in the picture */
    uint8_t border[4];          /**< B, G, R, X of unlit pixels; border[0] alone for gray */
    warp_resampler_t resampler; /**< of the present frame: the method's, unless that is WARP_AUTO */
    int32_t tables;
    warp_table_t table[WARP_TABLES];        /**< of the methods that it is ready for: the first `tables` */
    int32_t texel_table, coefficient_table; /**< of the method in use, where it has them */
    grid_t grid;
    footprint_blocks_t blocks;
    warp_block_t block[IMAGE_MAX_WIDTH];
    levels_t levels;
    union {
        prefilter_t prefilter;
        ls_t ls;
    }; /**< ls if it fits */
} warp_t;

/** What a frame turned out to be, for telemetry and evaluation. */
typedef struct {
    int32_t k_in_q16;           /**< step k over pixels in the picture (eq 4, 5); 0 when none is */
    int32_t k_all_q16;          /**< step k over the whole wall; saturates when part of it is behind the viewer */
    int32_t lit_pixels;         /**< panel pixels that show picture */
    warp_resampler_t resampler; /**< that was used: the method's, or WARP_AUTO's choice */
} warp_report_t;

/**
 * Prepare for a method: build its weight tables. Takes some milliseconds; call it before the loop.
 *
 * @param[out] warp    Need not be initialised. Holds no pointer into itself or elsewhere: may be moved.
 * @param      border  Colour of unlit pixels: R, G, B.
 */
void warp_init(warp_t *warp, warp_method_t method, bool step_all, const uint8_t border[3]);

/**
 * Be ready for another method too, without more of the large buffers. Takes some milliseconds; call it before the loop.
 *
 * @return false, and nothing is changed, when there is no room for its weights: WARP_TABLES in all, one for a method,
 *         two for auto and for a filter with linear or cubic, none for nearest and ls; shared by methods that resample
 *         alike. Also when it is ls and the first one was not, or filters or makes splines and the first one was
 *         ls: they use the same memory.
 */
bool warp_add_method(warp_t *warp, warp_method_t method);

/** Make the next frames with a method that it is ready for, by warp_init() or warp_add_method(). Takes no time. */
void warp_use_method(warp_t *warp, warp_method_t method);

/**
 * Give method ls other weights than its uniform ones; other methods have none, and this does nothing.
 *
 * @param warp     After warp_init().
 * @param weights  For pictures of the size that frames will have; copied.
 */
void warp_set_ls_weights(warp_t *warp, const ls_weights_t *weights);

/**
 * Make one frame. Every panel pixel is written, nothing else.
 *
 * @param      kernels     Which implementation of the pixel loops.
 * @param[out] report      May be NULL.
 * @param      homography  Panel and picture sizes must be those of the images.
 * @param      panel       Destination; must not overlap the picture.
 * @param      picture     Source, of the panel's format.
 * @return false, and nothing written, when sizes or formats disagree or exceed IMAGE_MAX_WIDTH x IMAGE_MAX_HEIGHT.
 *
 * No allocation. Time is bounded: a lit pixel reads WINDOW_MAX_TAPS x WINDOW_MAX_TAPS texels at most. Together they
 * read some 36 texels per lit pixel, or where footprints are larger than that a small multiple of the picture's own
 * pixels: 1 to 4 times it, and A / 2 times that when footprints of aspect ratio A stand askew (A is 11 at 85 degrees).
 * Filters, splines and fits cost per picture pixel besides (prefilter.h, ls_fit.h); nothing if none is lit.
 */
bool warp_frame(warp_t *warp, const warp_kernels_t *kernels, warp_report_t *report, const homography_t *homography,
                const image_t *panel, const image_t *picture);

#endif
