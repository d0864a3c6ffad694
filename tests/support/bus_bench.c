// SPDX-License-Identifier: Apache-2.0
// Three controllers on a simulated bus, for tests.
#include "tests/support/bus_bench.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

bus_bench_t bus_bench_begin(void)
{
    sim_bus_t *bus = sim_bus_create(&(sim_bus_config_t){.bitrate = 500000, .seed = 7});
    hal_can_t *a = sim_bus_attach(bus), *b = sim_bus_attach(bus), *c = sim_bus_attach(bus);
    return (bus_bench_t){bus, a, b, c};
}

void bus_bench_run_for(const bus_bench_t *bench, int64_t us)
{
    sim_bus_advance(bench->bus, sim_bus_now_us(bench->bus) + us);
}

void bus_bench_send_numbers(const bus_bench_t *bench, int count)
{
    for (int i = 0; i < count; i++) {
        const hal_can_frame_t frame = {.id = 5, .length = 4, .data = {(uint8_t)i, (uint8_t)(i >> 8), 0x55, 0xAA}};
        assert_int_equal(hal_can_send(bench->a, &frame), HAL_OK);
        bus_bench_run_for(bench, 1000);
    }
}

int bus_bench_number(const hal_can_frame_t *frame)
{
    return frame->data[0] | frame->data[1] << 8;
}

int bus_bench_count_heard(hal_can_t *can)
{
    hal_can_frame_t frame;
    int count = 0;
    while (hal_can_receive(can, &frame) == HAL_OK)
        count++;
    return count;
}
