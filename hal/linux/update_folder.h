// SPDX-License-Identifier: Apache-2.0
// The update agent (hal/hal_update.h): a program of its own, with rights that the firmware lacks, behind two files in a
// folder of tmpfs.
//
// `request`, one line: `install SOURCE`, `switch` or `good`. It appears whole, by a rename, and never in place of one
// that is still there. The agent writes `state` anew, by a rename too, and takes `request` away after that: so a state
// beside a request is the one from before it.
//
// `state`, lines of key=value, at most UPDATE_STATE_BYTES: `state` (idle, installing, ready, failed or switching; must
// be there), `progress` (0 to 100), `slot` (A or B), `trial` (0 or 1), `running`, `waiting`, `other` (versions),
// `message`. Without `other` it is what waits. Other keys are passed over.
//
// tmpfs is memory: nothing here waits for a card. On the virtual board, kernel and all: to read the state takes 22,000
// instructions, of 2,000 times at most 37,000; to ask for something 37,000, at most 74,000. At one a cycle that is 25
// and 50 us of a Raspberry Pi 4, once a second and after a frame's stages, so no thread of its own does it.
#ifndef HAL_LINUX_UPDATE_FOLDER_H
#define HAL_LINUX_UPDATE_FOLDER_H

#include "hal/hal_board.h"
#include "hal/hal_update.h"

enum { UPDATE_STATE_BYTES = 1023 };

static const char update_folder_path[] = "/run/wallwarp/update";

/**
 * Begin to look at a folder. It need not be there: there is no agent then, until it is.
 *
 * @param[out] update  Written only when HAL_OK is returned.
 * @param      folder  At most 200 characters.
 * @param[out] error   On failure: one line.
 * @return HAL_OK; HAL_IO when the name is too long, or memory is out.
 */
MUST_CHECK hal_status_t update_folder_open(hal_update_t **update, const char *folder,
                                           char error[HAL_BOARD_ERROR_LENGTH]);

/** NULL is allowed. */
void update_folder_close(hal_update_t *update);

/**
 * Read the text of `state`.
 *
 * @param[out] state  Written only when true is returned.
 * @param      text   Ends with a zero.
 * @return false when `state` is missing, or the value of a known key is not a legal one. A message that is too long is
 *         cut, and what is not printable ASCII in it becomes '?'.
 */
bool update_folder_read_state(hal_update_state_t *state, const char *text);

#endif
