// SPDX-License-Identifier: Apache-2.0
// A study of experiments made for a test, in a scratch folder.
#ifndef TESTS_SUPPORT_STUDY_BENCH_H
#define TESTS_SUPPORT_STUDY_BENCH_H

#include "sim/study/study_run.h"
#include "tests/support/scratch.h"

/** study_run() with --quick into the folder. @param error  Empty on success. */
bool study_bench_run(const scratch_t *scratch, const study_experiment_t *experiment, int experiments,
                     char error[FILE_ERROR_LENGTH]);

/** The same for one experiment that must succeed: the test fails with its reason. */
void study_bench_succeed(const scratch_t *scratch, study_experiment_fn *experiment);

/** @return A whole file of the folder as text, for the caller to free. */
char *study_bench_text(const scratch_t *scratch, const char *name);

#endif
