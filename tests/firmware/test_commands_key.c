// SPDX-License-Identifier: Apache-2.0
// Commands to a board with a key: only with a code, each code once, and what is lost is asked again.
#include "firmware/byte_order.h"
#include "tests/firmware/key_bench.h"

enum { NODE = 5, WAIT_STEPS = 3 * ROOM_BENCH_HZ, HEADER_BYTES = 2 };

static isotp_t link;
static uint8_t reply[COMMAND_REPLY_BYTES];

static int open_board(void **state)
{
    key_open_fd(state);
    isotp_init(&link, CAN_ID_REPLY + NODE, CAN_ID_COMMAND + NODE);
    key_run(200);
    return 0;
}

/* A step of the room; the stranger's controller is the operator's. */
static void step(void)
{
    hal_can_frame_t frame;
    key_listen();
    key_step();
    for (int i = 0; i < k.frames; i++)
        (void)isotp_take(&link, &k.heard[i], room_bench_now_us(&k.room));
    while (isotp_next(&link, &frame, room_bench_now_us(&k.room)))
        key_inject(&frame, 1);
}

/* @return Bytes of the reply to a request, which must come. */
static int ask(const uint8_t *bytes, int length)
{
    int got = 0;
    assert_true(isotp_send(&link, bytes, length, room_bench_now_us(&k.room)));
    for (int i = 0; i < WAIT_STEPS && got == 0; i++) {
        const uint8_t *answer;
        step();
        got = isotp_received(&link, &answer);
        if (got > 0)
            memcpy(reply, answer, (size_t)got);
        isotp_taken(&link);
    }
    assert_true(got >= HEADER_BYTES);
    assert_int_equal(reply[0], bytes[0] | COMMAND_REPLY_FLAG);
    return got;
}

static uint64_t ask_nonce(void)
{
    static const uint8_t nonce = COMMAND_NONCE;
    assert_int_equal(ask(&nonce, 1), HEADER_BYTES + 8);
    assert_int_equal(reply[1], COMMAND_OK);
    return get_u64(reply + HEADER_BYTES);
}

/* @return Bytes of the request with its code. */
static int sign(uint8_t bytes[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES], command_t command, can_auth_t *key,
                uint64_t nonce)
{
    const int length = command_encode(bytes, &command);
    const can_auth_command_t plain = {CAN_ID_COMMAND + NODE, bytes, length, nonce};
    assert_true(can_auth_sign_command(key, &plain, bytes + length));
    return length + CAN_AUTH_COMMAND_BYTES;
}

static void assert_result(const uint8_t *bytes, int length, command_result_t result)
{
    (void)ask(bytes, length);
    assert_int_equal(reply[1], result);
}

static void test_only_with_a_code(void **state)
{
    (void)state;
    uint8_t bytes[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES];
    const command_t freeze = {.kind = COMMAND_FREEZE, .freeze = true};
    assert_result(bytes, command_encode(bytes, &freeze), COMMAND_REFUSED);
    assert_result(bytes, sign(bytes, freeze, k.key, 0), COMMAND_REFUSED); /* no number was given */
    assert_result(bytes, sign(bytes, freeze, k.other, ask_nonce()), COMMAND_REFUSED);
    assert_result((const uint8_t[]){COMMAND_HELLO}, 1, COMMAND_REFUSED);
    assert_result((const uint8_t[]){0x55}, 1, COMMAND_REFUSED);
    assert_false(key_board(0)->commands.frozen);
    assert_int_equal(key_faults(0)->auth_commands, 5);
    assert_result(bytes, sign(bytes, freeze, k.key, ask_nonce()), COMMAND_OK);
    assert_true(key_board(0)->commands.frozen);
    assert_false(key_board(1)->commands.frozen);
}

static void test_each_code_once(void **state)
{
    (void)state;
    uint8_t on[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES], off[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES];
    const int length = sign(on, (command_t){.kind = COMMAND_FREEZE, .freeze = true}, k.key, ask_nonce());
    assert_result(on, length, COMMAND_OK);
    (void)sign(off, (command_t){.kind = COMMAND_FREEZE}, k.key, ask_nonce());
    assert_result(off, length, COMMAND_OK);
    assert_result(on, length, COMMAND_REFUSED);
    assert_false(key_board(0)->commands.frozen);
    const uint64_t first = ask_nonce(), second = ask_nonce();
    assert_result(on, sign(on, (command_t){.kind = COMMAND_FREEZE, .freeze = true}, k.key, first), COMMAND_REFUSED);
    assert_result(on, sign(on, (command_t){.kind = COMMAND_FREEZE, .freeze = true}, k.key, second), COMMAND_REFUSED);
    const uint64_t late = ask_nonce();
    key_run(BUS_AUTH_NONCE_US / 1000 + 100);
    assert_result(on, sign(on, (command_t){.kind = COMMAND_FREEZE, .freeze = true}, k.key, late), COMMAND_REFUSED);
    assert_false(key_board(0)->commands.frozen);
}

