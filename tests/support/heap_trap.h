// SPDX-License-Identifier: Apache-2.0
// Counts what a test's program takes from the heap. Include it in one file of the program.
#ifndef TESTS_SUPPORT_HEAP_TRAP_H
#define TESTS_SUPPORT_HEAP_TRAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

/* The allocator of this program is the C library's behind a trap. So it cannot be built with a sanitizer, which brings
 * an allocator of its own. */
/* Volatile: a compiler knows that its own malloc() reads no variable of the program. */
static volatile bool heap_trap_set;
static volatile int heap_trap_calls;

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *block);

void *malloc(size_t size)
{
    heap_trap_calls += heap_trap_set;
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    heap_trap_calls += heap_trap_set;
    return __libc_calloc(count, size);
}

void *realloc(void *block, size_t size)
{
    heap_trap_calls += heap_trap_set;
    return __libc_realloc(block, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    heap_trap_calls += heap_trap_set;
    return __libc_memalign(alignment, size);
}

void free(void *block)
{
    heap_trap_calls += heap_trap_set;
    __libc_free(block);
}

/* A test of the test. */
static void heap_trap_works(void **state)
{
    (void)state;
    heap_trap_calls = 0;
    heap_trap_set = true;
    void *volatile block = malloc(1);
    free(block);
    heap_trap_set = false;
    assert_int_equal(heap_trap_calls, 2);
}

#endif
