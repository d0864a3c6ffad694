// SPDX-License-Identifier: Apache-2.0
// Methods as points of a plane, sharpness across and flicker up: which are better in both.
#include "sim/study/flicker_points.h"

#include <stddef.h>
#include <string.h>

const double flicker_least_sharper = 0.002, flicker_least_steadier = 0.01;

bool flicker_in_family(const char *name)
{
    const warp_method_t *method = warp_method_from_name(name);
    return method != NULL && warp_averages(method->resampler);
}

bool flicker_beats(const flicker_point_t *a, const flicker_point_t *b)
{
    return a->sharpness > b->sharpness + flicker_least_sharper && a->flicker < b->flicker - flicker_least_steadier;
}

/* NULL means all of the family. */
static bool is_meant(const flicker_point_t *point, const char *member)
{
    return member == NULL ? flicker_in_family(point->name) : strcmp(point->name, member) == 0;
}

/* Of those meant, the steadiest; NULL when there is none. *all_beaten: the outsider is better than each. */
static const flicker_point_t *steadiest(const flicker_case_t *of, const char *member, const flicker_point_t *outsider,
                                        bool *all_beaten)
{
    const flicker_point_t *found = NULL;
    *all_beaten = true;
    for (int32_t n = 0; n < of->points; n++) {
        const flicker_point_t *point = &of->point[n];
        if (!is_meant(point, member))
            continue;
        if (found == NULL || point->flicker < found->flicker)
            found = point;
        *all_beaten = *all_beaten && flicker_beats(outsider, point);
    }
    return found;
}

flicker_defeats_t flicker_defeats(const flicker_case_t *cases, int32_t count, const char *member)
{
    flicker_defeats_t defeats = {0};
    for (int32_t c = 0; c < count; c++)
        for (int32_t n = 0; n < cases[c].points; n++) {
            const flicker_point_t *outsider = &cases[c].point[n];
            if (flicker_in_family(outsider->name))
                continue;
            bool beaten;
            const flicker_point_t *victim = steadiest(&cases[c], member, outsider, &beaten);
            if (victim == NULL)
                continue;
            defeats.pairs++;
            if (!beaten)
                continue;
            defeats.defeats++;
            if (defeats.worst != NULL &&
                victim->flicker - outsider->flicker <= defeats.victim->flicker - defeats.victor->flicker)
                continue;
            defeats.worst = &cases[c];
            defeats.victor = outsider;
            defeats.victim = victim;
        }
    return defeats;
}
