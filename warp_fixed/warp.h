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
#include "warp_fixed/picture.h"
#include "warp_fixed/prefilter.h"
#include "warp_fixed/window_weights.h"
#include "warp_fixed/workers.h"

enum { WARP_BAND_ROWS = FOOTPRINT_BAND, WARP_MAX_BANDS = (IMAGE_MAX_HEIGHT + WARP_BAND_ROWS - 1) / WARP_BAND_ROWS };

/** Which weights and which level of the picture serve a block, along both axes. */
typedef struct {
    window_side_t x, y;
} warp_block_t;

/** A plane of the present frame: where its pixels fall, and what they read. */
typedef struct {
    image_t panel; /**< data is NULL when its pixels go into the worker's own rows first */
    image_t picture;
    uint8_t border[4]; /**< a pixel that is not lit */
    grid_t grid;
    bool filtered; /**< read is what the prefilter makes of the picture */
    int32_t bands; /**< of WARP_BAND_ROWS rows of the panel, the last may have less */
    bool
        is_turned; /**< the panel's rows run across the picture's by 30 degrees or more, in the middle of what is lit */
    uint8_t block_log2[WARP_MAX_BANDS];                                   /**< size of the band's blocks */
    warp_block_t block[WARP_MAX_BANDS][IMAGE_MAX_WIDTH / FOOTPRINT_BAND]; /**< of bands where they have the full size */
} warp_plane_t;

/** What one worker has to itself. */
typedef struct {
    footprint_blocks_t sides;
    warp_block_t block[IMAGE_MAX_WIDTH];                /**< of a row of smaller blocks */
    bool wanted[PICTURE_MAX_PLANES][LEVELS][LEVELS];    /**< [][x level][y level]: some block of its bands reads it */
    uint8_t luma[2 * WARP_BAND_ROWS * IMAGE_MAX_WIDTH]; /**< rows to be converted to the panel's format */
    uint8_t chroma[WARP_BAND_ROWS * IMAGE_MAX_WIDTH];
} warp_scratch_t;

enum { WARP_TABLES = 4 };

/** The weights of one resampler. */
typedef struct {
    warp_resampler_t resampler;
    bool of_coefficients;
    window_weights_t weights;
} warp_table_t;

/** Everything a board needs between and within frames; about 201 MB, most of it never touched by small pictures. */
typedef struct {
    warp_method_t method;       /**< of the next frames */
    bool filters;               /**< that method filters or makes splines, at some steps at least */
    bool fits;                  /**< ready for WARP_LS, else for methods that filter */
    bool step_all;              /**< take k over the whole wall, not only over what lands in the picture */
    uint8_t border[4];          /**< B, G, R, X of unlit pixels; B is the level of gray ones */
    warp_resampler_t resampler; /**< of the present frame: the method's, unless that is WARP_AUTO */
    int32_t tables;
    warp_table_t table[WARP_TABLES];        /**< of the methods that it is ready for: the first `tables` */
    int32_t texel_table, coefficient_table; /**< of the method in use, where it has them */
    const warp_kernels_t *kernels;          /**< of the present frame */
    picture_t panel, picture;
    int32_t planes;
    homography_t homography;
    bool step_known; /**< else the frame did not need it */
    footprint_step_t step;
    bool any_lit;
    int32_t unit_bands; /**< bands are dealt in units of so many of plane 0, and one of plane 1 */
    int32_t units;
    int32_t cost_before[WARP_MAX_BANDS + 1]; /**< of all units above */
    warp_plane_t plane[PICTURE_MAX_PLANES];  /**< all of a pixel; or luma, and chroma with pixels of its own size */
    warp_scratch_t scratch[WORKERS_MAX];
    uint8_t converted[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * 4]; /**< planes of a picture that came in another format */
    levels_t levels;
    union {
        prefilter_t prefilter;
        ls_t ls;
    }; /**< ls if it fits */
} warp_t;

/** What a frame turned out to be, for telemetry and evaluation. */
typedef struct {
    int32_t k_in_q16;           /**< step k over pixels in the picture (eq 4, 5); 0 when none is, and when not known */
    int32_t k_all_q16;          /**< step k over the whole wall; saturates when part of it is behind the viewer */
    int32_t lit_pixels;         /**< panel pixels that show picture */
    warp_resampler_t resampler; /**< that was used: the method's, or WARP_AUTO's choice */
} warp_report_t;

