// SPDX-License-Identifier: Apache-2.0
// Tests of how a board tells its update: the message, and the reply to a request.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/update_status.h"
#include "tests/support/rng.h"

enum { PROPERTY_SEED = 71122, PROPERTY_CASES = 20000 };

static const can_update_t MESSAGE = {.node = 63,
                                     .counter = 14,
                                     .state = CAN_UPDATE_SWITCHING,
                                     .progress = 100,
                                     .slot = 2,
                                     .trial = true,
                                     .plan = UPDATE_CONFIRMED,
                                     .running = 0xFEDC,
                                     .waiting = 0x1234};

static const update_status_t STATUS = {.state = CAN_UPDATE_READY,
                                       .progress = 99,
                                       .slot = 'B',
                                       .trial = true,
                                       .knows_time = true,
                                       .plan = UPDATE_PROMISED,
                                       .bus_time_us = 0x123456789ABC,
                                       .switch_bus_us = 0xFEDCBA987654,
                                       .running = "0.5",
                                       .waiting = "0.6",
                                       .other = "0.7",
                                       .message = "all is well"};

static void test_message_comes_back(void **state)
{
    (void)state;
    hal_can_frame_t frame;
    can_update_t got;
    assert_true(can_update_encode(&frame, &MESSAGE));
    assert_int_equal(frame.id, 0x6BF);
    assert_int_equal(can_update_decode(&got, &frame), CAN_CHECK_OK);
    assert_int_equal(got.node, MESSAGE.node);
    assert_int_equal(got.counter, MESSAGE.counter);
    assert_int_equal(got.state, MESSAGE.state);
    assert_int_equal(got.progress, MESSAGE.progress);
    assert_int_equal(got.slot, MESSAGE.slot);
    assert_int_equal(got.trial, MESSAGE.trial);
    assert_int_equal(got.plan, MESSAGE.plan);
    assert_int_equal(got.running, MESSAGE.running);
    assert_int_equal(got.waiting, MESSAGE.waiting);
    can_update_t bad[6] = {MESSAGE, MESSAGE, MESSAGE, MESSAGE, MESSAGE, MESSAGE};
    bad[0].node = 0;
    bad[1].counter = 15;
    bad[2].state = CAN_UPDATE_STATES;
    bad[3].progress = 101;
    bad[4].slot = 3;
    bad[5].plan = UPDATE_PLANS;
    for (int i = 0; i < 6; i++)
        assert_false(can_update_encode(&frame, &bad[i]));
}

static void test_message_of_no_legal_value(void **state)
{
    (void)state;
    static const struct {
        int byte;
        uint8_t value;
    } bad[] = {{1, 0x6E}, {2, 101}, {3, 3}, {3, 12}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        hal_can_frame_t frame;
        can_update_t got = {.node = 77};
        assert_true(can_update_encode(&frame, &MESSAGE));
        frame.data[bad[i].byte] = bad[i].value;
        assert_int_equal(can_update_decode(&got, &frame), CAN_CHECK_CRC);
        frame.data[0] = can_e2e_p01_crc((uint16_t)frame.id, frame.data, frame.length);
        assert_int_equal(can_update_decode(&got, &frame), CAN_CHECK_VALUE);
        assert_int_equal(got.node, 77);
    }
}

static void test_fingerprints(void **state)
{
    (void)state;
    assert_int_equal(can_update_fingerprint(""), 0);
    uint8_t bytes[2 + 9] = {0};
    memcpy(bytes + 2, "123456789", 9);
    assert_int_equal(can_update_fingerprint("123456789"), can_e2e_p05_crc(0, bytes, sizeof bytes));
    assert_int_not_equal(can_update_fingerprint("0.5"), can_update_fingerprint("0.6"));
}

static void test_states_are_those_of_the_agent(void **state)
{
    (void)state;
    update_t update = {.agent = false};
    assert_int_equal(can_update_state_of(&update), CAN_UPDATE_NO_AGENT);
    update.agent = true;
    update.said.doing = HAL_UPDATE_IDLE;
    assert_string_equal(can_update_state_name(can_update_state_of(&update)), "idle");
    update.said.doing = HAL_UPDATE_SWITCHING;
    assert_string_equal(can_update_state_name(can_update_state_of(&update)), "switching");
    assert_string_equal(can_update_state_name(CAN_UPDATE_STATES), "unknown");
}

