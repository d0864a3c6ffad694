// SPDX-License-Identifier: Apache-2.0
// Pose lists: CSV files of poses with their times.
#ifndef SIM_POSE_POSE_LIST_H
#define SIM_POSE_POSE_LIST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "warp_fixed/homography_from_pose.h"

enum { POSE_LIST_MESSAGE_LENGTH = 512 };

typedef struct {
    int64_t time_us; /**< 0 to 10^16 */
    pose_t pose;
} pose_list_entry_t;

/** One pose or more; times never go back. */
typedef struct {
    pose_list_entry_t *entry; /**< from the heap */
    size_t count;
} pose_list_t;

/**
 * Read a whole pose list. Start-up only: uses the heap.
 *
 * The first line must be time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz; every further line has these eight decimal numbers. Times
 * are rounded to 1 us; poses are read as pose_from_fields() does. Lines may end with CR LF.
 *
 * @param[out] list   Written only when true is returned; free it with pose_list_free().
 * @param[out] error  On failure: "FILE:LINE: COLUMN: what was found, what was expected", one line without newline.
 */
bool pose_list_load(pose_list_t *list, const char *path, char error[POSE_LIST_MESSAGE_LENGTH]);

/** Give the memory back; the list is then empty. */
void pose_list_free(pose_list_t *list);

#endif
