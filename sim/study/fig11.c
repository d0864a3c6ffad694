// SPDX-License-Identifier: Apache-2.0
// The paper's fig 11: PSNR against angle, the picture coarser than the projector.
#include <math.h>
#include <stdlib.h>

#include "sim/study/study_experiments.h"
#include "sim/study/study_mesh_curves.h"
#include "sim/study/study_mesh_tally.h"

enum { PLACES = 3 };

static const double tolerance_db = 0.02;

static study_contest_t nearest_of(const char *nearest, const char *filter)
{
    return (study_contest_t){.contenders = study_methods(nearest),
                             .others = study_methods(filter) & ~study_methods(nearest),
                             .tolerance_db = tolerance_db};
}

static void say(study_t *study, const study_mesh_sweep_t *sweep)
{
    double largest_k = 0.0, lost_k = HUGE_VAL;
    const study_contest_t nearest_or_not = nearest_of("none+nearest", "none+*");
    for (int32_t n = 0; n < sweep->count; n++) {
        const double k = sweep->run[n].found.k_in;
        const study_tally_t tally = study_tally(&nearest_or_not, &sweep->run[n], 1);
        largest_k = fmax(largest_k, k);
        if (tally.wins < tally.cases)
            lost_k = fmin(lost_k, k);
    }
    study_text(study,
               "The largest k of these cases is %.4f. Up to k = 1 nothing needs to be filtered and all filters let the "
               "picture pass, so there their curves are the same.",
               largest_k);
    if (isfinite(lost_k))
        study_text(study,
                   "The smallest k at which nearest is not the best of the plain interpolators is %.4f: it is best as "
                   "long as projector pixels are clearly smaller than the picture's.",
                   lost_k);
    const study_duel_t nearest[] = {
        {"kaiser+nearest against its filter's best other interpolator", nearest_of("kaiser+nearest", "kaiser+*")},
        {"butter+nearest", nearest_of("butter+nearest", "butter+*")},
        {"gauss+nearest", nearest_of("gauss+nearest", "gauss+*")},
    };
    study_contest_claim(
        study,
        &(study_contest_claim_t){"paper, fig 11",
                                 "Nearest is best for all filters when the picture is coarser than the projector.",
                                 nearest, sizeof nearest / sizeof nearest[0]},
        sweep);
    const study_duel_t area = {
        "area against the best method of the paper",
        {.contenders = study_methods("area"), .others = study_methods_paper(), .tolerance_db = tolerance_db}};
    study_contest_claim(study,
                        &(study_contest_claim_t){"wallwarp",
                                                 "area beats nearest, and every other method of the paper, when the "
                                                 "picture is coarser than the projector.",
                                                 &area, 1},
                        sweep);
}

void study_fig11(study_t *study)
{
    static const study_sizes_t paper = {510, 290, 1920, 1080}, quarter = {128, 72, 480, 270};
    static const study_image_t image[PLACES] = {STUDY_ASTRONAUT, STUDY_COFFEE, STUDY_STUDIO};
    study_mesh_case_t place[PLACES];
    for (int p = 0; p < PLACES; p++)
        place[p] = (study_mesh_case_t){
            .sizes = study_quick(study) ? quarter : paper, .image = image[p], .finer = 1, .factor = 16};
    study_mesh_sweep_t sweep;
    if (!study_mesh_sweep(&sweep, study, place, PLACES, study_quick(study) ? 10.0 : 5.0))
        return;
    study_mesh_section(study, "Figure 11: picture coarser than the projector", &sweep);
    study_curves_by_filter(study, "fig11", &sweep);
    say(study, &sweep);
    free(sweep.run);
}
