// SPDX-License-Identifier: Apache-2.0
// The experiments of the study, in the order of its page: one line each.
#include "sim/study/study_experiments.h"

const study_experiment_t study_experiments[] = {
    /* name, function, seconds with --quick, seconds in full */
    {"fig 5", study_fig05, 1, 1},
    {"figs 8 and 9", study_fig08, 2, 60},
    {"fig 10", study_fig10, 3, 40},
    {"fig 11", study_fig11, 2, 35},
    {"larger", study_larger, 2, 10},
    {"gap", study_gap, 4, 70},
    {"footprints", study_footprints, 1, 2},
    {"moving viewer", study_flicker, 3, 64},
    {"uneven light", study_intensity, 3, 40},
    {"latency", study_latency, 3, 7},
    {"prediction", study_prediction, 2, 6},
    {0},
};
