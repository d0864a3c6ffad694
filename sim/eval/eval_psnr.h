// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval psnr: the paper's mesh evaluation of methods, as CSV.
#ifndef SIM_EVAL_EVAL_PSNR_H
#define SIM_EVAL_EVAL_PSNR_H

/** Run the command. @param argv  argv[0] is the command's full name. @return The exit status. */
int eval_psnr(int argc, char **argv);

#endif
