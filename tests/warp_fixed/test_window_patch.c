// SPDX-License-Identifier: Apache-2.0
// Patches anywhere about a picture: their loop must find every window's texels, and be called for whole steps only.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/rng.h"
#include "warp_fixed/window_patch_neon.h"
#include "warp_fixed/window_place.h"

enum { HASH_BYTES = 4, GUARD_BYTE = 0xa5, ONE = 1 << GRID_FRACTION_BITS };

static const int16_t no_weights[1];

/* What happened in a call of weigh_anywhere(). */
typedef struct {
    int32_t calls, pixels, in_place;
} tally_t;

/* A window whose loop writes a hash of what it reads, and checks how it is called. */
typedef struct {
    window_t window; /* first: the loop finds the rest by it */
    texels_t texels;
    patch_loop_t loop;
    tally_t *tally;
} bench_t;

static uint32_t hash_texel(uint32_t hash, const uint8_t *texel, int32_t bytes, uint8_t centre)
{
    for (int32_t i = 0; i < bytes; i++)
        hash = (hash ^ (uint8_t)(texel[i] ^ centre)) * 16777619u;
    return hash;
}

/* Where every other row begins a pair, a window has one row less than is read. */
static int32_t window_rows(const bench_t *bench)
{
    return bench->loop.taps_y - (bench->loop.pair_step == 2);
}

/*
 * The texel of column u and of a row of the window that begins at y. Of pairs, in which texels' bytes are every other
 * one, windows read two rows at a time, and their last one from beside the one above.
 */
static uint32_t hash_from_source(uint32_t hash, const bench_t *bench, const window_source_t *source,
                                 const int32_t at[2], int32_t row)
{
    const int32_t bytes = bench->texels.texel_bytes, step = bench->loop.pair_step, y = at[1] + row;
    uint8_t texel[8];
    if (step == 0)
        return hash_texel(hash, source->data + y * source->stride + at[0] * bytes, bytes, 0);
    assert_in_range(at[0], 0, 511);
    assert_in_range(y, 0, 511);
    const bool below = step == 1 ? row % 2 != 0 || row == bench->loop.taps_y - 1 : y % 2 != 0;
    const uint8_t *pair = source->data + (below ? y - 1 : y) / step * source->stride + 2 * at[0] * bytes + below;
    for (int32_t i = 0; i < bytes; i++)
        texel[i] = pair[2 * i];
    return hash_texel(hash, texel, bytes, 0);
}

static void hash_windows(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    const bench_t *bench = (const bench_t *)window;
    assert_true(patch->width > 0 && patch->width % bench->loop.step == 0 && patch->width <= PATCH_MAX_WIDTH);
    assert_true(patch->height > 0 && patch->height <= PATCH_MAX_HEIGHT);
    assert_true(!(bench->loop.centred || bench->loop.pair_step != 0) || source->stride == COPY_STRIDE);
    bench->tally->calls++;
    bench->tally->pixels += patch->width * patch->height;
    bench->tally->in_place += source->data == bench->texels.data;
    for (int32_t r = 0; r < patch->height; r++) {
        for (int32_t k = 0; k < patch->width; k++) {
            const int32_t x = (patch->x_q18[r * PATCH_MAX_WIDTH + k] + source->x_start_q18) >> GRID_FRACTION_BITS;
            const int32_t y = (patch->y_q18[r * PATCH_MAX_WIDTH + k] + source->y_start_q18) >> GRID_FRACTION_BITS;
            uint32_t hash = 0;
            for (int32_t v = 0; v < window_rows(bench); v++)
                for (int32_t u = x; u < x + bench->loop.taps_x; u++)
                    hash = hash_from_source(hash, bench, source, (const int32_t[2]){u, y}, v);
            memcpy(patch->out + r * patch->stride + k * HASH_BYTES, &hash, HASH_BYTES);
        }
    }
}

/* The same from the picture, as window_place.h and mirroring define it. */
static uint32_t expected_hash(const bench_t *bench, int32_t x_q18, int32_t y_q18)
{
    const texels_t *texels = &bench->texels;
    const int32_t bytes = texels->texel_bytes;
    const int32_t x = window_place(&bench->window.x, x_q18, texels->width, 0).begin;
    const int32_t y = window_place(&bench->window.y, y_q18, texels->height, 0).begin;
    uint32_t hash = 0;
    for (int32_t v = y; v < y + window_rows(bench); v++) {
        const uint8_t *row = texels->data + mirror_index(v, texels->height) * texels->stride;
        for (int32_t u = x; u < x + bench->loop.taps_x; u++)
            hash = hash_texel(hash, row + mirror_index(u, texels->width) * bytes, bytes, bench->loop.centred ? 128 : 0);
    }
    return hash;
}

