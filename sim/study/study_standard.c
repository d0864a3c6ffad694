// SPDX-License-Identifier: Apache-2.0
// The standard piece of work, which tells how fast this machine is: what most experiments spend their time on.
#include "sim/devices/sim_clock.h"
#include "sim/study/study_internal.h"
#include "sim/study/study_mesh.h"

enum { TASKS = 16 };

static void sample_and_warp(void *context, int32_t index)
{
    const study_mesh_case_t at = {{480, 270, 480, 270}, STUDY_NOISE, 1, 4, 3 * index};
    study_mesh_t mesh;
    char error[FILE_ERROR_LENGTH];
    if (!study_mesh_open(&mesh, &at, error)) {
        study_fail(context, "%s", error);
        return;
    }
    study_mesh_warp(&mesh, (int)(warp_method_default() - warp_methods));
    study_mesh_close(&mesh);
}

double study_standard_work(study_t *study)
{
    const int64_t began_us = sim_clock_monotonic_us();
    study_parallel(study, TASKS, sample_and_warp, study);
    return (double)(sim_clock_monotonic_us() - began_us) / 1e6;
}
