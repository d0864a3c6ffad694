// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval advise: which method suits each wall of a room.
#ifndef SIM_EVAL_EVAL_ADVISE_H
#define SIM_EVAL_EVAL_ADVISE_H

/** Run the command. @param argv  argv[0] begins error messages: "wallwarp-eval advise". @return The exit status. */
int eval_advise(int argc, char **argv);

#endif