/* A picture of random bytes in memory that ends with its last texel, and a loop of random kind. */
static bench_t new_bench(int32_t width, int32_t height, tally_t *tally, rng_t *rng)
{
    static const int32_t bytes_of[4] = {1, 2, 4, 8};
    const bool centred = rng_int(rng, 0, 1), paired = rng_int(rng, 0, 1);
    const int32_t bytes = bytes_of[rng_int(rng, 0, paired ? 1 : 3)],
                  stride = width * bytes + (int32_t)rng_int(rng, 0, 9);
    const size_t size = (size_t)(stride * (height - 1) + width * bytes);
    uint8_t *data = malloc(size);
    assert_non_null(data);
    for (size_t i = 0; i < size; i++)
        data[i] = (uint8_t)rng_next(rng);
    bench_t bench = {
        .texels = {data, width, height, stride, bytes},
        .loop = {.weigh = hash_windows,
                 .taps_x = (int32_t)rng_int(rng, 1, WINDOW_SHORT_TAPS),
                 .taps_y = (int32_t)rng_int(rng, paired ? 2 : 1, WINDOW_SHORT_TAPS),
                 .pixel_bytes = HASH_BYTES,
                 .step = rng_int(rng, 0, 1) ? PATCH_STEP : PATCH_MAX_STEP,
                 .centred = centred,
                 .pair_step = paired ? (int32_t)rng_int(rng, 1, centred ? 2 : 1) : 0},
        .tally = tally,
    };
    bench.window.x = (window_axis_t){.first = no_weights, .second = no_weights};
    bench.window.y = bench.window.x;
    bench.window.x.lead = PHASES - bench.loop.taps_x * PHASES / 2 + (int32_t)rng_int(rng, 0, PHASES / 2);
    bench.window.y.lead = PHASES - bench.loop.taps_y * PHASES / 2 + (int32_t)rng_int(rng, 0, PHASES / 2);
    return bench;
}

static void free_bench(const bench_t *bench)
{
    free((void *)(uintptr_t)bench->texels.data);
}

/* A patch about a point of the picture, so many picture pixels to one of its own, turned. */
typedef struct {
    int32_t width, height;
    double x, y, scale, turn;
} pose_of_patch_t;

/* @return What weigh_anywhere() made of it; all that it writes is checked. */
static tally_t check_patch(bench_t *bench, const pose_of_patch_t *pose)
{
    int32_t x[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH], y[PATCH_MAX_HEIGHT * PATCH_MAX_WIDTH];
    const ptrdiff_t stride = pose->width * HASH_BYTES + 3;
    const size_t size = (size_t)(stride * pose->height);
    uint8_t *found = malloc(size + 1), *expected = malloc(size + 1);
    assert_true(found != NULL && expected != NULL);
    memset(found, GUARD_BYTE, size);
    memset(expected, GUARD_BYTE, size);
    const double c = pose->scale * cos(pose->turn), s = pose->scale * sin(pose->turn);
    for (int32_t r = 0; r < pose->height; r++) {
        for (int32_t k = 0; k < pose->width; k++) {
            const double right = k - (pose->width - 1) / 2.0, down = r - (pose->height - 1) / 2.0;
            const int32_t at = r * PATCH_MAX_WIDTH + k;
            x[at] = (int32_t)floor((pose->x + c * right - s * down) * ONE);
            y[at] = (int32_t)floor((pose->y + s * right + c * down) * ONE);
            const uint32_t hash = expected_hash(bench, x[at], y[at]);
            memcpy(expected + r * stride + k * HASH_BYTES, &hash, HASH_BYTES);
        }
    }
    const patch_t patch = {found, stride, x, y, pose->width, pose->height};
    *bench->tally = (tally_t){0};
    weigh_anywhere(&patch, &bench->window, &bench->texels, &bench->loop);
    if (memcmp(found, expected, size) != 0)
        fail_msg("picture %d x %d of %d bytes a texel, patch %d x %d about (%.3f, %.3f), scale %.3f, turn %.3f, "
                 "taps %d x %d, step %d, centred %d, pair step %d",
                 bench->texels.width, bench->texels.height, bench->texels.texel_bytes, pose->width, pose->height,
                 pose->x, pose->y, pose->scale, pose->turn, bench->loop.taps_x, bench->loop.taps_y, bench->loop.step,
                 bench->loop.centred, bench->loop.pair_step);
    free(found);
    free(expected);
    return *bench->tally;
}

