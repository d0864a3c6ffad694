// SPDX-License-Identifier: Apache-2.0
// The paper's fig 10: PSNR against angle, the picture as fine as the projector.
#ifndef SIM_STUDY_FIG10_H
#define SIM_STUDY_FIG10_H

#include "sim/study/study.h"

/** Measure, write fig10_PICTURE.csv and plots, and the section of the page. */
void study_fig10(study_t *study);

#endif
