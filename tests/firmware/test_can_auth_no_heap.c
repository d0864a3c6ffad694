// SPDX-License-Identifier: Apache-2.0
// Authentication takes nothing from the heap once it is open: it runs in the loop.
#include "firmware/can_auth.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/support/auth_frames.h"
#include "tests/support/heap_trap.h"

static void no_message_allocates(void **state)
{
    (void)state;
    can_auth_t *auth = can_auth_open(&AUTH_KEY);
    can_auth_stream_t stream = auth_stream_before(AUTH_TIME_US), set_stream = stream;
    const can_auth_window_t window = auth_window_at(AUTH_TIME_US);
    hal_can_frame_t fd = auth_fd_frame(), part[3], tag;
    auth_set_frames(part);
    const can_auth_message_t set = {part, 3, CAN_AUTH_ID_POSE_SET};
    const can_auth_command_t command = {0x600, part[0].data, 8, 1};
    uint8_t code[CAN_AUTH_COMMAND_BYTES];
    assert_non_null(auth);
    heap_trap_calls = 0;
    heap_trap_set = true;
    const bool made = can_auth_sign_fd(auth, AUTH_FRESH, &fd) && can_auth_sign(auth, AUTH_FRESH, &set, &tag) &&
                      can_auth_sign_command(auth, &command, code);
    const bool good = can_auth_check_fd(auth, &stream, &window, &fd) == CAN_AUTH_OK &&
                      can_auth_check(auth, &set_stream, &window, &set, &tag) == CAN_AUTH_OK &&
                      can_auth_check_command(auth, &command, code);
    tag.data[7] ^= 1;
    const bool refused = can_auth_check(auth, &set_stream, &window, &set, &tag) == CAN_AUTH_FORGED;
    heap_trap_set = false;
    assert_true(made && good && refused);
    assert_int_equal(heap_trap_calls, 0);
    can_auth_close(auth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heap_trap_works),
        cmocka_unit_test(no_message_allocates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