static void test_lost_replies_are_asked_again(void **state)
{
    (void)state;
    uint8_t bytes[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES];
    const command_t freeze = {.kind = COMMAND_FREEZE, .freeze = true};
    (void)ask_nonce(); /* lost: the operator begins again */
    const int length = sign(bytes, freeze, k.key, ask_nonce());
    assert_true(isotp_send(&link, bytes, length, room_bench_now_us(&k.room)));
    for (int i = 0; i < ROOM_BENCH_HZ; i++)
        step();
    assert_true(key_board(0)->commands.frozen);
    isotp_init(&link, CAN_ID_REPLY + NODE, CAN_ID_COMMAND + NODE); /* its reply is lost */
    assert_result(bytes, length, COMMAND_REFUSED);
    assert_result(bytes, sign(bytes, freeze, k.key, ask_nonce()), COMMAND_OK); /* done twice */
    assert_true(key_board(0)->commands.frozen);
}

static void test_bad_values_are_still_bad(void **state)
{
    (void)state;
    uint8_t bytes[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES] = {COMMAND_SESSION, 1, 2};
    const can_auth_command_t plain = {CAN_ID_COMMAND + NODE, bytes, 3, ask_nonce()};
    assert_true(can_auth_sign_command(k.key, &plain, bytes + 3));
    assert_result(bytes, 3 + CAN_AUTH_COMMAND_BYTES, COMMAND_BAD_VALUE);
    const command_t late = {.kind = COMMAND_SESSION, .session = 5, .bus_time_us = UINT64_C(1) << 48};
    assert_result(bytes, sign(bytes, late, k.key, ask_nonce()), COMMAND_BAD_VALUE);
    assert_false(key_board(0)->auth.has_session);
    const command_t session = {.kind = COMMAND_SESSION, .session = 5, .bus_time_us = 1000};
    assert_result(bytes, sign(bytes, session, k.key, ask_nonce()), COMMAND_OK);
    assert_int_equal(key_board(0)->auth.session, 5);
    assert_result((const uint8_t[]){COMMAND_NONCE, 0}, 2, COMMAND_BAD_VALUE);
    uint8_t longest[ISOTP_MAX_LENGTH] = {COMMAND_LOG};
    assert_result(longest, sizeof longest, COMMAND_REFUSED);
}

static void test_the_log_has_it(void **state)
{
    (void)state;
    uint8_t bytes[COMMAND_MAX_BYTES + CAN_AUTH_COMMAND_BYTES];
    const uint32_t before = key_board(0)->events.log.count;
    (void)ask_nonce();
    assert_int_equal(key_board(0)->events.log.count, before); /* asking for a number is nothing */
    assert_result(bytes, command_encode(bytes, &(command_t){.kind = COMMAND_FREEZE, .freeze = true}), COMMAND_REFUSED);
    const event_log_t *log = &key_board(0)->events.log;
    bool refused = false;
    for (uint32_t i = before; i < log->count; i++)
        refused |= log->entry[i].kind == EVENT_COMMAND &&
                   log->entry[i].value == COMMAND_FREEZE + EVENT_RESULT * COMMAND_REFUSED;
    assert_true(refused);
}

/* Without a key a board knows neither of the two, as before there were keys. */
static void test_without_a_key(void **state)
{
    (void)state;
    can_auth_close(k.key);
    can_auth_close(k.other);
    room_bench_close(&k.room);
    room_bench_open(&k.room, true);
    k.key = k.other = NULL;
    k.stranger = sim_bus_attach(sim_world_bus(k.room.world));
    assert_result((const uint8_t[]){COMMAND_NONCE}, 1, COMMAND_UNKNOWN);
    assert_result((const uint8_t[]){COMMAND_SESSION, 1}, 2, COMMAND_UNKNOWN);
    assert_result((const uint8_t[]){COMMAND_FREEZE, 1}, 2, COMMAND_OK);
}

#define TEST(test) cmocka_unit_test_setup_teardown(test, open_board, key_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_only_with_a_code),         TEST(test_each_code_once), TEST(test_lost_replies_are_asked_again),
        TEST(test_bad_values_are_still_bad), TEST(test_the_log_has_it), TEST(test_without_a_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
