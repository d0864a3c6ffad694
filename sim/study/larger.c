// SPDX-License-Identifier: Apache-2.0
// The paper's third case: PSNR against angle, the picture finer than the projector.
#include "sim/study/larger.h"

#include <stdio.h>
#include <stdlib.h>

#include "sim/study/study_mesh_curves.h"
#include "sim/study/study_mesh_tally.h"

enum { PLACES = 3, WORDS_LENGTH = 160 };

/* The paper does not say what is fair: here, within this much of the best filtered method. */
static const double fair_db = 1.0;

static void say_fair(study_t *study, const study_mesh_sweep_t *sweep, const char *interpolator)
{
    char pattern[WORDS_LENGTH], who[WORDS_LENGTH], claim[WORDS_LENGTH];
    snprintf(pattern, sizeof pattern, "*+%s", interpolator);
    snprintf(who, sizeof who, "%s with its best filter against the best filtered method", interpolator);
    snprintf(claim, sizeof claim,
             "All interpolation schemes are fair when the picture is finer than the projector: %s within %g dB.",
             interpolator, fair_db);
    const study_contest_t contest = {.contenders = study_methods(pattern) & study_methods_filtered(),
                                     .others = study_methods_filtered(),
                                     .tolerance_db = fair_db};
    study_tally_claim(study, &(study_contest_words_t){.source = "paper, results", .claim = claim, .who = who}, &contest,
                      sweep->run, sweep->count);
}

static void say(study_t *study, const study_mesh_sweep_t *sweep)
{
    const study_contest_t limit = {.contenders = study_methods_filtered(), .others = STUDY_LIMIT};
    const study_contest_t area = {.contenders = study_methods("area"), .others = STUDY_LIMIT};
    const study_tally_t filtered = study_tally(&limit, sweep->run, sweep->count);
    const study_tally_t adaptive = study_tally(&area, sweep->run, sweep->count);
    study_text(study,
               "Among themselves the interpolators differ little here, because every one of them reads a picture that "
               "was filtered for the worst place of the wall. Against what is possible they are not so good: the best "
               "filtered method is %.2f dB below the limit on average and %.2f dB at worst, area %.2f and %.2f dB.",
               -filtered.mean_db, -filtered.worst_db, -adaptive.mean_db, -adaptive.worst_db);
    static const char *const interpolators[] = {"nearest", "linear", "cubic", "spline"};
    for (size_t i = 0; i < sizeof interpolators / sizeof interpolators[0]; i++)
        say_fair(study, sweep, interpolators[i]);
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
    char settings[STUDY_MESH_SETTINGS_LENGTH];
    study_mesh_settings(settings, &sweep);
    study_section(study, "Picture finer than the projector", settings);
    study_curves_by_filter(study, "larger", &sweep);
    say(study, &sweep);
    free(sweep.run);
}
