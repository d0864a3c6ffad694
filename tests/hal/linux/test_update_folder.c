// SPDX-License-Identifier: Apache-2.0
// Tests of the update agent behind its folder, with this test in the agent's place.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "hal/linux/update_folder.h"
#include "tests/support/rng.h"
#include "tests/support/scratch.h"

enum { PROPERTY_SEED = 20261122, PROPERTY_CASES = 20000, TEXT_BYTES = 120 };

static struct {
    scratch_t scratch;
    char state[SCRATCH_PATH_LENGTH], request[SCRATCH_PATH_LENGTH];
    hal_update_t *update;
} agent;

static int open_agent(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    scratch_open(&agent.scratch);
    scratch_path(&agent.scratch, "state", agent.state);
    scratch_path(&agent.scratch, "request", agent.request);
    assert_int_equal(update_folder_open(&agent.update, agent.scratch.folder, error), HAL_OK);
    assert_string_equal(error, "");
    return 0;
}

static int close_agent(void **state)
{
    (void)state;
    update_folder_close(agent.update);
    scratch_close(&agent.scratch);
    return 0;
}

static void say(const char *text)
{
    scratch_write(agent.state, text, strlen(text));
}

static void expect_request(const char *expected)
{
    size_t length = 0;
    uint8_t *bytes = scratch_read(agent.request, &length);
    assert_int_equal(length, strlen(expected));
    assert_memory_equal(bytes, expected, length);
    free(bytes);
    assert_int_equal(unlink(agent.request), 0);
}

static void test_state_is_read(void **state)
{
    (void)state;
    hal_update_state_t read;
    say("state=installing\nprogress=37\nrunning=0.5\nslot=B\ntrial=1\nlater=x\nwaiting=\nother=0.4\nmessage=a=b\x01\n");
    assert_int_equal(hal_update_state(agent.update, &read), HAL_OK);
    assert_int_equal(read.doing, HAL_UPDATE_INSTALLING);
    assert_int_equal(read.progress, 37);
    assert_int_equal(read.slot, 'B');
    assert_true(read.trial);
    assert_string_equal(read.running, "0.5");
    assert_string_equal(read.waiting, "");
    assert_string_equal(read.other, "0.4");
    assert_string_equal(read.message, "a=b?");
    say("state=ready\nwaiting=0.6-rc1");
    assert_int_equal(hal_update_state(agent.update, &read), HAL_OK);
    assert_int_equal(read.doing, HAL_UPDATE_READY);
    assert_int_equal(read.slot, '?');
    assert_string_equal(read.waiting, "0.6-rc1");
    assert_string_equal(read.other, "0.6-rc1");
    assert_false(read.trial);
    say("state=failed\nwaiting=0.6\n");
    assert_int_equal(hal_update_state(agent.update, &read), HAL_OK);
    assert_string_equal(read.other, "0.6");
}

static void assert_untouched(const hal_update_state_t *read)
{
    assert_int_equal(read->progress, 77);
    assert_string_equal(read->running, "untouched");
}

static void test_bad_states_change_nothing(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "",
        "progress=3\n",
        "state=\n",
        "state=Idle\n",
        "state=idle \n",
        "state=idle\nprogress=101\n",
        "state=idle\nprogress=-1\n",
        "state=idle\nprogress=\n",
        "state=idle\nprogress=0000\n",
        "state=idle\nslot=C\n",
        "state=idle\nslot=AB\n",
        "state=idle\ntrial=2\n",
        "state=idle\nrunning=a b\n",
        "state=idle\nwaiting=123456789012345678901234567890123\n",
        "state=ready\nwaiting=\xC3\xA4\n",
    };
    hal_update_state_t read = {.progress = 77, .running = "untouched"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        say(bad[i]);
        if (hal_update_state(agent.update, &read) != HAL_IO)
            fail_msg("taken: %s", bad[i]);
        assert_untouched(&read);
    }
    scratch_write(agent.state, "state=idle\nrunning=\0\n", 21);
    assert_int_equal(hal_update_state(agent.update, &read), HAL_IO);
    char *much = malloc(UPDATE_STATE_BYTES + 1);
    assert_non_null(much);
    memset(much, '\n', UPDATE_STATE_BYTES + 1);
    memcpy(much, "state=idle", 10);
    scratch_write(agent.state, much, UPDATE_STATE_BYTES + 1);
    assert_int_equal(hal_update_state(agent.update, &read), HAL_IO);
    assert_untouched(&read);
    scratch_write(agent.state, much, UPDATE_STATE_BYTES);
    assert_int_equal(hal_update_state(agent.update, &read), HAL_OK);
    free(much);
}

