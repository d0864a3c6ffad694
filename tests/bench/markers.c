// SPDX-License-Identifier: Apache-2.0
// The two functions between whose calls count_plugin.c counts instructions.
#include "tests/bench/markers.h"

void bench_begin(void)
{
}

void bench_end(void)
{
}
