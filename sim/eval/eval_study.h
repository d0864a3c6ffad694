// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval study: the paper's figures again, and what lies beyond them, on one page.
#ifndef SIM_EVAL_EVAL_STUDY_H
#define SIM_EVAL_EVAL_STUDY_H

/** Run the command. @param argv  argv[0] is the command's full name. @return The exit status. */
int eval_study(int argc, char **argv);

#endif
