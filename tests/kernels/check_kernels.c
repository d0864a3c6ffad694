// SPDX-License-Identifier: Apache-2.0
// Every loop of the NEON table against the scalar one. No library but libc, so that it runs under an emulator too.
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/kernels/check.h"

enum { WATCHED = 64, SHOWN_FAILURES = 5 };

static char case_text[256];
static int failures;

void check_case(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(case_text, sizeof case_text, format, arguments);
    va_end(arguments);
}

/* Only calls that are allowed in a signal handler. */
static void on_fence(int signal_number)
{
    static const char before[] = "beyond its memory: ", after[] = "\n0 passed, 1 failed\n";
    const int ignored =
        (int)(write(STDOUT_FILENO, before, sizeof before - 1) + write(STDOUT_FILENO, case_text, strlen(case_text)) +
              write(STDOUT_FILENO, after, sizeof after - 1));
    (void)ignored;
    (void)signal_number;
    _exit(1);
}

void outputs_begin(outputs_t *outputs, size_t size)
{
    void *place[2];
    for (int i = 0; i < 2; i++) {
        if (outputs->memory[i].begin == NULL)
            outputs->memory[i] = fenced_new(1 << 16);
        place[i] = fenced_place(&outputs->memory[i], size, 0);
        memset((uint8_t *)place[i] - WATCHED, 0xa5, size + WATCHED);
    }
    outputs->size = size;
    outputs->expected = place[0];
    outputs->found = place[1];
}

void outputs_compare(const outputs_t *outputs)
{
    const uint8_t *expected = outputs->expected, *found = outputs->found;
    for (ptrdiff_t i = -WATCHED; i < (ptrdiff_t)outputs->size; i++) {
        if (expected[i] == found[i])
            continue;
        if (++failures <= SHOWN_FAILURES)
            printf("%s: byte %td of %zu is %d, expected %d\n", case_text, i, outputs->size, found[i], expected[i]);
        return;
    }
}

void check_fill(uint8_t *bytes, size_t size, int kind, rng_t *rng)
{
    for (size_t i = 0; i < size; i++) {
        const uint8_t noise = (uint8_t)rng_next(rng);
        const uint8_t values[CHECK_FILLS] = {0, 255, (uint8_t)(i % 2 * 255), (uint8_t)(noise % 2 * 255), noise};
        bytes[i] = values[kind];
    }
}

int main(void)
{
    static const struct {
        const char *name;
        check_group_fn *run;
    } groups[] = {
        {"grid_points", check_grid_points},   {"filters", check_filters},
        {"nearest", check_nearest},           {"windows", check_windows},
        {"coefficients", check_coefficients}, {"ls", check_ls},
        {"conversions", check_conversions},   {"frames", check_frames},
    };
    int passed = 0, failed = 0;
    signal(SIGSEGV, on_fence);
    signal(SIGBUS, on_fence);
    setvbuf(stdout, NULL, _IOLBF, 0);
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        failures = 0;
        groups[g].run(&warp_kernels_neon);
        if (failures == 0)
            passed++;
        else
            failed++;
        printf("%-8s%s (%d cases differ)\n", failures == 0 ? "ok" : "FAILED", groups[g].name, failures);
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
