// SPDX-License-Identifier: Apache-2.0
// Lines of judgement, "ok" or "BAD", and how many were bad.
#include "sim/pose/bus_judge.h"

#include <stdarg.h>

void bus_judge_say(bus_judge_t *judge, bool good, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    fputs(good ? "ok   " : "BAD  ", judge->file);
    vfprintf(judge->file, format, values);
    fputc('\n', judge->file);
    va_end(values);
    judge->bad += good ? 0 : 1;
}
