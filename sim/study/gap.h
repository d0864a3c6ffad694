// SPDX-License-Identifier: Apache-2.0
// How far every method is below the limit, under the paper's truth and against a finer original.
#ifndef SIM_STUDY_GAP_H
#define SIM_STUDY_GAP_H

#include "sim/study/study.h"

/**
 * Measure in three rooms (eq, low, gt: picture as fine as the projector, coarser, finer) and write the section of the
 * page, with plots.
 *
 * gap_ROOM_TRUTH.csv  the mean gap over the pictures by angle, a column for each method;
 * gap_cases.csv       every case: PSNR of the limit and of each method;
 * gap_table_TRUTH.csv mean and worst gap of each method;
 * gap_claims.csv      a row for each room and each figure of gap_contests.h: it holds when cases = wins;
 * gap_samples.csv     one case with more and more samples.
 */
void study_gap(study_t *study);

#endif
