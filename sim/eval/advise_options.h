// SPDX-License-Identifier: Apache-2.0
// The command line of wallwarp-eval advise.
#ifndef SIM_EVAL_ADVISE_OPTIONS_H
#define SIM_EVAL_ADVISE_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/eval/walk_area.h"

enum { ADVISE_MAX_AREAS = 16 };

typedef struct {
    const char *room;
    walk_area_t area[ADVISE_MAX_AREAS];
    int32_t areas;    /**< 0: walk_area() of the room */
    double height_mm; /**< of the eye above the lowest corner */
    walk_up_t up;     /**< sign 0: walk_up() of the room */
    bool csv;
} advise_options_t;

/** Read the command line; bad usage ends the program. The texts stay in argv. */
void advise_options_parse(advise_options_t *options, int argc, char **argv);

#endif
