// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval grid: where projector pixels fall in the picture, from the frame's own fixed-point grid.
#ifndef SIM_EVAL_EVAL_GRID_H
#define SIM_EVAL_EVAL_GRID_H

/** Run the command. @param argv  argv[0] is the command's full name. @return The exit status. */
int eval_grid(int argc, char **argv);

#endif
