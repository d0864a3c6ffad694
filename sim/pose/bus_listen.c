// SPDX-License-Identifier: Apache-2.0
// Hears a bus for some time, frame by frame.
#include "sim/pose/bus_listen.h"

#include <stddef.h>

#include "sim/devices/sim_clock.h"

enum { TICK_US = 100000, US_PER_MS = 1000 };

static bus_listen_end_t hear(pose_link_t *link, const bus_listen_t *listen, char error[POSE_LINK_MESSAGE_LENGTH])
{
    const int64_t start_us = sim_clock_monotonic_us();
    int64_t tick_us = start_us + TICK_US;
    for (;;) {
        const int64_t now_us = sim_clock_monotonic_us();
        if (*listen->stop || (listen->length_us > 0 && now_us - start_us >= listen->length_us))
            return BUS_LISTEN_DONE;
        if (now_us >= tick_us) {
            tick_us = now_us + TICK_US;
            if (listen->tick != NULL)
                listen->tick(listen->context);
        }
        hal_can_frame_t frame;
        const int wait_ms = (int)((tick_us - now_us) / US_PER_MS) + 1;
        switch (pose_link_receive(link, &frame, wait_ms > 0 ? wait_ms : 0, error)) {
        case POSE_LINK_FRAME:
            if (!listen->frame(listen->context, &frame))
                return BUS_LISTEN_DONE;
            break;
        case POSE_LINK_ERROR:
            if (listen->bus_error != NULL)
                listen->bus_error(listen->context);
            break;
        case POSE_LINK_ENDED:
            return BUS_LISTEN_ENDED;
        case POSE_LINK_QUIET:
            break;
        }
    }
}

bus_listen_end_t bus_listen(const char *bus, const bus_listen_t *listen, char error[POSE_LINK_MESSAGE_LENGTH])
{
    pose_link_t link;
    if (!pose_link_open(&link, bus, false, error))
        return BUS_LISTEN_FAILED;
    bus_listen_end_t end = BUS_LISTEN_FAILED;
    if (pose_link_listen(&link, error))
        end = hear(&link, listen, error);
    pose_link_close(&link);
    return end;
}
