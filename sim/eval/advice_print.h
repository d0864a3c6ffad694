// SPDX-License-Identifier: Apache-2.0
// What wallwarp-eval advise prints.
#ifndef SIM_EVAL_ADVICE_PRINT_H
#define SIM_EVAL_ADVICE_PRINT_H

#include <stdio.h>

#include "sim/eval/wall_advice.h"

void advice_print_csv_header(FILE *out);

/** A row per method of the build; '-' where a wall has no place to be seen from. */
void advice_print_csv(FILE *out, const wall_advice_t *advice);

/** A table to read, the methods closest to a finer original first, one line of advice, and what `auto` would do. */
void advice_print_table(FILE *out, const wall_advice_t *advice);

/** Lines "warning: board NAME: ..." about places that were left out, or see a mirrored picture. */
void advice_print_warnings(FILE *out, const wall_advice_t *advice);

#endif
