// SPDX-License-Identifier: Apache-2.0
// Freshness on the bus: each message is good once, at its time, and for what it is.
#include "firmware/can_auth.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

#include "tests/support/auth_frames.h"

static can_auth_t *auth;

static int set_up(void **state)
{
    (void)state;
    auth = can_auth_open(&AUTH_KEY);
    return auth == NULL;
}

static int tear_down(void **state)
{
    (void)state;
    can_auth_close(auth);
    return 0;
}

static void what_was_signed_is_accepted_once(void **state)
{
    (void)state;
    const can_auth_window_t window = auth_window_at(AUTH_TIME_US);
    const hal_can_frame_t plain = auth_fd_frame();
    hal_can_frame_t fd = plain, part[3], tag;
    can_auth_stream_t stream = auth_stream_before(AUTH_TIME_US);
    assert_true(can_auth_sign_fd(auth, AUTH_FRESH, &fd));
    const hal_can_frame_t sent = fd;
    assert_int_equal(can_auth_check_fd(auth, &stream, &window, &fd), CAN_AUTH_OK);
    assert_int_equal(fd.length, CAN_AUTH_FD_PLAIN);
    assert_memory_equal(fd.data, plain.data, CAN_AUTH_FD_PLAIN);
    fd = sent;
    assert_int_equal(can_auth_check_fd(auth, &stream, &window, &fd), CAN_AUTH_REPLAYED);
    assert_int_equal(fd.length, CAN_AUTH_FD_SIGNED);

    for (int frames = 1; frames <= 3; frames++) {
        const can_auth_message_t message = {part, frames, CAN_AUTH_ID_TIME + 5};
        auth_set_frames(part);
        stream = auth_stream_before(AUTH_TIME_US);
        assert_true(can_auth_sign(auth, AUTH_FRESH, &message, &tag));
        assert_int_equal(can_auth_check(auth, &stream, &window, &message, &tag), CAN_AUTH_OK);
        assert_int_equal(can_auth_check(auth, &stream, &window, &message, &tag), CAN_AUTH_REPLAYED);
        assert_int_equal(stream.results[CAN_AUTH_OK], 1);
        assert_int_equal(stream.results[CAN_AUTH_REPLAYED], 1);
        assert_int_equal(stream.newest_us, AUTH_TIME_US);
    }
}

static void what_is_not_signed_is_other(void **state)
{
    (void)state;
    const can_auth_window_t window = auth_window_at(AUTH_TIME_US);
    can_auth_stream_t stream = auth_stream_before(AUTH_TIME_US);
    hal_can_frame_t part[3], good;
    auth_set_frames(part);
    const can_auth_message_t set = {part, 3, CAN_AUTH_ID_POSE_SET};
    assert_true(can_auth_sign(auth, AUTH_FRESH, &set, &good));
    for (int bad = 0; bad < 4; bad++) {
        hal_can_frame_t tag = good;
        tag.fd = bad == 0;
        tag.extended = bad == 1;
        tag.length = bad == 2 ? 7 : 8;
        tag.id += bad == 3;
        assert_int_equal(can_auth_check(auth, &stream, &window, &set, &tag), CAN_AUTH_OTHER);
    }
    for (int bad = 0; bad < 3; bad++) {
        hal_can_frame_t fd = auth_fd_frame();
        if (bad != 0)
            assert_true(can_auth_sign_fd(auth, AUTH_FRESH, &fd)); /* the first one stays plain */
        fd.fd = bad != 1;
        fd.extended = bad == 2;
        assert_int_equal(can_auth_check_fd(auth, &stream, &window, &fd), CAN_AUTH_OTHER);
    }
    assert_int_equal(stream.results[CAN_AUTH_OTHER], 7);
}

/* A message made at made_us, received at now_us, by both ways. */
static can_auth_result_t result_of(uint64_t made_us, uint64_t now_us, uint64_t newest_us)
{
    const can_auth_window_t window = auth_window_at(now_us);
    const can_auth_fresh_t fresh = {AUTH_SESSION, made_us};
    can_auth_stream_t stream = {.session = AUTH_SESSION, .newest_us = newest_us}, classic_stream = stream;
    hal_can_frame_t fd = auth_fd_frame(), part[3], tag;
    assert_true(can_auth_sign_fd(auth, fresh, &fd));
    const can_auth_result_t result = can_auth_check_fd(auth, &stream, &window, &fd);
    assert_int_equal(stream.newest_us, result == CAN_AUTH_OK ? made_us : newest_us);

    auth_set_frames(part);
    const can_auth_message_t set = {part, 3, CAN_AUTH_ID_POSE_SET};
    assert_true(can_auth_sign(auth, fresh, &set, &tag));
    assert_int_equal(can_auth_check(auth, &classic_stream, &window, &set, &tag), result);
    assert_int_equal(classic_stream.newest_us, stream.newest_us);
    return result;
}

static void times_must_be_right(void **state)
{
    (void)state;
    static const uint64_t nows_us[] = {200000, (1 << 24) - 3, 1 << 24, (1 << 24) + 3, 3 << 23, 0xa1b2c3d4e5f6};
    for (size_t n = 0; n < sizeof nows_us / sizeof nows_us[0]; n++) {
        const uint64_t now_us = nows_us[n];
        assert_int_equal(result_of(now_us, now_us, now_us - 1), CAN_AUTH_OK);
        assert_int_equal(result_of(now_us, now_us, now_us), CAN_AUTH_REPLAYED);
        assert_int_equal(result_of(now_us - 100000, now_us, 0), CAN_AUTH_OK);
        assert_int_equal(result_of(now_us - 100001, now_us, 0), CAN_AUTH_STALE);
        assert_int_equal(result_of(now_us - 100001, now_us, now_us), CAN_AUTH_REPLAYED);
        assert_int_equal(result_of(now_us + 5000, now_us, 0), CAN_AUTH_OK);
        assert_int_equal(result_of(now_us + 5001, now_us, 0), CAN_AUTH_EARLY);
    }
    const uint64_t most_us = (1 << 23) - 1; /* that three bytes can tell */
    assert_int_equal(result_of(AUTH_TIME_US - most_us, AUTH_TIME_US, 0), CAN_AUTH_STALE);
    assert_int_equal(result_of(AUTH_TIME_US + most_us, AUTH_TIME_US, 0), CAN_AUTH_EARLY);
    assert_int_equal(result_of(2 * most_us, 200000, 0), CAN_AUTH_EARLY); /* no time is negative */
}

static void senders_never_repeat_a_time(void **state)
{
    (void)state;
    can_auth_fresh_t fresh = {AUTH_SESSION, 100};
    can_auth_fresh_step(&fresh, 500);
    assert_int_equal(fresh.time_us, 500);
    can_auth_fresh_step(&fresh, 500);
    assert_int_equal(fresh.time_us, 501);
    can_auth_fresh_step(&fresh, 400);
    assert_int_equal(fresh.time_us, 502);
    assert_int_equal(fresh.session, AUTH_SESSION);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_signed_is_accepted_once),
        cmocka_unit_test(what_is_not_signed_is_other),
        cmocka_unit_test(times_must_be_right),
        cmocka_unit_test(senders_never_repeat_a_time),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
