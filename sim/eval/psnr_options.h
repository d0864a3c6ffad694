// SPDX-License-Identifier: Apache-2.0
// The command line of wallwarp-eval psnr.
#ifndef SIM_EVAL_PSNR_OPTIONS_H
#define SIM_EVAL_PSNR_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/eval/warp_once.h"

enum { PSNR_MAX_METHODS = 64 };

typedef struct {
    warp_once_place_t place; /**< its board is NULL for every wall */
    const char *picture, *original;
    int32_t factor;
    bool channels;
    const warp_method_t *method[PSNR_MAX_METHODS]; /**< NULL is the limit */
    int method_count;
} psnr_options_t;

/** @return The method's name, or "limit" for NULL. */
const char *psnr_method_name(const warp_method_t *method);

/** Read the command line; bad usage ends the program. The texts stay in argv. */
void psnr_options_parse(psnr_options_t *options, int argc, char **argv);

#endif
