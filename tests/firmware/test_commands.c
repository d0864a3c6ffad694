// SPDX-License-Identifier: Apache-2.0
// Tests of commands: a board on a simulated bus does what an operator asks for, says so, and logs it.
#include "tests/firmware/operator_bench.h"

#include "firmware/byte_order.h"
#include "firmware/pattern_picture.h"
#include "firmware/version.h"

enum { PANEL_BYTES = 96 * 54 * 4, MOST_EVENTS = 64 };

static void copy_shown(uint8_t bytes[PANEL_BYTES])
{
    const image_t *shown = sim_world_shown(bench.world, 0, room_bench_now_us(&bench));
    assert_non_null(shown);
    for (int32_t y = 0; y < shown->height; y++)
        memcpy(bytes + y * 96 * 4, image_row(shown, y), 96 * 4);
}

static void check_shows_pattern(command_pattern_t pattern)
{
    static uint8_t expected[PANEL_BYTES], shown[PANEL_BYTES];
    const image_t panel = {expected, 96, 54, 96 * 4, IMAGE_XRGB8888};
    const picture_t picture = picture_from_image(&panel);
    pattern_picture_draw(&picture, pattern);
    copy_shown(shown);
    assert_memory_equal(shown, expected, sizeof shown);
}

/* LED: of 100 steps, in how many it is on. */
static int led_steps(void)
{
    int on = 0;
    for (int i = 0; i < 100; i++) {
        operator_step();
        on += sim_gpio_level(devices()->gpio, HAL_GPIO_LED);
    }
    return on;
}

static void test_hello(void **state)
{
    (void)state;
    ask("\x01", 1, COMMAND_OK);
    const int text = (int)strlen(firmware_version);
    assert_int_equal(operator.length, 7 + text);
    assert_int_equal(operator.reply[2], OPERATED_NODE);
    assert_int_equal(get_u32(operator.reply + 3), projector()->events.log.count);
    assert_memory_equal(operator.reply + 7, firmware_version, (size_t)text);
}

static void test_frozen_wall_keeps_its_picture(void **state)
{
    (void)state;
    static uint8_t before[PANEL_BYTES], after[PANEL_BYTES];
    const int64_t others = sim_world_projector(bench.world, 1)->report.frame_number;
    assert_int_equal(led_steps(), 100);
    ask_command((command_t){.kind = COMMAND_FREEZE, .freeze = true}, COMMAND_OK);
    operator_step();
    const uint32_t number = report()->frame_number;
    copy_shown(before);
    const int led = led_steps();
    assert_in_range(led, 65, 85);
    room_bench_run(&bench, 3000);
    assert_int_equal(report()->state, CAN_BOARD_FROZEN);
    assert_false(report()->corrected);
    assert_int_equal(report()->frame_number, number);
    copy_shown(after);
    assert_memory_equal(before, after, sizeof before);
    assert_false(expired());
    assert_int_equal(bench.voice[0].heartbeat.state, CAN_BOARD_FROZEN);
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, 0);
    assert_true(sim_world_projector(bench.world, 1)->report.frame_number > others + 180);

    ask_command((command_t){.kind = COMMAND_FREEZE}, COMMAND_OK);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_well_again();
    copy_shown(after);
    assert_memory_not_equal(before, after, sizeof before);
}

static void test_pattern_is_shown_whatever_else_fails(void **state)
{
    (void)state;
    ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_GRID}, COMMAND_OK);
    assert_int_equal(report()->state, CAN_BOARD_PATTERN);
    check_shows_pattern(COMMAND_PATTERN_GRID);
    bench.tracking = false;
    sim_camera_faults(devices()->camera)->unplugged_until_us = INT64_MAX;
    room_bench_run(&bench, 2500);
    check_shows_pattern(COMMAND_PATTERN_GRID);
    assert_int_equal(bench.voice[0].heartbeat.state, CAN_BOARD_PATTERN);
    assert_int_equal(bench.voice[0].heartbeat.fault_flags, CAN_FAULT_CAMERA);
    assert_false(expired());

    ask_command((command_t){.kind = COMMAND_FREEZE, .freeze = true}, COMMAND_OK);
    ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_WHITE}, COMMAND_OK);
    assert_int_equal(report()->state, CAN_BOARD_FROZEN);
    check_shows_pattern(COMMAND_PATTERN_GRID);
    ask_command((command_t){.kind = COMMAND_FREEZE}, COMMAND_OK);
    check_shows_pattern(COMMAND_PATTERN_WHITE);

    sim_camera_faults(devices()->camera)->unplugged_until_us = 0;
    bench.tracking = true;
    ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_NONE}, COMMAND_OK);
    assert_well_again();
}

