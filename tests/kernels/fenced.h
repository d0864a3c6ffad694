// SPDX-License-Identifier: Apache-2.0
// Memory between two unreadable pages: who reads or writes one byte beyond it dies at once.
#ifndef TESTS_KERNELS_FENCED_H
#define TESTS_KERNELS_FENCED_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint8_t *begin, *end; /**< the fences; what lies between is readable and writable */
} fenced_t;

/** @return At least size bytes, never freed. Ends the program when there is no memory. */
fenced_t fenced_new(size_t size);

/** @return size bytes that touch the fence behind them, or where at_begin is set, the one before them. */
static inline void *fenced_place(const fenced_t *memory, size_t size, int at_begin)
{
    return at_begin ? memory->begin : memory->end - size;
}

#endif
