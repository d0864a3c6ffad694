// SPDX-License-Identifier: Apache-2.0
// The two functions between whose calls count_plugin.c counts instructions.
#ifndef TESTS_BENCH_MARKERS_H
#define TESTS_BENCH_MARKERS_H

/* They do nothing, in a file of their own: no compiler may move work across the calls, or leave these out. */
void bench_begin(void);
void bench_end(void);

#endif
