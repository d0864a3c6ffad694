// SPDX-License-Identifier: Apache-2.0
// Deletes what an earlier run has left in its folder.
#ifndef SIM_RUN_RUN_CLEAN_H
#define SIM_RUN_RUN_CLEAN_H

#include <stdbool.h>

#include "firmware/room.h"
#include "sim/files/file_io.h"

/** @return Does the file, or the numbered files of that name, lie in the folder? False when a folder is missing. */
bool run_clean_lies_in(const char *folder, const char *file);

/**
 * Delete the files that a run of this room writes, and nothing else: tables, log, plots, page, and the pictures of
 * the boards and the viewer, from number 00000 up to the first number that none of them has.
 *
 * @param      folder  Need not exist.
 * @param[out] error   On failure: which file can't be deleted, and why. Others may be deleted by then.
 */
bool run_clean(const char *folder, const room_t *room, char error[FILE_ERROR_LENGTH]);

#endif
