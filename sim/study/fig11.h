// SPDX-License-Identifier: Apache-2.0
// The paper's fig 11: PSNR against angle, the picture coarser than the projector.
#ifndef SIM_STUDY_FIG11_H
#define SIM_STUDY_FIG11_H

#include "sim/study/study.h"

/** Measure, write fig11_PICTURE.csv and plots, and the section of the page. */
void study_fig11(study_t *study);

#endif