static void assert_same(const update_status_t *a, const update_status_t *b)
{
    assert_int_equal(a->state, b->state);
    assert_int_equal(a->progress, b->progress);
    assert_int_equal(a->slot, b->slot);
    assert_int_equal(a->trial, b->trial);
    assert_int_equal(a->knows_time, b->knows_time);
    assert_int_equal(a->plan, b->plan);
    assert_int_equal(a->bus_time_us, b->bus_time_us);
    assert_int_equal(a->switch_bus_us, b->switch_bus_us);
    assert_string_equal(a->running, b->running);
    assert_string_equal(a->waiting, b->waiting);
    assert_string_equal(a->other, b->other);
    assert_string_equal(a->message, b->message);
}

static void test_reply_comes_back(void **state)
{
    (void)state;
    uint8_t bytes[UPDATE_STATUS_BYTES];
    update_status_t got = {.progress = 77}, full = STATUS;
    assert_int_equal(update_status_encode(bytes, &STATUS), 20 + 4 + 4 + 4 + 12);
    assert_int_equal(bytes[0], 3);
    assert_int_equal(bytes[3], 1 + 2 + 16);
    assert_true(update_status_decode(&got, bytes, 20 + 4 + 4 + 4 + 12));
    assert_same(&got, &STATUS);
    memset(full.running, 'r', sizeof full.running - 1);
    memset(full.waiting, 'w', sizeof full.waiting - 1);
    memset(full.other, 'o', sizeof full.other - 1);
    memset(full.message, 'm', sizeof full.message - 1);
    const int length = update_status_encode(bytes, &full);
    assert_in_range(length, 1, UPDATE_STATUS_BYTES);
    assert_true(update_status_decode(&got, bytes, length));
    assert_same(&got, &full);
}

static void test_bad_replies_change_nothing(void **state)
{
    (void)state;
    uint8_t bytes[UPDATE_STATUS_BYTES];
    update_status_t got = {.progress = 77};
    const int length = update_status_encode(bytes, &STATUS);
    for (int i = 0; i < length; i++)
        assert_false(update_status_decode(&got, bytes, i));
    static const struct {
        int byte;
        uint8_t value;
    } bad[] = {{0, CAN_UPDATE_STATES}, {1, 101}, {3, 0x30}, {20, 33}, {32, 200}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        (void)update_status_encode(bytes, &STATUS);
        bytes[bad[i].byte] = bad[i].value;
        if (update_status_decode(&got, bytes, length))
            fail_msg("byte %d may be %u", bad[i].byte, (unsigned)bad[i].value);
    }
    assert_int_equal(got.progress, 77);
}

/* Whatever a board sends: numbers are in their ranges, and texts can be printed. */
static void test_any_reply(void **state)
{
    (void)state;
    rng_t random = {PROPERTY_SEED};
    int taken = 0;
    for (int i = 0; i < PROPERTY_CASES; i++) {
        uint8_t bytes[UPDATE_STATUS_BYTES];
        update_status_t got;
        const int length = update_status_encode(bytes, &STATUS);
        for (int64_t k = rng_int(&random, 0, 6); k > 0; k--)
            bytes[rng_int(&random, 0, length - 1)] = (uint8_t)rng_int(&random, 0, 255);
        if (!update_status_decode(&got, bytes, (int)rng_int(&random, length - 4, length)))
            continue;
        taken++;
        bool good = (unsigned)got.state < CAN_UPDATE_STATES && got.progress >= 0 && got.progress <= 100 &&
                    (unsigned)got.plan < UPDATE_PLANS && strchr("AB?", got.slot) != NULL;
        for (const char *c = got.message; *c != '\0'; c++)
            good = good && *c >= ' ' && *c <= '~';
        if (!good)
            fail_msg("seed %d, case %d", PROPERTY_SEED, i);
    }
    assert_in_range(taken, PROPERTY_CASES / 50, PROPERTY_CASES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_message_comes_back), cmocka_unit_test(test_message_of_no_legal_value),
        cmocka_unit_test(test_fingerprints),       cmocka_unit_test(test_states_are_those_of_the_agent),
        cmocka_unit_test(test_reply_comes_back),   cmocka_unit_test(test_bad_replies_change_nothing),
        cmocka_unit_test(test_any_reply),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
