// SPDX-License-Identifier: Apache-2.0
// The paper's fig 10: PSNR against angle, the picture as fine as the projector.
#include "sim/study/fig10.h"

#include <stdlib.h>

#include "sim/study/study_mesh_curves.h"
#include "sim/study/study_mesh_tally.h"

enum { PLACES = 3, STRONG_DEG = 50 };

static void say(study_t *study, const study_mesh_sweep_t *sweep)
{
    const study_contest_t splines = {.contenders = study_methods("ls"), .others = study_methods_filtered()};
    study_tally_claim(
        study,
        &(study_contest_words_t){
            .source = "paper, fig 10",
            .claim = "Least-squares splines give the best results when picture and projector are equally fine.",
            .who = "ls against the best filtered method"},
        &splines, sweep->run, sweep->count);
    const study_contest_t prefilter = {
        .contenders = study_methods_filtered(), .others = study_methods("none+*"), .from_angle_deg = STRONG_DEG};
    study_tally_claim(study,
                      &(study_contest_words_t){.source = "paper, anti-aliasing",
                                               .claim = "At strong angles a low-pass filter before resampling helps.",
                                               .who = "the best filtered method against the best unfiltered one, from "
                                                      "50 degrees on"},
                      &prefilter, sweep->run, sweep->count);
    const study_contest_t area = {
        .contenders = study_methods("area"), .others = study_methods_paper(), .tolerance_db = 0.02};
    study_tally_claim(study,
                      &(study_contest_words_t){.source = "wallwarp",
                                               .claim = "area beats every method of the paper in its own evaluation.",
                                               .who = "area against the best method of the paper, ls included"},
                      &area, sweep->run, sweep->count);
}

void study_fig10(study_t *study)
{
    static const study_sizes_t paper = {1920, 1080, 1920, 1080}, small = {480, 270, 480, 270};
    const study_mesh_case_t place[PLACES] = {
        {.sizes = study_quick(study) ? small : paper, .image = STUDY_STUDIO, .finer = 1, .factor = 4},
        {.sizes = small, .image = STUDY_ASTRONAUT, .finer = 1, .factor = 4},
        {.sizes = small, .image = STUDY_COFFEE, .finer = 1, .factor = 4},
    };
    study_mesh_sweep_t sweep;
    if (!study_mesh_sweep(&sweep, study, place, PLACES, study_quick(study) ? 10.0 : 2.5))
        return;
    char settings[STUDY_MESH_SETTINGS_LENGTH];
    study_mesh_settings(settings, &sweep);
    study_section(study, "Fig 10: picture as fine as the projector", settings);
    study_curves_by_filter(study, "fig10", &sweep);
    say(study, &sweep);
    free(sweep.run);
}
