// SPDX-License-Identifier: Apache-2.0
// What the programs of the simulator all say alike.
#include "sim/program.h"

#include <stdio.h>
#include <string.h>

#include "warp_fixed/method.h"

void program_warn(void *context, const char *line)
{
    (void)context;
    fprintf(stderr, "warning: %s\n", line);
}

void program_method_names(char names[PROGRAM_NAMES_LENGTH])
{
    names[0] = '\0';
    for (int m = 0; m < WARP_METHODS; m++) {
        const size_t used = strlen(names);
        snprintf(names + used, PROGRAM_NAMES_LENGTH - used, "%s%s", m == 0 ? "" : ", ", warp_methods[m].name);
    }
}

int program_finish(const char *command)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return PROGRAM_DONE;
    fprintf(stderr, "%s: stdout: cannot write the results\n", command);
    return PROGRAM_FAILED;
}
