// SPDX-License-Identifier: Apache-2.0
// A board that can't do its work: its wall, its heartbeats, what it does for operators, and its signs of life.
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

static int open_bench(void **state)
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

static int close_bench(void **state)
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

static void begin(can_auth_t *key)
{
    notice_init(projector, &bench.notice, &bench.devices, &bench.room);
    projector_use_key(projector, key, 1);
}

static void hear(void)
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

static void run(int milliseconds)
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
static int ask(const void *request, int length)
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

static int ask_command(command_t command)
{
    uint8_t bytes[COMMAND_MAX_BYTES];
    return ask(bytes, command_encode(bytes, &command));
}

static bool shows(const safe_picture_t *what)
{
    static uint8_t bytes[WIDTH * HEIGHT * 4];
    const image_t expected = {bytes, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
    const picture_t panel = picture_from_image(&expected);
    safe_picture_draw(&panel, what);
    const image_t *shown = sim_display_shown(bench.devices.display);
    return shown != NULL && memcmp(shown->data, bytes, sizeof bytes) == 0;
}

static void the_wall_says_why(void **state)
{
    (void)state;
    begin(NULL);
    run(1000);
    assert_true(shows(&(safe_picture_t){"front", NODE, reason}));
    assert_false(shows(&(safe_picture_t){"front", NODE, "no pose"}));
    assert_true(sim_gpio_level(bench.devices.gpio, HAL_GPIO_LAMP));
    assert_in_range(bench.led_edges, 14, 18); /* of 60 ms */
}

static void heartbeats_say_so_and_nothing_else_is_sent(void **state)
{
    (void)state;
    begin(NULL);
    run(3000);
    assert_in_range(bench.heartbeats, 6, 7);
    assert_int_equal(bench.strangers, 0);
    assert_int_equal(bench.heartbeat.state, CAN_BOARD_FAULT);
    assert_int_equal(bench.heartbeat.fault_flags, CAN_FAULT_CONFIG);
    assert_in_range(bench.heartbeat.uptime_s, 2, 3);
    assert_in_range(bench.heartbeat.frame_number, 140, 180);
}

static void it_lives(void **state)
{
    (void)state;
    begin(NULL);
    run(5000);
    const sim_service_heard_t *heard = sim_service_heard(bench.devices.service);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_true(heard->ready_us > INT64_MIN);
    assert_true(heard->last.healthy);
    assert_int_equal(heard->states, 1);
    assert_string_equal(heard->last.state, reason);
}

static void operators_are_served(void **state)
{
    (void)state;
    begin(NULL);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_HELLO}), COMMAND_OK);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_LOG}), COMMAND_OK);
    assert_true(ask_command((command_t){.kind = COMMAND_LATENCY, .latency_us = 200000}) >= 0);
    for (int i = 0; i < WARP_METHODS; i++)
        assert_true(ask_command((command_t){.kind = COMMAND_METHOD, .method = &warp_methods[i]}) >= 0);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_WHITE}), COMMAND_OK);
    run(100);
    assert_int_equal(sim_display_shown(bench.devices.display)->data[4 * (WIDTH * 20 + 20)], 255);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_PATTERN}), COMMAND_OK);
    run(100);
    assert_true(shows(&(safe_picture_t){"front", NODE, reason}));
}

static void a_reboot_is_one(void **state)
{
    (void)state;
    begin(NULL);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_REBOOT}), COMMAND_OK);
    run(2500);
    assert_true(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_false(sim_service_heard(bench.devices.service)->last.healthy);
}

static void without_a_key_that_there_may_be_nobody_is_served(void **state)
{
    (void)state;
    bench.notice.deaf = true;
    begin(NULL);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_REBOOT}), -1);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
}

static void with_a_key_a_code_is_needed(void **state)
{
    (void)state;
    const hal_key_t secret = {.bytes = {1, 2, 3}};
    can_auth_t *key = can_auth_open(&secret);
    assert_non_null(key);
    begin(key);
    run(100);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_REBOOT}), COMMAND_REFUSED);
    assert_int_equal(ask_command((command_t){.kind = COMMAND_NONCE}), COMMAND_OK);
    run(2500);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_int_equal(bench.strangers, 0);
    can_auth_close(key);
}

static void a_display_that_hangs_is_no_life(void **state)
{
    (void)state;
    begin(NULL);
    run(100);
    sim_display_faults(bench.devices.display)->late_blanks = 1000000;
    sim_display_faults(bench.devices.display)->late_next = 1;
    run(3000);
    assert_true(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_int_equal(bench.heartbeat.fault_flags, CAN_FAULT_CONFIG | CAN_FAULT_DISPLAY);
}

static void what_is_missing_is_done_without(void **state)
{
    (void)state;
    hal_can_t *const can = bench.devices.can;
    bench.notice.node = 0;
    bench.devices.can = NULL;
    begin(NULL);
    run(1000);
    assert_true(shows(&(safe_picture_t){"front", 0, reason}));
    assert_int_equal(bench.heartbeats + bench.strangers, 0);

    hal_display_t *const display = bench.devices.display;
    bench.notice.node = NODE;
    bench.devices.can = can;
    bench.devices.display = NULL;
    begin(NULL);
    for (int i = 0; i < 3 * HZ; i++) {
        bench.now_us += 1000000 / HZ;
        sim_clock_set_us(bench.devices.clock, bench.now_us);
        sim_bus_advance(bench.bus, bench.now_us);
        notice_step(projector, &bench.notice);
        hear();
    }
    bench.devices.display = display;
    assert_in_range(bench.heartbeats, 6, 7);
    assert_int_equal(bench.heartbeat.fault_flags, CAN_FAULT_CONFIG);
    assert_false(sim_watchdog_expired(bench.devices.watchdog, bench.now_us));
    assert_false(sim_gpio_level(bench.devices.gpio, HAL_GPIO_LAMP) && projector->report.frame_number == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_wall_says_why, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(heartbeats_say_so_and_nothing_else_is_sent, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(it_lives, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(operators_are_served, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(a_reboot_is_one, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(without_a_key_that_there_may_be_nobody_is_served, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(with_a_key_a_code_is_needed, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(a_display_that_hangs_is_no_life, open_bench, close_bench),
        cmocka_unit_test_setup_teardown(what_is_missing_is_done_without, open_bench, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
