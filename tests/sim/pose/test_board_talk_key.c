// SPDX-License-Identifier: Apache-2.0
// Tests of talks with boards that have a key: numbers that they give, and codes for them.
#include "tests/sim/pose/board_scene.h"
#include "tests/support/auth_frames.h"

static const char nonce_reply[] = "\x88\x00\x01\x02\x03\x04\x05\x06\x07\x08";
static const uint64_t nonce = 0x0807060504030201;

/* A talk with a key, about a freeze. Is the newest request one with the code for that number? */
static board_talk_t talk_with_key(void)
{
    can_auth_t *auth = can_auth_open(&AUTH_KEY);
    board_talk_t talk = {.node = NODE, .request = {.kind = COMMAND_FREEZE, .freeze = true}, .auth = auth};
    assert_non_null(auth);
    scene.one_each = true;
    assert_true(talk_to(&talk, 1));
    if (scene.newest == 2 + CAN_AUTH_COMMAND_BYTES) {
        const can_auth_command_t plain = {CAN_ID_COMMAND + NODE, scene.request, 2, nonce};
        assert_memory_equal(scene.request, "\x03\x01", 2);
        assert_true(can_auth_check_command(auth, &plain, scene.request + 2));
    }
    can_auth_close(auth);
    return talk;
}

static void test_codes_are_made_for_the_number_given(void **state)
{
    (void)state;
    add_reply("\x83\x00", 2);
    add_reply(nonce_reply, 10);
    const board_talk_t talk = talk_with_key();
    assert_true(talk.replied);
    assert_false(talk.keyless);
    assert_int_equal(talk.result, COMMAND_OK);
    assert_int_equal(scene.requests, 2);
    assert_int_equal(scene.newest, 2 + CAN_AUTH_COMMAND_BYTES);
}

static void test_refused_codes_and_lost_replies_are_tried_again(void **state)
{
    (void)state;
    add_reply("\x83\x00", 2);
    add_reply(nonce_reply, 10);
    add_reply("\x83\x03", 2); /* another has asked for a number meanwhile */
    add_reply(nonce_reply, 10);
    const board_talk_t refused = talk_with_key();
    assert_true(refused.replied && refused.result == COMMAND_OK);
    assert_int_equal(scene.requests, 4);
    close_scene(NULL);
    open_scene(NULL);
    add_reply("\x83\x00", 2);
    add_reply(nonce_reply, 10);
    add_reply("", 0);
    add_reply(nonce_reply, 10);
    const board_talk_t lost = talk_with_key();
    assert_true(lost.replied && lost.result == COMMAND_OK);
    assert_int_equal(scene.requests, 4);
}

static void test_boards_without_a_key_do_nothing(void **state)
{
    (void)state;
    add_reply("\x88\x01", 2);
    const board_talk_t talk = talk_with_key();
    assert_true(talk.replied && talk.keyless);
    assert_int_equal(scene.requests, 1);
    assert_int_equal(scene.newest, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_codes_are_made_for_the_number_given, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_refused_codes_and_lost_replies_are_tried_again, open_scene, close_scene),
        cmocka_unit_test_setup_teardown(test_boards_without_a_key_do_nothing, open_scene, close_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
