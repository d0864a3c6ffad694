// SPDX-License-Identifier: Apache-2.0
// Which methods the study measures, and sets of them by name.
#include "sim/study/study_methods.h"

#include <fnmatch.h>

bool study_measures(int method)
{
    return warp_methods[method].resampler != WARP_AUTO;
}

study_methods_t study_methods(const char *pattern)
{
    study_methods_t set = 0;
    for (int m = 0; m < WARP_METHODS; m++)
        if (study_measures(m) && fnmatch(pattern, warp_methods[m].name, 0) == 0)
            set |= (study_methods_t)1 << m;
    return set;
}

study_methods_t study_methods_family(void)
{
    study_methods_t set = 0;
    for (int m = 0; m < WARP_METHODS; m++)
        if (warp_averages(warp_methods[m].resampler))
            set |= (study_methods_t)1 << m;
    return set;
}

study_methods_t study_methods_paper(void)
{
    return study_methods("*") & ~study_methods_family();
}

study_methods_t study_methods_filtered(void)
{
    return study_methods_paper() & ~(study_methods("none+*") | study_methods("ls"));
}
