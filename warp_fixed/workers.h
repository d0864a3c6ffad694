// SPDX-License-Identifier: Apache-2.0
// Who does which part of a frame: one of several workers, each with a share of its own.
#ifndef WARP_FIXED_WORKERS_H
#define WARP_FIXED_WORKERS_H

#include <stdint.h>

enum { WORKERS_MAX = 4 };

/** One of several that do the same step of a frame at the same time. */
typedef struct {
    int32_t index; /**< 0 to count - 1 */
    int32_t count; /**< 1 to WORKERS_MAX */
} worker_t;

/** The one worker of those who have no others. */
static const worker_t only_worker = {0, 1};

/** Things [begin, end) of some that are done in parts. */
typedef struct {
    int32_t begin, end;
} share_t;

/** @return The worker's share of `count` things; shares follow one another and differ by one thing at most. */
static inline share_t share_of(worker_t worker, int32_t count)
{
    return (share_t){(int32_t)((int64_t)count * worker.index / worker.count),
                     (int32_t)((int64_t)count * (worker.index + 1) / worker.count)};
}

#endif
