// SPDX-License-Identifier: Apache-2.0
// The command line of wallwarp-sim run.
#ifndef SIM_RUN_RUN_OPTIONS_H
#define SIM_RUN_RUN_OPTIONS_H

#include "sim/run/sim_run.h"

/** Read the command line; bad usage ends the program. The texts stay in argv. */
void run_options_parse(sim_run_options_t *options, int argc, char **argv);

#endif
