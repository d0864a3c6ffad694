// SPDX-License-Identifier: Apache-2.0
// Sets of methods, and how often and by how much one set beats another: what claims are judged by.
#include "sim/study/study_mesh_tally.h"

#include <fnmatch.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

study_methods_t study_methods(const char *pattern)
{
    study_methods_t set = 0;
    for (int m = 0; m < WARP_METHODS; m++)
        if (strcmp(warp_methods[m].name, "auto") != 0 && fnmatch(pattern, warp_methods[m].name, 0) == 0)
            set |= (study_methods_t)1 << m;
    return set;
}

study_methods_t study_methods_all(void)
{
    return study_methods("*");
}

study_methods_t study_methods_paper(void)
{
    return study_methods_all() & ~(study_methods("area") | study_methods("mean+*"));
}

study_methods_t study_methods_filtered(void)
{
    return study_methods("gauss+*") | study_methods("kaiser+*") | study_methods("butter+*");
}

double study_best_db(const study_mesh_result_t *found, study_truth_t truth, study_methods_t methods)
{
    double best = (methods & STUDY_LIMIT) != 0 ? found->limit_db[truth] : -HUGE_VAL;
    for (int m = 0; m < WARP_METHODS; m++)
        if ((methods >> m & 1) != 0)
            best = fmax(best, found->psnr_db[truth][m]);
    return best;
}

double study_db_ahead(double a, double b)
{
    return a == b ? 0.0 : a - b; /* not inf - inf */
}

study_tally_t study_tally(const study_contest_t *contest, const study_mesh_run_t *run, int32_t runs)
{
    study_tally_t tally = {.worst = -1};
    if (contest->contenders == 0 || contest->others == 0)
        return tally;
    double sum = 0.0;
    for (int32_t n = 0; n < runs; n++) {
        const double mine = study_best_db(&run[n].found, contest->truth, contest->contenders);
        const double theirs = study_best_db(&run[n].found, contest->truth, contest->others);
        const bool has_truth = contest->truth == STUDY_TRUTH_PICTURE || run[n].at.finer > 1;
        if (!has_truth || run[n].at.angle_deg < contest->from_angle_deg || (isinf(mine) && isinf(theirs)))
            continue;
        const double ahead = study_db_ahead(mine, theirs);
        if (tally.cases == 0 || ahead < tally.worst_db) {
            tally.worst_db = ahead;
            tally.worst = n;
        }
        tally.cases++;
        tally.wins += ahead >= -contest->tolerance_db;
        sum += ahead;
    }
    if (tally.cases > 0)
        tally.mean_db = sum / tally.cases;
    return tally;
}

study_verdict_t study_tally_verdict(const study_tally_t *tally)
{
    if (tally->wins == 0)
        return STUDY_FAILS;
    return tally->wins == tally->cases ? STUDY_HOLDS : STUDY_PARTLY;
}

study_tally_t study_tally_claim(study_t *study, const study_contest_words_t *words, const study_contest_t *contest,
                                const study_mesh_run_t *run, int32_t runs)
{
    const study_tally_t tally = study_tally(contest, run, runs);
    if (tally.cases == 0) {
        study_text(study, "%s: no case to judge.", words->who);
        return tally;
    }
    char tolerance[32] = "";
    if (contest->tolerance_db > 0)
        snprintf(tolerance, sizeof tolerance, " to %g dB", contest->tolerance_db);
    const study_mesh_case_t *worst = &run[tally.worst].at;
    study_claim(study, study_tally_verdict(&tally), words->source, words->claim,
                "%s: as good%s or better in %d of %d cases (pictures and angles), on average %+.2f dB, at worst "
                "%+.2f dB (%s %d x %d on %d x %d, %g degrees).",
                words->who, tolerance, tally.wins, tally.cases, tally.mean_db, tally.worst_db,
                study_image_name(worst->image), worst->sizes.picture_width, worst->sizes.picture_height,
                worst->sizes.panel_width, worst->sizes.panel_height, worst->angle_deg);
    return tally;
}
