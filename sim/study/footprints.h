// SPDX-License-Identifier: Apache-2.0
// Where in the picture the gap to the limit comes from: squared error by the projector pixels' footprint area.
#ifndef SIM_STUDY_FOOTPRINTS_H
#define SIM_STUDY_FOOTPRINTS_H

#include "sim/study/study.h"

/** Measure, write footprints_TRUTH.csv and plots, and the section of the page. */
void study_footprints(study_t *study);

#endif