static void test_long_message_is_cut(void **state)
{
    (void)state;
    hal_update_state_t read;
    for (int length = HAL_UPDATE_MESSAGE_LENGTH - 2; length < 300; length++) {
        char text[400] = "state=failed\nmessage=";
        memset(text + strlen(text), 'm', (size_t)length);
        assert_true(update_folder_read_state(&read, text));
        assert_int_equal(strlen(read.message),
                         length < HAL_UPDATE_MESSAGE_LENGTH ? length : HAL_UPDATE_MESSAGE_LENGTH - 1);
    }
}

static void test_no_agent(void **state)
{
    (void)state;
    hal_update_state_t read = {.progress = 77, .running = "untouched"};
    assert_int_equal(hal_update_state(agent.update, &read), HAL_EMPTY);
    assert_int_equal(hal_update_install(agent.update, "usb"), HAL_EMPTY);
    assert_int_equal(hal_update_switch(NULL), HAL_EMPTY);
    assert_int_equal(hal_update_good(NULL), HAL_EMPTY);
    assert_int_equal(hal_update_state(NULL, &read), HAL_EMPTY);
    assert_untouched(&read);
    assert_int_equal(access(agent.request, F_OK), -1);
}

static void test_what_is_no_file_does_not_block(void **state)
{
    (void)state;
    hal_update_state_t read = {.progress = 77, .running = "untouched"};
    char elsewhere[SCRATCH_PATH_LENGTH];
    scratch_path(&agent.scratch, "elsewhere", elsewhere);
    assert_int_equal(mkfifo(agent.state, 0600), 0);
    assert_int_equal(hal_update_state(agent.update, &read), HAL_IO);
    assert_int_equal(unlink(agent.state), 0);
    assert_int_equal(mkdir(agent.state, 0700), 0);
    assert_int_equal(hal_update_state(agent.update, &read), HAL_IO);
    assert_int_equal(rmdir(agent.state), 0);
    scratch_write(elsewhere, "state=idle\n", 11);
    assert_int_equal(symlink(elsewhere, agent.state), 0);
    assert_int_equal(hal_update_state(agent.update, &read), HAL_IO);
    assert_untouched(&read);
}

static void test_one_request_at_a_time(void **state)
{
    (void)state;
    hal_update_state_t read;
    say("state=idle\n");
    assert_int_equal(hal_update_install(agent.update, "http://10.0.0.1/wallwarp-rpi4.raucb"), HAL_OK);
    assert_int_equal(hal_update_switch(agent.update), HAL_FULL);
    assert_int_equal(hal_update_state(agent.update, &read), HAL_FULL);
    expect_request("install http://10.0.0.1/wallwarp-rpi4.raucb\n");
    assert_int_equal(hal_update_state(agent.update, &read), HAL_OK);
    assert_int_equal(hal_update_switch(agent.update), HAL_OK);
    expect_request("switch\n");
    assert_int_equal(hal_update_good(agent.update), HAL_OK);
    assert_int_equal(hal_update_install(agent.update, "/a.raucb"), HAL_FULL);
    expect_request("good\n");
    assert_int_equal(hal_update_good(agent.update), HAL_OK); /* nothing of the longer one is left */
    expect_request("good\n");
}

