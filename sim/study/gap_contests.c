// SPDX-License-Identifier: Apache-2.0
// What must hold of the adaptive family in every room, at every angle, for every picture.
#include "sim/study/gap_contests.h"

void gap_contests(gap_contest_t contest[GAP_CONTESTS])
{
    contest[0] =
        (gap_contest_t){.name = "area_below_limit",
                        .words = {.source = "wallwarp",
                                  .claim = "Under the paper's truth area is at most 0.12 dB below what is possible.",
                                  .who = "area against the limit"},
                        .contest = {STUDY_TRUTH_PICTURE, study_methods("area"), STUDY_LIMIT, .tolerance_db = 0.12}};
    contest[1] = (gap_contest_t){
        .name = "area_below_paper",
        .words = {.source = "wallwarp",
                  .claim = "Under the paper's truth area is never more than 0.02 dB below any method of the paper.",
                  .who = "area against the best method of the paper"},
        .contest = {STUDY_TRUTH_PICTURE, study_methods("area"), study_methods_paper(), .tolerance_db = 0.02}};
    contest[2] = (gap_contest_t){
        .name = "mean_below_best",
        .words = {.source = "wallwarp",
                  .claim = "Against a finer original the better of mean+cubic and mean+spline is never more than 0.05 "
                           "dB below the best of all methods.",
                  .who = "the better of mean+cubic and mean+spline against the best of all other methods"},
        .contest = {STUDY_TRUTH_ORIGINAL, study_methods("mean+*"), study_methods_all() & ~study_methods("mean+*"),
                    .tolerance_db = 0.05}};
}
