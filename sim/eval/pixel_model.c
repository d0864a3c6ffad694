// SPDX-License-Identifier: Apache-2.0
// Beyond the paper's mesh: light that is uneven within a projector pixel, and a wall that does not reflect evenly.
#include "sim/eval/pixel_model.h"

#include <math.h>

/* Light from the panel's edge to x: 1 for each whole pixel. */
static double light_to(const pixel_profile_t *profile, double x)
{
    const double from_middle = (x - floor(x) - 0.5) / profile->fill; /* lit from -1/2 to 1/2 */
    const double in = fmin(fmax(from_middle, -0.5), 0.5);
    return floor(x) + 0.5 + in + profile->falloff * sin(2.0 * M_PI * in) / (2.0 * M_PI);
}

double pixel_profile_mean(const pixel_profile_t *profile, double from, double to)
{
    return (light_to(profile, to) - light_to(profile, from)) / (to - from);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double pixel_screen_gain(const pixel_screen_t *screen, const double point_m[3], const double normal[3],
                         const double eye_m[3])
{
    double to_projector[3], to_eye[3], mirrored[3];
    for (int i = 0; i < 3; i++) {
        to_projector[i] = screen->projector_m[i] - point_m[i];
        to_eye[i] = eye_m[i] - point_m[i];
    }
    const double along_normal = 2.0 * dot(to_projector, normal) / dot(normal, normal);
    for (int i = 0; i < 3; i++)
        mirrored[i] = along_normal * normal[i] - to_projector[i];
    const double cosine = dot(mirrored, to_eye) / sqrt(dot(mirrored, mirrored) * dot(to_eye, to_eye));
    return screen->diffuse + (cosine > 0.0 ? screen->lobe * pow(cosine, screen->exponent) : 0.0);
}
