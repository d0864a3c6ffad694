// SPDX-License-Identifier: Apache-2.0
// A board that can't do its work on a bus with an operator, in virtual time, for tests of notice.h.
#ifndef TESTS_FIRMWARE_NOTICE_BENCH_H
#define TESTS_FIRMWARE_NOTICE_BENCH_H

#include "firmware/notice.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/bus/sim_bus.h"
#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_display.h"
#include "sim/devices/sim_gpio.h"
#include "sim/devices/sim_service.h"
#include "sim/devices/sim_watchdog.h"

enum { WIDTH = 320, HEIGHT = 180, HZ = 60, NODE = 5, WATCHDOG_US = 2000000, FIRST_US = 1000000 };

static const char reason[] = "room.yaml:3: boards[0].node: found 99, expected 1 to 63";

static struct {
    hal_board_t devices;
    sim_bus_t *bus;
    hal_can_t *others; /* on the bus */
    isotp_t link;      /* an operator's */
    room_t room;
    notice_t notice;
    int64_t now_us;
    int steps;
    uint32_t heartbeats, strangers; /* heard: heartbeats of this board, and frames that are neither these nor replies */
    can_heartbeat_t heartbeat;      /* the newest */
    int led_edges;
} bench;

static projector_t *projector;

static inline int open_bench(void **state)
{
    char error[FILE_ERROR_LENGTH] = "";
    (void)state;
    memset(&bench, 0, sizeof bench);
    bench.now_us = FIRST_US;
    bench.notice = (notice_t){.reason = reason, .board = "front", .node = NODE};
    bench.bus = sim_bus_create(
        &(sim_bus_config_t){.bitrate = 500000, .data_bitrate = 2000000, .fd = true, .start_us = FIRST_US});
    hal_board_t *d = &bench.devices;
    d->clock = sim_clock_create(&(sim_clock_settings_t){.epoch_us = FIRST_US}, error);
    d->can = sim_bus_attach(bench.bus);
    bench.others = sim_bus_attach(bench.bus);
    const sim_display_settings_t display = {
        .width = WIDTH, .height = HEIGHT, .clock = d->clock, .blanks = {FIRST_US, HZ, 1}};
    d->display = sim_display_create(&display, error);
    d->gpio = sim_gpio_create(d->clock, error);
    d->watchdog = sim_watchdog_create(d->clock, WATCHDOG_US, error);
    d->service = sim_service_create(error);
    isotp_init(&bench.link, CAN_ID_REPLY + NODE, CAN_ID_COMMAND + NODE);
    projector = malloc(sizeof *projector);
    return d->service == NULL || projector == NULL;
}

static inline int close_bench(void **state)
{
    (void)state;
    sim_service_destroy(bench.devices.service);
    sim_watchdog_destroy(bench.devices.watchdog);
    sim_gpio_destroy(bench.devices.gpio);
    sim_display_destroy(bench.devices.display);
    sim_bus_destroy(bench.bus);
    sim_clock_destroy(bench.devices.clock);
    free(projector);
    return 0;
}

static inline void begin(can_auth_t *key)
{
    notice_init(projector, &bench.notice, &bench.devices, &bench.room);
    projector_use_key(projector, key, 1);
}

static inline void hear(void)
{
    hal_can_frame_t frame;
    while (hal_can_receive(bench.others, &frame) == HAL_OK) {
        if (isotp_take(&bench.link, &frame, bench.now_us))
            continue;
        const bool heartbeat = can_heartbeat_decode(&bench.heartbeat, &frame) == CAN_CHECK_OK;
        bench.heartbeats += heartbeat && bench.heartbeat.node == NODE;
        bench.strangers += !heartbeat || bench.heartbeat.node != NODE;
    }
    while (isotp_next(&bench.link, &frame, bench.now_us))
        assert_int_equal(hal_can_send(bench.others, &frame), HAL_OK);
}

static inline void run(int milliseconds)
{
    for (const int end = bench.steps + milliseconds * HZ / 1000; bench.steps < end;) {
        const bool led = sim_gpio_level(bench.devices.gpio, HAL_GPIO_LED);
        bench.now_us = FIRST_US + (int64_t)++bench.steps * 1000000 / HZ;
        sim_clock_set_us(bench.devices.clock, bench.now_us);
        sim_bus_advance(bench.bus, bench.now_us);
        sim_display_advance(bench.devices.display, bench.now_us);
        notice_step(projector, &bench.notice);
        hear();
        bench.led_edges += led != sim_gpio_level(bench.devices.gpio, HAL_GPIO_LED);
    }
}

/* @return The result in the reply; -1: none came. */
static inline int ask(const void *request, int length)
{
    const uint8_t *reply;
    assert_true(isotp_send(&bench.link, request, length, bench.now_us));
    for (int i = 0; i < 2 * HZ; i++) {
        run(20);
        if (isotp_received(&bench.link, &reply) > 1) {
            const int result = reply[1];
            isotp_taken(&bench.link);
            return result;
        }
    }
    return -1;
}

static inline int ask_command(command_t command)
{
    uint8_t bytes[COMMAND_MAX_BYTES];
    return ask(bytes, command_encode(bytes, &command));
}

#endif
