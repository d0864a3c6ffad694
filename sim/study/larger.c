// SPDX-License-Identifier: Apache-2.0
// The paper's third case: PSNR against angle, the picture finer than the projector.
#include <stdlib.h>

#include "sim/study/study_experiments.h"
#include "sim/study/study_mesh_curves.h"
#include "sim/study/study_mesh_tally.h"

enum { PLACES = 3 };

/* The paper does not say what is fair: here, within this much of the best filtered method. */
static const double fair_db = 1.0;

static study_contest_t fair(const char *interpolator)
{
    return (study_contest_t){.contenders = study_methods(interpolator) & study_methods_filtered(),
                             .others = study_methods_filtered(),
                             .tolerance_db = fair_db};
}

static void say(study_t *study, const study_mesh_sweep_t *sweep)
{
    const study_contest_t limit = {.contenders = study_methods_filtered(), .others = STUDY_LIMIT};
    const study_contest_t area = {.contenders = study_methods("area"), .others = STUDY_LIMIT};
    const study_tally_t filtered = study_tally(&limit, sweep->run, sweep->count);
    const study_tally_t adaptive = study_tally(&area, sweep->run, sweep->count);
    study_text(study,
               "What is fair among the paper's methods is not yet good: the best filtered method is %.2f dB below the "
               "limit on average and %.2f dB at worst, area %.2f and %.2f dB.",
               -filtered.mean_db, -filtered.worst_db, -adaptive.mean_db, -adaptive.worst_db);
    const study_duel_t duel[] = {
        {"nearest with its best filter against the best filtered method", fair("*+nearest")},
        {"linear", fair("*+linear")},
        {"cubic", fair("*+cubic")},
        {"spline", fair("*+spline")},
    };
    study_contest_claim(
        study,
        &(study_contest_claim_t){"paper, results",
                                 "All interpolation schemes show fair results when the picture is finer than the "
                                 "projector (here: within 1 dB of the best filtered method).",
                                 duel, sizeof duel / sizeof duel[0]},
        sweep);
}

void study_larger(study_t *study)
{
    static const study_sizes_t paper = {1920, 1080, 960, 540}, small = {480, 270, 240, 135};
    const study_mesh_case_t place[PLACES] = {
        {.sizes = study_quick(study) ? small : paper, .image = STUDY_STUDIO, .finer = 1, .factor = 4},
        {.sizes = small, .image = STUDY_ASTRONAUT, .finer = 1, .factor = 4},
        {.sizes = small, .image = STUDY_COFFEE, .finer = 1, .factor = 4},
    };
    study_mesh_sweep_t sweep;
    if (!study_mesh_sweep(&sweep, study, place, PLACES, study_quick(study) ? 10.0 : 5.0))
        return;
    study_mesh_section(study, "Picture finer than the projector", &sweep);
    study_curves_by_filter(study, "larger", &sweep);
    say(study, &sweep);
    free(sweep.run);
}
