// SPDX-License-Identifier: Apache-2.0
// What wallwarp-eval advise prints.
#include "sim/eval/advice_print.h"

/* What nobody sees: a cheaper method within this of the best is named too. */
static const double unseen_db = 0.1;

void advice_print_csv_header(FILE *out)
{
    fputs("board,method,k_min,k_median,k_max,gap_db,gap_original_db,cost\n", out);
}

void advice_print_csv(FILE *out, const wall_advice_t *advice)
{
    for (int m = 0; m < WARP_METHODS; m++) {
        fprintf(out, "%s,%s", advice->board->name, warp_methods[m].name);
        if (advice->places == 0) {
            fputs(",-,-,-,-,-,-\n", out);
            continue;
        }
        fprintf(out, ",%.4f,%.4f,%.4f,%.3f,%.3f,%.1f\n", advice->k[ADVICE_LEAST_K], advice->k[ADVICE_MEDIAN_K],
                advice->k[ADVICE_LARGEST_K], advice->gap_db[m], advice->gap_original_db[m], advice->cost[m]);
    }
}

/* By each pixel's own footprint, so that it stays good where the viewer was not expected. */
static bool adapts(int32_t method)
{
    return warp_averages(warp_methods[method].resampler) || warp_methods[method].resampler == WARP_AUTO;
}

/*
 * Closest to a finer original first; of equal ones those that adapt, then the cheaper, and last auto, whose choice is
 * then always the other.
 */
static bool is_before(const wall_advice_t *advice, int32_t m, int32_t other)
{
    if (advice->gap_original_db[m] != advice->gap_original_db[other])
        return advice->gap_original_db[m] < advice->gap_original_db[other];
    if (adapts(m) != adapts(other))
        return adapts(m);
    if (advice->cost[m] != advice->cost[other])
        return advice->cost[m] < advice->cost[other];
    return warp_methods[other].resampler == WARP_AUTO;
}

static void rank(const wall_advice_t *advice, int32_t order[WARP_METHODS])
{
    for (int32_t m = 0; m < WARP_METHODS; m++) {
        int32_t at = m;
        for (; at > 0 && is_before(advice, m, order[at - 1]); at--)
            order[at] = order[at - 1];
        order[at] = m;
    }
}

static void print_advice(FILE *out, const wall_advice_t *advice, const int32_t order[WARP_METHODS])
{
    const int32_t best = order[0];
    int32_t cheap = best;
    for (int32_t i = 0; i < WARP_METHODS; i++)
        if (advice->gap_original_db[order[i]] <= advice->gap_original_db[best] + unseen_db &&
            advice->cost[order[i]] < advice->cost[cheap])
            cheap = order[i];
    fprintf(out, "  advice: method: %s", warp_methods[best].name);
    fputs(advice->board->method == &warp_methods[best] ? ", as it is" : "", out);
    if (cheap != best)
        fprintf(out, "; %s is within %.1f dB of it at %.0f %% of its cost", warp_methods[cheap].name, unseen_db,
                100.0 * advice->cost[cheap] / advice->cost[best]);
    fprintf(out, "\n  auto: %s at the least k, %s at the median, %s at the largest\n",
            wall_advice_auto(advice->k[ADVICE_LEAST_K])->name, wall_advice_auto(advice->k[ADVICE_MEDIAN_K])->name,
            wall_advice_auto(advice->k[ADVICE_LARGEST_K])->name);
}

void advice_print_table(FILE *out, const wall_advice_t *advice)
{
    fprintf(out, "\n%s: ", advice->board->name);
    if (advice->places == 0) {
        fputs("not seen from anywhere\n", out);
        return;
    }
    fprintf(out, "k %.2f to %.2f, median %.2f; method: %s\n", advice->k[ADVICE_LEAST_K], advice->k[ADVICE_LARGEST_K],
            advice->k[ADVICE_MEDIAN_K], advice->board->method->name);
    fprintf(out, "  %-16s %20s %20s %8s\n", "dB below the limit", "finer original", "picture's own pixels", "cost");
    int32_t order[WARP_METHODS];
    rank(advice, order);
    for (int32_t i = 0; i < WARP_METHODS; i++) {
        const int32_t m = order[i];
        fprintf(out, "  %-18s %18.2f %20.2f %8.1f\n", warp_methods[m].name, advice->gap_original_db[m],
                advice->gap_db[m], advice->cost[m]);
    }
    print_advice(out, advice, order);
}

void advice_print_warnings(FILE *out, const wall_advice_t *advice)
{
    const char *name = advice->board->name;
    const int32_t all = advice->places + advice->too_near + advice->unseen;
    if (advice->too_near > 0)
        fprintf(out, "warning: board %s: %d of %d places are nearer than 0.3 m to the wall's plane: left out\n", name,
                advice->too_near, all);
    if (advice->unseen > 0)
        fprintf(out, "warning: board %s: %d of %d places do not see it in the picture: left out\n", name,
                advice->unseen, all);
    if (advice->from_behind > 0)
        fprintf(out, "warning: board %s: %d of %d places see it from behind, mirrored: rear projection?\n", name,
                advice->from_behind, all);
    if (advice->places == 0)
        fprintf(out, "warning: board %s: out of view from everywhere in the walking area\n", name);
}
