// SPDX-License-Identifier: Apache-2.0
// Which methods the study measures, and sets of them by name.
#ifndef SIM_STUDY_STUDY_METHODS_H
#define SIM_STUDY_STUDY_METHODS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/method.h"

/** @return true for every method of warp_methods[] but "auto", which is one of the others at each pose. */
bool study_measures(int method);

/** Bit m is method m of warp_methods[]. */
typedef uint64_t study_methods_t;

/** In a set, beside methods: what no method can beat. */
static const study_methods_t STUDY_LIMIT = (study_methods_t)1 << 63;
_Static_assert(WARP_METHODS < 63, "the last bit is the limit's");

/** Measured methods whose name matches a shell pattern: "kaiser+*", "ls", "*+nearest"; maybe none. */
study_methods_t study_methods(const char *pattern);

/** The adaptive family: those that average over footprints. */
study_methods_t study_methods_family(void);

/** Those of the paper: a filter, or none, with an interpolator; and ls. */
study_methods_t study_methods_paper(void);

/** Those of the paper that it compares: with a filter, but without ls. */
study_methods_t study_methods_filtered(void);

#endif
