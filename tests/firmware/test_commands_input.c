// SPDX-License-Identifier: Apache-2.0
// Tests of commands that are wrong, cut off, for others or too many: a board says so or stays silent, and goes on.
#include "tests/firmware/operator_bench.h"

enum { LONG = 500, REPLY_FRAMES = 66 /* of 456 bytes: 6, then 7 in each */ };

/* Nothing was asked for, and a sound request is answered. */
static void check_untouched(void)
{
    const commands_t *c = &projector()->commands;
    assert_false(c->frozen);
    assert_int_equal(c->pattern, COMMAND_PATTERN_NONE);
    assert_int_equal(c->wanted_latency_ms, 0);
    assert_false(c->reboot);
    assert_ptr_equal(projector()->ladder.method[0], projector()->room_method);
    ask("\x01", 1, COMMAND_OK);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
    assert_int_equal(bench.voice[0].flags_ever, 0);
}

static void test_wrong_requests_are_refused_and_logged(void **state)
{
    (void)state;
    static const struct {
        const char *bytes;
        int length;
        command_result_t result;
    } wrong[] = {
        {"\x00", 1, COMMAND_UNKNOWN},
        {"\x08", 1, COMMAND_UNKNOWN},
        {"\xFF\x01", 2, COMMAND_UNKNOWN},
        {"\x01\x01", 2, COMMAND_BAD_VALUE},
        {"\x02no+such", 8, COMMAND_BAD_VALUE},
        {"\x02"
         "area\x00",
         6, COMMAND_BAD_VALUE},
        {"\x03", 1, COMMAND_BAD_VALUE},
        {"\x03\x02", 2, COMMAND_BAD_VALUE},
        {"\x03\x01\x01", 3, COMMAND_BAD_VALUE},
        {"\x04\x04", 2, COMMAND_BAD_VALUE},
        {"\x05\x41\x0D\x03\x00", 5, COMMAND_BAD_VALUE}, /* 200001 us */
        {"\x05\x01", 2, COMMAND_BAD_VALUE},
        {"\x06", 1, COMMAND_BAD_VALUE},
        {"\x06reboo", 6, COMMAND_BAD_VALUE},
        {"\x06Reboot", 7, COMMAND_BAD_VALUE},
        {"\x07\x00\x00\x00", 4, COMMAND_BAD_VALUE},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const event_log_t *log = &projector()->events.log;
        ask(wrong[i].bytes, wrong[i].length, wrong[i].result);
        assert_int_equal(operator.length, 2);
        const event_t *newest = &log->entry[(log->count - 1) % EVENT_LOG_ENTRIES];
        assert_int_equal(newest->kind, EVENT_COMMAND);
        assert_int_equal(newest->value, (uint8_t)wrong[i].bytes[0] + 256 * (int32_t)wrong[i].result);
        check_untouched();
    }
}

static void test_too_long_requests(void **state)
{
    (void)state;
    static uint8_t bytes[LONG] = {COMMAND_FREEZE, 1};
    ask(bytes, COMMAND_MAX_BYTES, COMMAND_BAD_VALUE);
    ask(bytes, COMMAND_MAX_BYTES + 1, COMMAND_BAD_VALUE);
    ask(bytes, LONG, COMMAND_BAD_VALUE);
    check_untouched();
}

static void send(const char *bytes, uint32_t id, bool fd, bool extended)
{
    hal_can_frame_t frame = {.id = id, .fd = fd, .extended = extended, .length = 8};
    memcpy(frame.data, bytes, 8);
    assert_int_equal(hal_can_send(operator.can, &frame), HAL_OK);
}

static const char freeze[] = "\x02\x03\x01\xCC\xCC\xCC\xCC\xCC";

static void test_frames_for_others(void **state)
{
    (void)state;
    const uint32_t id = CAN_ID_COMMAND + OPERATED_NODE;
    send(freeze, id + 1, false, false);
    send(freeze, CAN_ID_COMMAND, false, false);
    send(freeze, CAN_ID_REPLY + OPERATED_NODE, false, false);
    send(freeze, id, true, false);
    send(freeze, id, false, true);
    assert_false(operator_wait());
    check_untouched();
    send(freeze, id, false, false);
    assert_true(operator_wait());
    assert_int_equal(report()->state, CAN_BOARD_FROZEN);
}