/**
 * Prepare for a method: build its weight tables. Takes some milliseconds; call it before the loop.
 *
 * @param[out] warp    Need not be initialised. Between frames it may be moved.
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

/** @return Is it ready for this method? */
bool warp_has_method(const warp_t *warp, warp_method_t method);

/** Make the next frames with a method that it is ready for, by warp_init() or warp_add_method(). Takes no time. */
void warp_use_method(warp_t *warp, warp_method_t method);

/**
 * Give method ls other weights than its uniform ones; other methods have none, and this does nothing.
 *
 * @param warp     After warp_init().
 * @param weights  For pictures of the size that frames will have; copied.
 */
void warp_set_ls_weights(warp_t *warp, const ls_weights_t *weights);

/** What is done for a frame after its plan, in this order. */
typedef enum {
    WARP_MEASURE,     /**< sides of all blocks */
    WARP_TAKE,        /**< the picture's planes, where its format has no such planes: what the panel shows of them */
    WARP_REDUCE,      /**< levels that these need */
    WARP_FILTER,      /**< filtered picture, or coefficients */
    WARP_FIT_ROWS,    /**< method ls: along x, */
    WARP_FIT_COLUMNS, /**< then along y */
    WARP_DRAW         /**< the panel's pixels */
} warp_step_t;

/**
 * Plan one frame, for any number of workers: then, for each step in order that warp_needs(), all of them do their
 * warp_work(), at the same time or one after the other; none begins a step before all have ended the last one. Every
 * panel pixel is written, nothing else, and the bytes are the same for any number of workers.
 *
 * @param      kernels     Which implementation of the pixel loops.
 * @param[out] report      May be NULL.
 * @param      homography  Panel and picture sizes must be those of the images.
 * @param      panel       Destination; must not overlap the picture. Both stay until the last step is done.
 * @param      picture     Source. GRAY8 goes to GRAY8; XRGB8888, RGB888 and BGR888 to XRGB8888; YUYV, UYVY and NV12 to
 *                         XRGB8888, YUYV and NV12. Luma and chroma are warped apart, the chroma at its own size with
 *                         the homography of its pixels (homography_of_chroma.h) and its own step (chroma_step.h), and
 *                         put together last; for XRGB8888 a panel pixel has the chroma of its rectangle (picture.h), of
 *                         the picture's kind, and so its size must be even as a picture's of that format. A panel of
 *                         YUV gets the picture's matrix, whatever its own.
 * @return false, and nothing written, when a size is not the homography's, or a format or stride is not as above and
 *         in picture.h.
 *
 * No allocation, no locks. Time is bounded: a lit pixel reads WINDOW_MAX_TAPS x WINDOW_MAX_TAPS texels at most.
 * Together they read some 36 texels per lit pixel, or where footprints are larger than that a small multiple of the
 * picture's own pixels: 1 to 4 times it, and A / 2 times that when footprints of aspect ratio A stand askew (A is 11 at
 * 85 degrees). Filters, splines and fits cost per picture pixel besides (prefilter.h, ls_fit.h); nothing if none is
 * lit. The plan itself is O(panel's width + height); a new k means new filters or fits (fir_design.h, ls_axis.h).
 */
bool warp_plan(warp_t *warp, const warp_kernels_t *kernels, warp_report_t *report, const homography_t *homography,
               const picture_t *panel, const picture_t *picture);

/**
 * Fill in step k of the last plan, which warp_plan() works out only for methods that filter, make splines or fit: it
 * takes some 200 instructions for each row and column of the panel.
 *
 * @param[in,out] report  Its two steps are written; 0 before the first plan.
 */
void warp_report_step(const warp_t *warp, warp_report_t *report);

/** @return Is there anything to do in this step of the present frame? */
bool warp_needs(const warp_t *warp, warp_step_t step);

/**
 * Do a worker's share of a step. Bands of rows are dealt so that each worker's follow one another, and cost as nearly
 * the same as bands allow: by lit pixels.
 */
void warp_work(warp_t *warp, warp_step_t step, worker_t worker);

/** Make one frame of gray or XRGB8888 images with one worker: warp_plan() and all its steps; the report has step k. */
bool warp_frame(warp_t *warp, const warp_kernels_t *kernels, warp_report_t *report, const homography_t *homography,
                const image_t *panel, const image_t *picture);

#endif
