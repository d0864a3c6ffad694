// SPDX-License-Identifier: Apache-2.0
// Lines of judgement, "ok" or "BAD", and how many were bad.
#ifndef SIM_POSE_BUS_JUDGE_H
#define SIM_POSE_BUS_JUDGE_H

#include <stdbool.h>
#include <stdio.h>

/** Where the judgement goes, and how many were bad. */
typedef struct {
    FILE *file;
    int bad;
} bus_judge_t;

/** Print a line, and count it when it is bad. */
void bus_judge_say(bus_judge_t *judge, bool good, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
