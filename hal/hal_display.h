// SPDX-License-Identifier: Apache-2.0
// Contract of the projector's own display: draw into a back buffer, show it at the next vertical blank.
#ifndef HAL_HAL_DISPLAY_H
#define HAL_HAL_DISPLAY_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_status.h"
#include "warp_fixed/picture.h"

typedef struct hal_display hal_display_t;

/** @return Can it show pictures of this format? Every display can show XRGB8888; which else never changes. */
bool hal_display_takes(const hal_display_t *display, picture_format_t format);

/**
 * Borrow the buffer that will be shown next.
 *
 * Borrowing again before presenting gives the same buffer, of the format and matrix asked for last. A display may need
 * a blank or two to change between formats, so ask for another one only when the pictures are of another kind.
 *
 * @param      format  One that the display takes.
 * @param      matrix  Which R, G and B the display must make of Y, U and V; else of no meaning.
 * @param[out] buffer  Written only when HAL_OK is returned: of the projector's size, that format and matrix, contents
 *                     unspecified, the caller's alone until hal_display_present().
 * @return HAL_OK; HAL_BAD_CALL when the display does not take the format; HAL_FULL when every buffer still waits to be
 *         shown; HAL_IO when the display is gone.
 */
MUST_CHECK hal_status_t hal_display_back_buffer(hal_display_t *display, picture_format_t format,
                                                picture_matrix_t matrix, picture_t *buffer);

/**
 * Show the borrowed back buffer from the next vertical blank on. Returns at once; never tears.
 *
 * Of several presented before one blank the last stays. A display that can't take a picture back shows the first of
 * them for one refresh before it; those between are never shown.
 *
 * @return HAL_OK; HAL_BAD_CALL when no buffer is borrowed; HAL_IO when the flip was refused: the wall keeps its
 *         last picture and the buffer counts as given back.
 */
MUST_CHECK hal_status_t hal_display_present(hal_display_t *display);

/** @return When a buffer presented now reaches the wall: the next vertical blank, us on hal_time's clock. */
int64_t hal_display_next_vblank_us(const hal_display_t *display);

/**
 * Sleep until the next vertical blank: the firmware's only wait.
 *
 * @param display  NULL where hal_board_open_some() found none: the call takes 20 ms.
 * @return HAL_OK after the blank; HAL_IO when there is no display (gone, cable out), at the time of the blank that it
 *         would have had, so that the loop keeps its pace; HAL_IO when none came within 100 ms, and from then on at the
 *         time of each that should come. Go on all the same.
 */
MUST_CHECK hal_status_t hal_display_wait_vblank(hal_display_t *display);

#endif
