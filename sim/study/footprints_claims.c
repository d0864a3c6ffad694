// SPDX-License-Identifier: Apache-2.0
// What the error by footprint must show for its claims to hold.
#include "sim/study/footprints_claims.h"

static const double as_good = 1.02;

footprints_verdicts_t footprints_verdicts(const footprints_parts_t parts[STUDY_TRUTHS])
{
    int blurred = 0, aliased = 0, best = 0;
    for (int truth = 0; truth < STUDY_TRUTHS; truth++) {
        const double *near = parts[truth].near, *far = parts[truth].far;
        blurred += near[FOOTPRINTS_GAUSS] > near[FOOTPRINTS_NONE] && near[FOOTPRINTS_KAISER] > near[FOOTPRINTS_NONE] &&
                   near[FOOTPRINTS_BUTTER] > near[FOOTPRINTS_NONE];
        aliased += far[FOOTPRINTS_NONE] > far[FOOTPRINTS_GAUSS] && far[FOOTPRINTS_NONE] > far[FOOTPRINTS_MEAN];
        best +=
            near[FOOTPRINTS_MEAN] <= as_good * near[FOOTPRINTS_NONE] && far[FOOTPRINTS_MEAN] < far[FOOTPRINTS_GAUSS];
    }
    return (footprints_verdicts_t){study_verdict(blurred, STUDY_TRUTHS), study_verdict(aliased, STUDY_TRUTHS),
                                   study_verdict(best, STUDY_TRUTHS)};
}
