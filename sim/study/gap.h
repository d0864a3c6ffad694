// SPDX-License-Identifier: Apache-2.0
// How far every method is below the limit, under the paper's truth and against a finer original.
#ifndef SIM_STUDY_GAP_H
#define SIM_STUDY_GAP_H

#include "sim/study/study.h"

/**
 * Measure in three rooms (eq, low, gt: picture as fine as the projector, coarser, finer), write
 * gap_ROOM_TRUTH.csv, gap_table.csv, gap_rewards.csv and gap_claims.csv, their plots, and the section of the page.
 */
void study_gap(study_t *study);

#endif
