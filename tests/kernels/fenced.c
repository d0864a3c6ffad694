// SPDX-License-Identifier: Apache-2.0
// Memory between two unreadable pages: who reads or writes one byte beyond it dies at once.
#include "tests/kernels/fenced.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

fenced_t fenced_new(size_t size)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), inside = (size + page - 1) / page * page;
    uint8_t *map = mmap(NULL, inside + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (map == MAP_FAILED || mprotect(map + page, inside, PROT_READ | PROT_WRITE) != 0) {
        perror("fenced memory");
        exit(1);
    }
    return (fenced_t){map + page, map + page + inside};
}
