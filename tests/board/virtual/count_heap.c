// SPDX-License-Identifier: Apache-2.0
// Counts what a program takes from the heap, by thread and by the library that asked, for LD_PRELOAD.
//
// The file that HEAP_COUNTS names has a line for each thread and library, in fixed columns: calls, thread's name,
// object. It can be read at any time.
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

enum { THREADS = 16, OBJECTS = 8, LINE = 64, NAME = 16, OBJECT = 32 };

typedef struct {
    char object[OBJECT];
    unsigned long calls;
} count_t;

/* Each thread counts alone: a lock could stop one of real-time priority for ever. */
static count_t count[THREADS][OBJECTS];
static atomic_int threads;
static _Thread_local int own __attribute__((tls_model("initial-exec"))); /* plus 1; 0: none yet */
static char (*lines)[OBJECTS][LINE];                                     /* of the file */

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void *_Znwm(size_t size);

__attribute__((constructor)) static void open_counts(void)
{
    const char *path = getenv("HEAP_COUNTS");
    const int file = path == NULL ? -1 : open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0 || ftruncate(file, THREADS * OBJECTS * LINE) != 0)
        return;
    void *map = mmap(NULL, THREADS * OBJECTS * LINE, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    (void)close(file);
    if (map != MAP_FAILED)
        lines = map;
}

static void name_object(char object[OBJECT], const void *address)
{
    Dl_info info;
    const char *path = dladdr(address, &info) != 0 ? info.dli_fname : "?";
    const char *slash = strrchr(path, '/');
    (void)snprintf(object, OBJECT, "%s", slash == NULL ? path : slash + 1);
}

/* More threads or libraries than there is room for share the last place. */
static void note(const void *caller)
{
    char object[OBJECT], thread[NAME];
    int i = 0;
    if (lines == NULL)
        return;
    if (own == 0)
        own = atomic_fetch_add(&threads, 1) + 1;
    const int thread_number = own < THREADS ? own - 1 : THREADS - 1;
    count_t *counts = count[thread_number];
    name_object(object, caller);
    while (i < OBJECTS - 1 && counts[i].calls > 0 && strcmp(counts[i].object, object) != 0)
        i++;
    memcpy(counts[i].object, object, OBJECT);
    counts[i].calls++;
    (void)prctl(PR_GET_NAME, thread);
    char *line = lines[thread_number][i];
    (void)snprintf(line, LINE, "%10lu %2d %-15s %-31s", counts[i].calls, own, thread, object);
    line[LINE - 1] = '\n';
}

void *malloc(size_t size)
{
    note(__builtin_return_address(0));
    return __libc_malloc(size);
}

void *calloc(size_t number, size_t size)
{
    note(__builtin_return_address(0));
    return __libc_calloc(number, size);
}

void *realloc(void *block, size_t size)
{
    note(__builtin_return_address(0));
    return __libc_realloc(block, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    note(__builtin_return_address(0));
    return __libc_memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
    note(__builtin_return_address(0));
    *block = __libc_memalign(alignment, size);
    return *block == NULL ? ENOMEM : 0;
}

/* C++'s operator new, so that it counts for who uses it, and not for the library that has it. */
void *_Znwm(size_t size)
{
    note(__builtin_return_address(0));
    void *block = __libc_malloc(size);
    if (block == NULL)
        abort();
    return block;
}