static void test_display_that_fails_is_a_fault_under_a_pattern_too(void **state)
{
    (void)state;
    ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_BLACK}, COMMAND_OK);
    sim_display_faults(devices()->display)->refuse_next = 1000;
    room_bench_run(&bench, 600);
    assert_int_equal(report()->state, CAN_BOARD_FAULT);
    sim_display_faults(devices()->display)->refuse_next = 0;
    room_bench_run(&bench, 100);
    assert_int_equal(report()->state, CAN_BOARD_PATTERN);
    check_shows_pattern(COMMAND_PATTERN_BLACK);
}

static void check_method(const char *name, command_result_t result, const char *used)
{
    ask_command((command_t){.kind = COMMAND_METHOD, .method = warp_method_from_name(name)}, result);
    room_bench_run(&bench, 100);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_true(report()->corrected);
    assert_string_equal(projector()->ladder.method[0]->name, used);
    assert_int_equal(projector()->warp.method.filter, projector()->ladder.method[0]->filter);
    assert_int_equal(projector()->warp.method.resampler, projector()->ladder.method[0]->resampler);
    for (int32_t i = 0; i < projector()->ladder.steps; i++)
        assert_true(warp_has_method(&projector()->warp, *projector()->ladder.method[i]));
}

/* A picture by an operator's method is the one of a board whose room file says so. */
static void check_as_from_a_room_file(const char *name)
{
    static uint8_t found[PANEL_BYTES], expected[PANEL_BYTES];
    static warp_t warp;
    const uint8_t border[3] = {0, 0, 0};
    const image_t panel = {expected, 96, 54, 96 * 4, IMAGE_XRGB8888};
    const picture_t picture = picture_from_image(&panel), from = frame_choice_picture(&projector()->choice);
    homography_t homography;
    copy_shown(found);
    warp_init(&warp, *warp_method_from_name(name), false, border);
    assert_true(homography_from_pose(&homography, &projector()->camera, &projector()->wall, &report()->pose));
    assert_true(warp_plan(&warp, projector()->kernels, NULL, &homography, &picture, &from));
    for (int step = WARP_MEASURE; step <= WARP_DRAW; step++)
        if (warp_needs(&warp, (warp_step_t)step))
            warp_work(&warp, (warp_step_t)step, (worker_t){0, 1});
    assert_memory_equal(found, expected, sizeof found);
}

static void test_methods(void **state)
{
    (void)state;
    check_method("area", COMMAND_OK, "area");
    check_as_from_a_room_file("area");
    check_method("mean+spline", COMMAND_OK, "mean+spline");
    check_as_from_a_room_file("mean+spline");
    check_method("gauss+nearest", COMMAND_OK, "gauss+nearest");
    check_as_from_a_room_file("gauss+nearest");
    check_method("butter+nearest", COMMAND_OK, "butter+nearest");
    check_as_from_a_room_file("butter+nearest");
    check_method("ls", COMMAND_IMPOSSIBLE, "butter+nearest");
    check_method("none+cubic", COMMAND_IMPOSSIBLE, "butter+nearest");
    room_bench_run(&bench, 1100);
    assert_int_equal(bench.voice[0].quality.filter, WARP_FILTER_BUTTER);
    check_method("", COMMAND_OK, "mean+cubic");
    check_as_from_a_room_file("mean+cubic");
}

static void test_latency(void **state)
{
    (void)state;
    /* 2 ms for the pose, a period and a half, and one held back: (42 - 27) ms are nearer to it than to none. */
    ask_command((command_t){.kind = COMMAND_LATENCY, .latency_us = 41500}, COMMAND_OK);
    assert_int_equal(operator.length, 6);
    assert_int_equal(get_u32(operator.reply + 2), 2000 + 25000 + 16667);
    assert_int_equal(projector()->commands.wanted_latency_ms, 42);
    /* The most: three held back, and half a period. */
    ask_command((command_t){.kind = COMMAND_LATENCY, .latency_us = 86000}, COMMAND_IMPOSSIBLE);
    assert_int_equal(operator.length, 10);
    assert_int_equal(get_u32(operator.reply + 2), 27000);
    assert_int_equal(get_u32(operator.reply + 6), 27000 + 3 * 16667 + 8333);
    assert_int_equal(projector()->commands.wanted_latency_ms, 42);
    ask_command((command_t){.kind = COMMAND_LATENCY, .latency_us = 0}, COMMAND_OK);
    assert_int_equal(get_u32(operator.reply + 2), 27000);
    assert_int_equal(projector()->commands.wanted_latency_ms, 0);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
}

