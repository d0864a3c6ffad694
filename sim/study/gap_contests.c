// SPDX-License-Identifier: Apache-2.0
// What must hold of the adaptive family in every room, at every angle, for every picture.
#include "sim/study/gap_contests.h"

void gap_contests(gap_contest_t contest[GAP_CONTESTS])
{
    const study_methods_t area = study_methods("area"), means = study_methods("mean+*");
    contest[0] = (gap_contest_t){
        "area_below_limit",
        "Under the paper's truth, for a viewer who goes round the wall's vertical axis as in its figures, "
        "area is at most 0.12 dB below what is possible.",
        {"area against the limit", {STUDY_TRUTH_PICTURE, area, STUDY_LIMIT, .tolerance_db = 0.12}}};
    contest[1] =
        (gap_contest_t){"area_below_paper",
                        "Under the paper's truth area is never more than 0.02 dB below any method of the paper.",
                        {"area against the best method of the paper",
                         {STUDY_TRUTH_PICTURE, area, study_methods_paper(), .tolerance_db = 0.02}}};
    contest[2] = (gap_contest_t){
        "mean_below_best",
        "Against a finer original the better of mean+cubic and mean+spline is never more than 0.05 dB below the best "
        "of all methods.",
        {"the better of the two against the best other method",
         {STUDY_TRUTH_ORIGINAL, means, study_methods("*") & ~means, .tolerance_db = 0.05}}};
}

static bool rewarded(const double ahead_db[STUDY_TRUTHS])
{
    return ahead_db[STUDY_TRUTH_PICTURE] > 0 && ahead_db[STUDY_TRUTH_ORIGINAL] < 0;
}

study_verdict_t gap_rewards_verdict(const gap_rewards_t *rewards)
{
    return study_verdict(rewarded(rewards->nearest_db) + rewarded(rewards->area_db), 2);
}
