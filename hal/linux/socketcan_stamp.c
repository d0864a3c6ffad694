// SPDX-License-Identifier: Apache-2.0
// When a frame was received, on CLOCK_MONOTONIC, from stamps that the kernel and the controller make on other clocks.
#include "hal/linux/socketcan_stamp.h"

enum { MILLION = 1000000 };

/* In the year 2116; distances of two stamps then fit 64 bits. */
static const int64_t LAST_NS = INT64_MAX / 2;

static int64_t clamp(int64_t value, int64_t first, int64_t last)
{
    if (value < first)
        return first;
    return value > last ? last : value;
}

/* Out of the interval that the frame must lie in? */
static bool is_wrong(int64_t time_ns, const socketcan_stamp_t *s, const clock_pair_t *now)
{
    return time_ns > now->monotonic_ns || time_ns < s->empty.monotonic_ns - SOCKETCAN_STAMP_QUEUE_NS;
}

static int64_t from_kernel(const socketcan_stamp_t *s, int64_t kernel_ns, const clock_pair_t *now)
{
    if (kernel_ns <= 0 || kernel_ns > LAST_NS)
        return now->monotonic_ns;
    int64_t time_ns = kernel_ns - now->realtime_ns + now->monotonic_ns;
    if (is_wrong(time_ns, s, now))
        time_ns = kernel_ns - s->empty.realtime_ns + s->empty.monotonic_ns;
    return clamp(time_ns, s->empty.monotonic_ns - SOCKETCAN_STAMP_QUEUE_NS, now->monotonic_ns);
}

static int64_t from_controller(socketcan_stamp_t *s, int64_t controller_ns, int64_t kernel_ns)
{
    if (controller_ns <= 0 || controller_ns > LAST_NS)
        return kernel_ns;
    const int64_t found_ns = kernel_ns - controller_ns;
    const int64_t elapsed_ns = kernel_ns - s->distance_at_ns;
    const int64_t raised_ns = s->distance_ns + elapsed_ns / (MILLION / SOCKETCAN_STAMP_DRIFT_PPM);
    const bool known = s->distance_known && found_ns - raised_ns <= SOCKETCAN_STAMP_JUMP_NS;
    s->distance_known = true;
    s->distance_ns = known && raised_ns < found_ns ? raised_ns : found_ns;
    s->distance_at_ns = kernel_ns;
    return controller_ns + s->distance_ns;
}

int64_t socketcan_stamp_ns(socketcan_stamp_t *stamp, const socketcan_stamps_t *of, const clock_pair_t *now)
{
    const int64_t time_ns = from_controller(stamp, of->controller_ns, from_kernel(stamp, of->kernel_ns, now));
    stamp->last_ns = clamp(time_ns, stamp->last_ns, now->monotonic_ns);
    return stamp->last_ns;
}
