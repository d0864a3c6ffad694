// SPDX-License-Identifier: Apache-2.0
// A study of experiments made for a test, in a scratch folder.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tests/support/study_bench.h"

bool study_bench_run(const scratch_t *scratch, const study_experiment_t *experiment, int experiments,
                     char error[FILE_ERROR_LENGTH])
{
    const study_options_t options = {scratch->folder, true, experiment, experiments};
    error[0] = '\0';
    return study_run(&options, error);
}

void study_bench_succeed(const scratch_t *scratch, study_experiment_fn *experiment)
{
    char error[FILE_ERROR_LENGTH];
    if (!study_bench_run(scratch, &(study_experiment_t){"it", experiment, 1, 1}, 1, error))
        fail_msg("%s", error);
}

char *study_bench_text(const scratch_t *scratch, const char *name)
{
    char path[SCRATCH_PATH_LENGTH];
    size_t length;
    scratch_path(scratch, name, path);
    uint8_t *bytes = scratch_read(path, &length);
    char *text = malloc(length + 1);
    memcpy(text, bytes, length);
    text[length] = '\0';
    free(bytes);
    return text;
}
