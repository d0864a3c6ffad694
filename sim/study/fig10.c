// SPDX-License-Identifier: Apache-2.0
// The paper's fig 10: PSNR against angle, the picture as fine as the projector.
#include <math.h>
#include <stdlib.h>

#include "sim/study/study_experiments.h"
#include "sim/study/study_mesh_curves.h"
#include "sim/study/study_mesh_tally.h"

enum { PHOTOGRAPHS = 3, PLACES = 4, STRONG_DEG = 50 };

static study_contest_t filtered_or_not(const char *filtered, const char *plain)
{
    return (study_contest_t){.contenders = study_methods(filtered) & study_methods_filtered(),
                             .others = study_methods(plain),
                             .from_angle_deg = STRONG_DEG};
}

static void say_prefilter(study_t *study, const study_mesh_sweep_t *photographs, const study_mesh_sweep_t *noise)
{
    const study_duel_t duel[] = {
        {"nearest with its best filter against none+nearest, from 50 degrees on",
         filtered_or_not("*+nearest", "none+nearest")},
        {"linear", filtered_or_not("*+linear", "none+linear")},
        {"cubic", filtered_or_not("*+cubic", "none+cubic")},
        {"spline", filtered_or_not("*+spline", "none+spline")},
    };
    study_contest_claim(study,
                        &(study_contest_claim_t){"paper, anti-aliasing",
                                                 "At strong angles a low-pass filter before resampling helps.", duel,
                                                 sizeof duel / sizeof duel[0]},
                        photographs);
    const study_tally_t nearest = study_tally(&duel[0].contest, noise->run, noise->count);
    const study_tally_t cubic = study_tally(&duel[2].contest, noise->run, noise->count);
    study_text(study,
               "k is that of the worst place of the wall: at 60 degrees most of the picture needs no filter and is "
               "blurred all the same, which costs photographs more than aliasing does. White noise, all detail, is the "
               "other end: there the best filter changes nearest by %+.2f dB and cubic by %+.2f dB on average.",
               nearest.mean_db, cubic.mean_db);
}

static void say(study_t *study, const study_mesh_sweep_t *photographs)
{
    const study_duel_t splines = {"ls against the best filtered method",
                                  {.contenders = study_methods("ls"), .others = study_methods_filtered()}};
    study_contest_claim(study,
                        &(study_contest_claim_t){
                            "paper, fig 10",
                            "Least-squares splines give the best results when picture and projector are equally fine.",
                            &splines, 1},
                        photographs);
    const study_tally_t tally = study_tally(&splines.contest, photographs->run, photographs->count);
    study_headline(study,
                   "The paper's winner, the least-squares spline, is as good as the best filtered method in %d of %d "
                   "cases with a picture as fine as the projector, and on average %.2f dB %s it.",
                   tally.wins, tally.cases, fabs(tally.mean_db), tally.mean_db < 0 ? "below" : "above");
    study_text(study,
               "ls has one knot spacing for the whole wall, the k of its worst place, so it smooths the near part "
               "as the filters do. Just above k = 1, where the fit would be nearly singular, its spacing is 1.25, "
               "and so it falls off at once as the wall turns.");
    const study_duel_t area = {
        "area against the best method of the paper, ls and unfiltered ones included",
        {.contenders = study_methods("area"), .others = study_methods_paper(), .tolerance_db = 0.02}};
    study_contest_claim(study,
                        &(study_contest_claim_t){"wallwarp",
                                                 "area beats every method of the paper in the paper's own evaluation.",
                                                 &area, 1},
                        photographs);
}

void study_fig10(study_t *study)
{
    static const study_sizes_t paper = {1920, 1080, 1920, 1080}, small = {480, 270, 480, 270};
    const study_mesh_case_t place[PLACES] = {
        {.sizes = study_quick(study) ? small : paper, .image = STUDY_STUDIO, .finer = 1, .factor = 4},
        {.sizes = small, .image = STUDY_ASTRONAUT, .finer = 1, .factor = 4},
        {.sizes = small, .image = STUDY_COFFEE, .finer = 1, .factor = 4},
        {.sizes = small, .image = STUDY_NOISE, .finer = 1, .factor = 4},
    };
    study_mesh_sweep_t sweep;
    if (!study_mesh_sweep(&sweep, study, place, PLACES, study_quick(study) ? 10.0 : 2.5))
        return;
    study_mesh_section(study, "Figure 10: picture as fine as the projector", &sweep);
    study_curves_by_filter(study, "fig10", &sweep);
    const study_mesh_sweep_t photographs = study_mesh_places(&sweep, 0, PHOTOGRAPHS);
    const study_mesh_sweep_t noise = study_mesh_places(&sweep, PHOTOGRAPHS, 1);
    say(study, &photographs);
    say_prefilter(study, &photographs, &noise);
    free(sweep.run);
}
