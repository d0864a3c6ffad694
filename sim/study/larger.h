// SPDX-License-Identifier: Apache-2.0
// The paper's third case: PSNR against angle, the picture finer than the projector.
#ifndef SIM_STUDY_LARGER_H
#define SIM_STUDY_LARGER_H

#include "sim/study/study.h"

/** Measure, write larger_PICTURE.csv and plots, and the section of the page. */
void study_larger(study_t *study);

#endif