/* In the picture, across each edge and corner, and beyond them; shrunk, as it is, dense; upright and turned. */
static void patches_read_their_windows_anywhere(void **state)
{
    (void)state;
    static const int32_t pictures[][2] = {{200, 120}, {120, 200}, {9, 7}, {3, 1}, {1, 1}};
    static const int32_t sizes[][2] = {{64, 16}, {64, 1}, {37, 13}, {13, 16}, {7, 1}, {3, 5}, {2, 16}, {1, 1}};
    static const double across[] = {-0.4, 0, 0.5, 1, 1.4}, scales[] = {0, 0.4, 1, 9}, turns[] = {0, 0.6, 1.5708, 3};
    rng_t rng = {1};
    tally_t tally;
    for (int p = 0; p < 5; p++) {
        for (int s = 0; s < 8; s++) {
            for (int n = 0; n < 5 * 5 * 4; n++) {
                bench_t bench = new_bench(pictures[p][0], pictures[p][1], &tally, &rng);
                const pose_of_patch_t pose = {sizes[s][0],
                                              sizes[s][1],
                                              across[n % 5] * pictures[p][0],
                                              across[n / 5 % 5] * pictures[p][1],
                                              scales[n / 25],
                                              turns[rng_int(&rng, 0, 3)]};
                (void)check_patch(&bench, &pose);
                free_bench(&bench);
            }
        }
    }
}

/* Well within the picture, loops read it as it is, without a copy, and each pixel once; but for those of bytes less
 * 128, and of pairs. */
static void patches_inside_are_read_in_place(void **state)
{
    (void)state;
    tally_t tally;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        rng_t rng = {seed};
        bench_t bench = new_bench(200, 120, &tally, &rng);
        const tally_t found = check_patch(&bench, &(pose_of_patch_t){64, 16, 100, 60, 1, 0});
        assert_int_equal(found.calls, 1);
        assert_int_equal(found.pixels, 64 * 16);
        assert_int_equal(found.in_place, !bench.loop.centred && bench.loop.pair_step == 0);
        free_bench(&bench);
    }
}

/* What a copy of 72 rows of 832 bytes, or 416 pairs, cannot hold is read in halves, and their halves; the longer side
 * is cut. */
static void patches_that_read_more_than_a_copy_are_halved(void **state)
{
    (void)state;
    static const struct {
        pose_of_patch_t pose;
        int32_t texel_bytes, calls;
        bool paired;
    } cases[] = {
        {{64, 16, 300, 200, 1, 0}, 8, 1, false},      /* some 72 texels of 8 bytes */
        {{64, 16, 300, 200, 1.7, 0}, 8, 2, false},    /* more than 107 of them: 856 bytes */
        {{64, 16, 300, 200, 4, 0}, 4, 2, false},      /* more than 252 texels of 4 bytes */
        {{64, 16, 300, 200, 4, 1.5708}, 4, 4, false}, /* more than 252 rows */
        {{16, 16, 300, 200, 8, 0}, 1, 2, false},      /* more than 120 rows: a square is cut across */
        {{1, 1, 300, 200, 8, 0}, 8, 1, false},        /* one window */
        {{64, 8, 300, 200, 6, 0}, 1, 1, true},        /* some 387 pairs */
        {{64, 8, 300, 200, 7, 0}, 1, 2, true},        /* more than 441 pairs */
    };
    tally_t tally;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rng_t rng = {i};
        bench_t bench = new_bench(600, 400, &tally, &rng);
        while (bench.texels.texel_bytes != cases[i].texel_bytes || bench.loop.taps_x < 7 ||
               (bench.loop.pair_step != 0) != cases[i].paired || !(bench.loop.centred || cases[i].paired)) {
            free_bench(&bench);
            bench = new_bench(600, 400, &tally, &rng);
        }
        assert_int_equal(check_patch(&bench, &cases[i].pose).calls, cases[i].calls);
        free_bench(&bench);
    }
}

/* Rows of texels that just fill a copy's, and those that just do not; of pairs, in patches that have few rows. */
static void patches_that_fill_a_copy_are_right(void **state)
{
    (void)state;
    tally_t tally;
    rng_t rng = {1};
    for (int32_t n = 0; n < 400; n++) {
        bench_t bench = new_bench(420, 200, &tally, &rng);
        const double bytes = rng_double(&rng, 760, 860) / (bench.loop.pair_step != 0 ? 2 : 1);
        const pose_of_patch_t pose = {64,  bench.loop.pair_step != 0 ? 8 : 16,    210,
                                      100, bytes / bench.texels.texel_bytes / 64, 0};
        (void)check_patch(&bench, &pose);
        free_bench(&bench);
    }
}

static void no_pixels_are_nothing_to_do(void **state)
{
    (void)state;
    tally_t tally;
    rng_t rng = {1};
    bench_t bench = new_bench(20, 20, &tally, &rng);
    assert_int_equal(check_patch(&bench, &(pose_of_patch_t){0, 16, 10, 10, 1, 0}).calls, 0);
    assert_int_equal(check_patch(&bench, &(pose_of_patch_t){64, 0, 10, 10, 1, 0}).calls, 0);
    free_bench(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patches_read_their_windows_anywhere),
        cmocka_unit_test(patches_inside_are_read_in_place),
        cmocka_unit_test(patches_that_read_more_than_a_copy_are_halved),
        cmocka_unit_test(patches_that_fill_a_copy_are_right),
        cmocka_unit_test(no_pixels_are_nothing_to_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
