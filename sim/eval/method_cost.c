// SPDX-License-Identifier: Apache-2.0
// A simple model of what a method costs: how many numbers it multiplies, from its definition.
#include "sim/eval/method_cost.h"

#include <math.h>
#include <string.h>

/* Both axes of a symmetric filter. */
static double taps_of(double half_length)
{
    return 2.0 * (2.0 * ceil(half_length) + 1.0);
}

/* Taps per picture pixel of a method's first half, "gauss" of "gauss+cubic"; NAN for another word. */
static double filter_taps(const char *name, size_t length, double k)
{
    static const struct {
        char name[8];
        double half_length; /* for k = 1 */
    } filters[] = {{"none", 0.0}, {"gauss", 1.0600415}, {"kaiser", 6.0}, {"butter", 8.0}};
    for (size_t f = 0; f < sizeof filters / sizeof *filters; f++)
        if (strlen(filters[f].name) == length && memcmp(filters[f].name, name, length) == 0)
            return k <= 1.0 || f == 0 ? 0.0 : taps_of(filters[f].half_length * k);
    return (double)NAN;
}

static double interpolator_texels(const char *name)
{
    static const struct {
        char name[8];
        double texels;
    } interpolators[] = {{"nearest", 1.0}, {"linear", 4.0}, {"cubic", 16.0}, {"spline", 16.0}};
    for (size_t i = 0; i < sizeof interpolators / sizeof *interpolators; i++)
        if (strcmp(interpolators[i].name, name) == 0)
            return interpolators[i].texels;
    return (double)NAN;
}

static const double spline_taps = 4.0;

static double square(double value)
{
    return value * value;
}

double method_cost(const char *name, const method_cost_place_t *place)
{
    const double k = fmax(place->k, 1.0), s = place->side_px;
    const double mean_texels = square(sqrt(fmax(s * s - 1.0, 0.0)) + 4.0);
    if (strcmp(name, "area") == 0)
        return square(s + 1.0);
    if (strcmp(name, "mean+cubic") == 0)
        return mean_texels;
    if (strcmp(name, "mean+spline") == 0)
        return mean_texels + spline_taps * place->picture_per_panel;
    if (strcmp(name, "ls") == 0)
        return 16.0 + 2.0 * (16.0 + 4.0 / k) * place->picture_per_panel;
    const char *plus = strchr(name, '+');
    if (plus == NULL)
        return (double)NAN;
    const double recursion = strcmp(plus, "+spline") == 0 ? spline_taps : 0.0;
    return interpolator_texels(plus + 1) +
           (filter_taps(name, (size_t)(plus - name), k) + recursion) * place->picture_per_panel;
}
