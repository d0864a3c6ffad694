// SPDX-License-Identifier: Apache-2.0
// Two simulated controllers alone on one bus.
#include "tests/support/can_pair.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>

#include "sim/bus/sim_bus.h"

struct can_pair {
    sim_bus_t *bus;
    hal_can_t *controller[2];
};

can_pair_t *can_pair_open(const char *const names[2], bool fd)
{
    (void)names;
    const sim_bus_config_t config = {.bitrate = 500000, .data_bitrate = 2000000, .fd = fd, .start_us = 1000000};
    can_pair_t *pair = malloc(sizeof *pair);
    assert_non_null(pair);
    pair->bus = sim_bus_create(&config);
    assert_non_null(pair->bus);
    for (int i = 0; i < 2; i++) {
        pair->controller[i] = sim_bus_attach(pair->bus);
        assert_non_null(pair->controller[i]);
    }
    return pair;
}

void can_pair_close(can_pair_t *pair)
{
    sim_bus_destroy(pair->bus);
    free(pair);
}

hal_can_t *can_pair_controller(can_pair_t *pair, int number)
{
    return pair->controller[number];
}

void can_pair_wait(can_pair_t *pair, int64_t time_us)
{
    sim_bus_advance(pair->bus, sim_bus_now_us(pair->bus) + time_us);
}

int64_t can_pair_now_us(const can_pair_t *pair)
{
    return sim_bus_now_us(pair->bus);
}
