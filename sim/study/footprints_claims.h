// SPDX-License-Identifier: Apache-2.0
// What the error by footprint must show for its claims to hold.
#ifndef SIM_STUDY_FOOTPRINTS_CLAIMS_H
#define SIM_STUDY_FOOTPRINTS_CLAIMS_H

#include "sim/study/study.h"
#include "sim/study/study_mesh.h"

/** The methods that the claims speak of: none, gauss, kaiser, butter with cubic, and mean+cubic. */
typedef enum {
    FOOTPRINTS_NONE,
    FOOTPRINTS_GAUSS,
    FOOTPRINTS_KAISER,
    FOOTPRINTS_BUTTER,
    FOOTPRINTS_MEAN,
    FOOTPRINTS_METHODS
} footprints_method_t;

/** Rms errors above the limit, gray levels, in the near part of the wall (magnified) and in the far one (minified). */
typedef struct {
    double near[FOOTPRINTS_METHODS], far[FOOTPRINTS_METHODS];
} footprints_parts_t;

/** Each holds when it does under both truths, and in part under one. */
typedef struct {
    study_verdict_t filters_blur_near; /**< every filter errs more than none, near */
    study_verdict_t none_aliases_far;  /**< none errs more than gauss and than the mean, far */
    study_verdict_t mean_is_best;      /**< the mean is as good as none near, to 2 %, and better than gauss far */
} footprints_verdicts_t;

footprints_verdicts_t footprints_verdicts(const footprints_parts_t parts[STUDY_TRUTHS]);

#endif
