// SPDX-License-Identifier: Apache-2.0
// The experiments of the study, in the order of its page: one line each.
#include "sim/study/study_experiments.h"

const study_experiment_t study_experiments[] = {
    /* name, function, seconds with --quick, seconds in full */
    {"fig 5", study_fig05, 1, 1},
    {"figs 8 and 9", study_fig08, 2, 60},
    {0},
};
