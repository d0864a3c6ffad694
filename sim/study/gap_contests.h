// SPDX-License-Identifier: Apache-2.0
// What must hold of the adaptive family in every room, at every angle, for every picture.
#ifndef SIM_STUDY_GAP_CONTESTS_H
#define SIM_STUDY_GAP_CONTESTS_H

#include "sim/study/study_mesh_tally.h"

enum { GAP_CONTESTS = 3 };

/** A figure that must hold: the contest must be won in every case. */
typedef struct {
    const char *name; /**< of its row of gap_claims.csv */
    const char *claim;
    study_duel_t duel;
} gap_contest_t;

/**
 * area_below_limit: area is at most 0.12 dB below the limit; area_below_paper: and at most 0.02 dB below any method of
 * the paper, both under the paper's truth. mean_below_best: against the original, the better of mean+cubic and
 * mean+spline is at most 0.05 dB below the best of all methods.
 */
void gap_contests(gap_contest_t contest[GAP_CONTESTS]);

/** How far methods that show the picture's pixels as squares are ahead of smooth ones in room low, dB, by truth. */
typedef struct {
    double nearest_db[STUDY_TRUTHS]; /**< none+nearest against none+cubic */
    double area_db[STUDY_TRUTHS];    /**< area against mean+cubic */
} gap_rewards_t;

/** @return STUDY_HOLDS when both gain by the picture's truth and lose by the original's, STUDY_FAILS when neither. */
study_verdict_t gap_rewards_verdict(const gap_rewards_t *rewards);

#endif
