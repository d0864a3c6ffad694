// SPDX-License-Identifier: Apache-2.0
// The points of a block, for any quadratic.
#include "tests/kernels/check.h"

void check_grid_points(const warp_kernels_t *tested)
{
    static outputs_t x, y;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        rng_t rng = {seed};
        for (int32_t count = 0; count <= GRID_MAX_SPAN; count++) {
            const grid_quadratic_t block = {(int32_t)rng_next(&rng), (int32_t)rng_next(&rng), (int32_t)rng_next(&rng),
                                            (int32_t)rng_next(&rng), (int32_t)rng_next(&rng), (int32_t)rng_next(&rng)};
            check_case("grid_points, seed %d, count %d", (int)seed, count);
            outputs_begin(&x, (size_t)count * sizeof(int32_t));
            outputs_begin(&y, (size_t)count * sizeof(int32_t));
            warp_kernels_scalar.grid_points(x.expected, y.expected, &block, count);
            tested->grid_points(x.found, y.found, &block, count);
            outputs_compare(&x);
            outputs_compare(&y);
        }
    }
}