static void test_folder_that_can_not_be_written(void **state)
{
    (void)state;
    char draft[SCRATCH_PATH_LENGTH];
    say("state=idle\n");
    scratch_path(&agent.scratch, "request.new", draft);
    assert_int_equal(symlink("nowhere", draft), 0);
    assert_int_equal(hal_update_switch(agent.update), HAL_IO);
    assert_int_equal(access(agent.request, F_OK), -1);
}

static void test_sources(void **state)
{
    (void)state;
    static const char *const good[] = {"usb", "/a", "http://x", "https://x/%20?y=1"};
    static const char *const bad[] = {"", "usb2", "a", "ftp://x", "/a b", "/a\n", "/\x7F", "http:/x", "/\xC3\xA4"};
    char text[HAL_UPDATE_SOURCE_LENGTH + 1] = "/";
    say("state=idle\n");
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        assert_true(hal_update_is_source(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_false(hal_update_is_source(bad[i]));
        assert_int_equal(hal_update_install(agent.update, bad[i]), HAL_BAD_CALL);
    }
    memset(text, '/', HAL_UPDATE_SOURCE_LENGTH - 1);
    assert_true(hal_update_is_source(text));
    text[HAL_UPDATE_SOURCE_LENGTH - 1] = '/';
    assert_false(hal_update_is_source(text));
    assert_false(hal_update_is_version(""));
}

static void test_folder_with_a_long_name(void **state)
{
    (void)state;
    char name[202], error[HAL_BOARD_ERROR_LENGTH] = "";
    hal_update_t *update = NULL;
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assert_int_equal(update_folder_open(&update, name, error), HAL_IO);
    assert_null(update);
    assert_non_null(strstr(error, "too long"));
}

/* Pieces of states in any order: whatever is read has values in their ranges. */
static void test_any_text(void **state)
{
    (void)state;
    static const char *const piece[] = {"state=",
                                        "idle",
                                        "ready",
                                        "\n",
                                        "progress=",
                                        "100",
                                        "9",
                                        "slot=",
                                        "A",
                                        "trial=",
                                        "1",
                                        "running=",
                                        "waiting=",
                                        "other=",
                                        "message=",
                                        "=",
                                        "\x80",
                                        "0.6",
                                        "abcdefghijklmnopqrstuvwxyz",
                                        " "};
    rng_t random = {PROPERTY_SEED};
    int taken = 0;
    for (int i = 0; i < PROPERTY_CASES; i++) {
        char text[TEXT_BYTES + 32] = "state=ready\n";
        hal_update_state_t read = {.doing = HAL_UPDATE_DOINGS};
        while (strlen(text) < (size_t)(i % TEXT_BYTES))
            strcat(text, piece[rng_int(&random, 0, (int64_t)(sizeof piece / sizeof piece[0]) - 1)]);
        if (!update_folder_read_state(&read, text))
            continue;
        taken++;
        const bool versions = (read.running[0] == '\0' || hal_update_is_version(read.running)) &&
                              (read.waiting[0] == '\0' || hal_update_is_version(read.waiting)) &&
                              (read.other[0] == '\0' || hal_update_is_version(read.other));
        if ((unsigned)read.doing >= HAL_UPDATE_DOINGS || read.progress < 0 || read.progress > 100 || !versions)
            fail_msg("seed %d, case %d: %s", PROPERTY_SEED, i, text);
    }
    assert_true(taken > PROPERTY_CASES / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_state_is_read, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_bad_states_change_nothing, open_agent, close_agent),
        cmocka_unit_test(test_long_message_is_cut),
        cmocka_unit_test_setup_teardown(test_no_agent, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_what_is_no_file_does_not_block, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_one_request_at_a_time, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_folder_that_can_not_be_written, open_agent, close_agent),
        cmocka_unit_test_setup_teardown(test_sources, open_agent, close_agent),
        cmocka_unit_test(test_folder_with_a_long_name),
        cmocka_unit_test(test_any_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
