// SPDX-License-Identifier: Apache-2.0
// How often and by how much one set of methods beats another: what claims are judged by.
#include "sim/study/study_mesh_tally.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SENTENCE_LENGTH = 320, MAX_SENTENCES = 8 };

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
    int32_t finite = 0;
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
        finite += isfinite(ahead) != 0;
        sum += isfinite(ahead) ? ahead : 0.0;
    }
    if (finite > 0)
        tally.mean_db = sum / finite;
    return tally;
}

study_verdict_t study_contest_verdict(const study_contest_claim_t *claim, const study_mesh_run_t *run, int32_t runs)
{
    int32_t cases = 0, wins = 0;
    for (int d = 0; d < claim->duels; d++) {
        const study_tally_t tally = study_tally(&claim->duel[d].contest, run, runs);
        cases += tally.cases;
        wins += tally.wins;
    }
    return study_verdict(wins, cases);
}

/* How a contest ended, or nothing when it had no case. */
static void say_tally(char text[SENTENCE_LENGTH], const study_duel_t *duel, const study_mesh_run_t *run, int32_t runs)
{
    const study_tally_t tally = study_tally(&duel->contest, run, runs);
    text[0] = '\0';
    if (tally.cases == 0)
        return;
    char tolerance[32] = "";
    if (duel->contest.tolerance_db > 0)
        snprintf(tolerance, sizeof tolerance, " to %g dB", duel->contest.tolerance_db);
    const study_mesh_case_t *worst = &run[tally.worst].at;
    snprintf(text, SENTENCE_LENGTH,
             "%s: as good%s or better in %d of %d cases, on average %+.3f dB, at worst %+.3f dB (%s %d x %d on %d x "
             "%d, %g degrees). ",
             duel->who, tolerance, tally.wins, tally.cases, tally.mean_db, tally.worst_db,
             study_image_name(worst->image), worst->sizes.picture_width, worst->sizes.picture_height,
             worst->sizes.panel_width, worst->sizes.panel_height, worst->angle_deg);
}

void study_contest_claim(study_t *study, const study_contest_claim_t *claim, const study_mesh_sweep_t *sweep)
{
    char text[MAX_SENTENCES * SENTENCE_LENGTH] = "";
    for (int d = 0; d < claim->duels && d < MAX_SENTENCES; d++)
        say_tally(text + strlen(text), &claim->duel[d], sweep->run, sweep->count);
    if (text[0] == '\0')
        study_text(study, "%s There is no case to judge it by.", claim->claim);
    else
        study_claim(study, study_contest_verdict(claim, sweep->run, sweep->count), claim->source, claim->claim, "%s",
                    text);
}