static void test_reboot_waits_for_its_reply(void **state)
{
    (void)state;
    ask_command((command_t){.kind = COMMAND_REBOOT}, COMMAND_OK);
    const uint64_t feeds = sim_watchdog_feeds(devices()->watchdog);
    room_bench_run(&bench, 1900);
    assert_false(expired());
    room_bench_run(&bench, 200);
    assert_true(expired());
    assert_int_equal(sim_watchdog_feeds(devices()->watchdog), feeds);
    assert_false(sim_watchdog_expired(sim_world_devices(bench.world, 1)->watchdog, room_bench_now_us(&bench)));
}

static void check_event(const event_t *event, event_kind_t kind, int32_t value)
{
    assert_int_equal(event->kind, kind);
    assert_int_equal(event->value, value);
}

/* The log from an event on. @return How many came. */
static int read_log(uint32_t first, event_t events[COMMAND_MOST_EVENTS])
{
    ask_command((command_t){.kind = COMMAND_LOG, .first_event = first}, COMMAND_OK);
    assert_int_equal((operator.length - 6) % EVENT_BYTES, 0);
    assert_int_equal(get_u32(operator.reply + 2), first);
    const int count = (operator.length - 6) / EVENT_BYTES;
    for (int i = 0; i < count; i++)
        assert_true(event_unpack(&events[i], operator.reply + 6 + EVENT_BYTES * i));
    return count;
}

static void test_log_has_what_happened(void **state)
{
    (void)state;
    static event_t event[COMMAND_MOST_EVENTS];
    room_bench_run(&bench, 1500);
    const uint32_t seen = projector()->events.log.count;
    assert_true(seen >= 3);
    assert_int_equal(read_log(0, event), seen);
    check_event(&event[0], EVENT_START, OPERATED_NODE);
    check_event(&event[1], EVENT_STATE, CAN_BOARD_RUNNING);
    assert_int_equal(event[0].time_ms, 0);
    check_event(&event[seen - 1], EVENT_BUS_TIME, CAN_TIME_OWN);

    const int64_t began_us = room_bench_now_us(&bench) - projector()->telemetry.start_us;
    sim_camera_faults(devices()->camera)->unplugged_until_us = INT64_MAX;
    room_bench_run(&bench, 1800);
    sim_camera_faults(devices()->camera)->unplugged_until_us = 0;
    room_bench_run(&bench, 800);
    ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_WHITE}, COMMAND_OK);
    ask_command((command_t){.kind = COMMAND_METHOD, .method = warp_method_from_name("ls")}, COMMAND_IMPOSSIBLE);
    assert_int_equal(read_log(seen, event), 7);
    check_event(&event[0], EVENT_STATE, CAN_BOARD_FAULT);
    check_event(&event[1], EVENT_FAULTS, CAN_FAULT_CAMERA);
    check_event(&event[2], EVENT_STATE, CAN_BOARD_RUNNING);
    check_event(&event[3], EVENT_FAULTS, 0);
    check_event(&event[4], EVENT_COMMAND, COMMAND_PATTERN + 65536 * COMMAND_PATTERN_WHITE);
    check_event(&event[5], EVENT_STATE, CAN_BOARD_PATTERN);
    check_event(&event[6], EVENT_COMMAND, COMMAND_METHOD + 256 * COMMAND_IMPOSSIBLE + 65536 * WARP_LS);
    assert_in_range(event[0].time_ms, began_us / 1000 + 900, began_us / 1000 + 1100);
    for (int i = 1; i < 7; i++)
        assert_true(event[i].time_ms >= event[i - 1].time_ms);
    assert_int_equal(read_log(seen + 7, event), 0);
}

static void test_long_log_comes_in_parts(void **state)
{
    (void)state;
    static event_t event[COMMAND_MOST_EVENTS];
    for (int i = 0; i < MOST_EVENTS; i++)
        ask_command((command_t){.kind = COMMAND_FREEZE, .freeze = i % 2 == 0}, COMMAND_OK);
    const uint32_t count = projector()->events.log.count;
    assert_true(count > 2 * COMMAND_MOST_EVENTS);
    for (uint32_t first = 0; first < count; first += COMMAND_MOST_EVENTS) {
        const uint32_t rest = count - first;
        assert_int_equal(read_log(first, event), rest < COMMAND_MOST_EVENTS ? rest : COMMAND_MOST_EVENTS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_hello, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_frozen_wall_keeps_its_picture, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_pattern_is_shown_whatever_else_fails, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_display_that_fails_is_a_fault_under_a_pattern_too, open_operator,
                                        close_bench),
        cmocka_unit_test_setup_teardown(test_methods, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_latency, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_reboot_waits_for_its_reply, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_log_has_what_happened, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_long_log_comes_in_parts, open_operator, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
