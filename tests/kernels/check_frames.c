// SPDX-License-Identifier: Apache-2.0
// Whole frames by random homographies, every method in gray and colour.
#include <math.h>
#include <string.h>

#include "tests/kernels/check.h"
#include "warp_fixed/warp.h"

enum { SMALL = 90, LARGE = 320, SMALL_FRAMES = 12 * WARP_METHODS, LARGE_FRAMES = 2 * WARP_METHODS };

static warp_t warp;
static fenced_t source, panels[2];

/* From steep minification to magnification, turned, grazing, partly beside the picture. */
static void random_homography(homography_t *h, int32_t limit, rng_t *rng)
{
    const int32_t panel[2] = {(int32_t)rng_int(rng, limit / 3, limit), (int32_t)rng_int(rng, 1, limit)};
    const int32_t picture[2] = {(int32_t)rng_int(rng, 1, limit), (int32_t)rng_int(rng, limit / 3, limit)};
    const double q40 = 1099511627776.0, zoom = rng_double(rng, 0.05, 1) * (rng_int(rng, 0, 5) == 0 ? 60 : 2.5);
    const double turn = rng_double(rng, -3.2, 3.2), scale = picture[0] * zoom / panel[0];
    const double a = scale * cos(turn), b = scale * sin(turn);
    const double g = rng_double(rng, -0.9, 0.9) / panel[0], k = rng_double(rng, -0.9, 0.9) / panel[1];
    const double x = rng_double(rng, 0, 1) * picture[0], y = rng_double(rng, 0, 1) * picture[1];
    const double rows[3][3] = {{a, -b, x - a * panel[0] / 2 + b * panel[1] / 2},
                               {b, a, y - b * panel[0] / 2 - a * panel[1] / 2},
                               {g, k, 1 - g * panel[0] / 2 - k * panel[1] / 2}};
    int64_t rows_q40[3][3];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            rows_q40[r][c] = (int64_t)(rows[r][c] * q40);
    homography_from_indices(h, (const int64_t(*)[3])rows_q40, panel, picture);
}

static void check_frame(const warp_kernels_t *tested, int number, int32_t limit)
{
    static const uint8_t border[3] = {10, 20, 30};
    static outputs_t outputs;
    rng_t rng = {(uint64_t)number};
    const warp_method_t *method = &warp_methods[number % WARP_METHODS];
    const image_format_t format = number / WARP_METHODS % 2 ? IMAGE_GRAY8 : IMAGE_XRGB8888;
    homography_t h;
    random_homography(&h, limit, &rng);
    const int32_t channels = (int32_t)format;
    const size_t picture_bytes = (size_t)(h.picture_width * h.picture_height * channels);
    const size_t panel_bytes = (size_t)(h.panel_width * h.panel_height * channels);
    const image_t picture = {fenced_place(&source, picture_bytes, number % 2), h.picture_width, h.picture_height,
                             h.picture_width * channels, format};
    check_fill(picture.data, picture_bytes, number % 3 == 0 ? 3 : 4, &rng);
    check_case("frame, seed %d, limit %d, %s, %d channels", number, limit, method->name, channels);
    warp_init(&warp, *method, false, border);
    for (int i = 0; i < 2; i++) {
        const image_t panel = {fenced_place(&panels[i], panel_bytes, 0), h.panel_width, h.panel_height,
                               h.panel_width * channels, format};
        memset(panel.data, 0, panel_bytes);
        warp_frame(&warp, i == 0 ? &warp_kernels_scalar : tested, NULL, &h, &panel, &picture);
    }
    outputs_begin(&outputs, 0);
    outputs.size = panel_bytes;
    outputs.expected = fenced_place(&panels[0], panel_bytes, 0);
    outputs.found = fenced_place(&panels[1], panel_bytes, 0);
    outputs_compare(&outputs);
}

void check_frames(const warp_kernels_t *tested)
{
    source = fenced_new((size_t)LARGE * LARGE * 4);
    for (int i = 0; i < 2; i++)
        panels[i] = fenced_new((size_t)LARGE * LARGE * 4 + 4096);
    for (int n = 0; n < SMALL_FRAMES; n++)
        check_frame(tested, n, SMALL);
    for (int n = 0; n < LARGE_FRAMES; n++)
        check_frame(tested, n, LARGE);
}