static void test_requests_that_break_off(void **state)
{
    (void)state;
    const uint32_t id = CAN_ID_COMMAND + OPERATED_NODE;
    send("\x10\x08\x03\x01\x00\x00\x00\x00", id, false, false); /* its rest never comes */
    assert_false(operator_wait());
    check_untouched();
    send("\x10\x08\x03\x01\x00\x00\x00\x00", id, false, false);
    operator_step();
    send("\x22\x00\x00\xCC\xCC\xCC\xCC\xCC", id, false, false); /* not the next one */
    assert_false(operator_wait());
    check_untouched();
    send("\x21\x00\x00\xCC\xCC\xCC\xCC\xCC", id, false, false); /* of no message */
    send("\x30\x00\x00\xCC\xCC\xCC\xCC\xCC", id, false, false); /* nothing is being sent */
    send("\x00\x03\x01\xCC\xCC\xCC\xCC\xCC", id, false, false);
    assert_false(operator_wait());
    check_untouched();
    assert_true(projector()->commands.link.faults.timeout >= 1);
    assert_true(projector()->commands.link.faults.sequence >= 2);
}

static void test_operator_who_does_not_take_the_reply(void **state)
{
    (void)state;
    send("\x01\x01\xCC\xCC\xCC\xCC\xCC\xCC", CAN_ID_COMMAND + OPERATED_NODE, false, false);
    room_bench_run(&bench, 100);
    assert_true(isotp_sending(&projector()->commands.link));
    room_bench_run(&bench, 1100);
    assert_false(isotp_sending(&projector()->commands.link));
    isotp_init(&operator.link, CAN_ID_REPLY + OPERATED_NODE, CAN_ID_COMMAND + OPERATED_NODE);
    hal_can_frame_t frame;
    while (hal_can_receive(operator.can, &frame) == HAL_OK)
        continue;
    check_untouched();
}

/* As fast as it may: 66 frames, eight a step. */
static void test_long_reply_leaves_room_for_others(void **state)
{
    (void)state;
    for (int i = 0; i < COMMAND_MOST_EVENTS; i++)
        ask("\x03\x02", 2, COMMAND_BAD_VALUE);
    send("\x05\x07\x00\x00\x00\x00\xCC\xCC", CAN_ID_COMMAND + OPERATED_NODE, false, false);
    room_bench_step(&bench);
    room_bench_step(&bench);
    send("\x30\x00\x00\xCC\xCC\xCC\xCC\xCC", CAN_ID_COMMAND + OPERATED_NODE, false, false);
    operator.most = 0;
    hal_can_frame_t frame;
    int frames = 0, most = 0;
    for (int i = 0; i < 20; i++) {
        int now = 0;
        room_bench_step(&bench);
        while (hal_can_receive(operator.can, &frame) == HAL_OK)
            now += frame.id == CAN_ID_REPLY + OPERATED_NODE;
        frames += now;
        most = now > most ? now : most;
    }
    assert_int_equal(most, COMMANDS_FRAMES);
    assert_int_equal(frames, REPLY_FRAMES);
    assert_int_equal(report()->state, CAN_BOARD_RUNNING);
}

static void test_request_waits_for_the_end_of_a_reply(void **state)
{
    (void)state;
    const uint32_t id = CAN_ID_COMMAND + OPERATED_NODE;
    operator_send("\x01", 1);
    for (int i = 0; i < 3; i++)
        operator_step(); /* the reply is under way */
    assert_true(isotp_sending(&projector()->commands.link));
    send(freeze, id, false, false);
    assert_true(operator_wait());
    assert_int_equal(operator.reply[0], COMMAND_HELLO | COMMAND_REPLY_FLAG);
    assert_true(operator_wait());
    assert_int_equal(operator.reply[0], COMMAND_FREEZE | COMMAND_REPLY_FLAG);
    assert_int_equal(report()->state, CAN_BOARD_FROZEN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_wrong_requests_are_refused_and_logged, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_too_long_requests, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_frames_for_others, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_requests_that_break_off, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_operator_who_does_not_take_the_reply, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_long_reply_leaves_room_for_others, open_operator, close_bench),
        cmocka_unit_test_setup_teardown(test_request_waits_for_the_end_of_a_reply, open_operator, close_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
