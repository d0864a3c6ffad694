// SPDX-License-Identifier: Apache-2.0
// Tests of the service manager's messages, with a socket in systemd's place.
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmocka.h>

#include "hal/linux/service_systemd.h"
#include "tests/support/scratch.h"

enum { MESSAGE_LENGTH = 640, FLOOD = 4096 };

/* systemd's side. */
typedef struct {
    scratch_t scratch;
    int socket;
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_service_t *service;
} manager_t;

static manager_t manager;

/* Listen where a path, or @name in the abstract namespace, says, and tell the environment. */
static void listen_at(const char *path)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    const size_t length = strlen(path);
    assert_true(length < sizeof address.sun_path);
    memcpy(address.sun_path, path, length);
    if (path[0] == '@')
        address.sun_path[0] = '\0';
    manager.socket = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    assert_true(manager.socket >= 0);
    assert_int_equal(bind(manager.socket, (const struct sockaddr *)&address,
                          (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length)),
                     0);
    setenv("NOTIFY_SOCKET", path, 1);
}

static void open_service(void)
{
    assert_int_equal(service_systemd_open(&manager.service, manager.error), HAL_OK);
    assert_non_null(manager.service);
}

static void expect_message(const char *message)
{
    char got[MESSAGE_LENGTH];
    const ssize_t length = recv(manager.socket, got, sizeof got - 1, 0);
    if (length < 0)
        fail_msg("no message, expected %s", message);
    got[length] = '\0';
    assert_string_equal(got, message);
}

static void expect_silence(void)
{
    char got[MESSAGE_LENGTH];
    assert_int_equal(recv(manager.socket, got, sizeof got, 0), -1);
    assert_int_equal(errno, EAGAIN);
}

static void report(int64_t now_us, const char *state, bool showing, bool healthy)
{
    const hal_service_report_t report = {now_us, state, showing, healthy};
    hal_service_report(manager.service, &report);
}

static int set_up(void **state)
{
    char *folder, path[SCRATCH_PATH_LENGTH];
    (void)state;
    scratch_open(&manager.scratch);
    folder = realpath(manager.scratch.folder, NULL); /* systemd's names are absolute */
    assert_non_null(folder);
    snprintf(path, sizeof path, "%s/notify", folder);
    free(folder);
    unsetenv("WATCHDOG_USEC");
    unsetenv("WATCHDOG_PID");
    listen_at(path);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    service_systemd_close(manager.service);
    manager.service = NULL;
    close(manager.socket);
    scratch_close(&manager.scratch);
    return 0;
}

static void test_nobody_to_tell(void **state)
{
    (void)state;
    unsetenv("NOTIFY_SOCKET");
    manager.service = (hal_service_t *)&manager;
    assert_int_equal(service_systemd_open(&manager.service, manager.error), HAL_OK);
    assert_null(manager.service);
    report(0, "running", true, true);
    expect_silence();
}

static void test_ready_and_state_are_told_once(void **state)
{
    (void)state;
    open_service();
    report(0, "waiting", false, true);
    expect_message("STATUS=waiting");
    expect_silence();
    report(1, "waiting", true, true);
    expect_message("READY=1");
    report(2, "running", true, true);
    expect_message("STATUS=running");
    report(3, "running", true, true);
    expect_silence();
    service_systemd_close(manager.service);
    manager.service = NULL;
    expect_message("STOPPING=1");
}

static void test_a_long_state_is_told_whole(void **state)
{
    char text[512], message[sizeof text + sizeof "STATUS="];
    (void)state;
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    (void)snprintf(message, sizeof message, "STATUS=%s", text);
    open_service();
    report(0, text, false, true);
    expect_message(message);
}

static void test_life_is_told_four_times_a_period(void **state)
{
    (void)state;
    setenv("WATCHDOG_USEC", "2000000", 1);
    open_service();
    report(1000000, "running", false, true);
    expect_message("STATUS=running");
    expect_message("WATCHDOG=1");
    report(1499999, "running", false, true);
    expect_silence();
    report(1500000, "running", false, true);
    expect_message("WATCHDOG=1");
    report(9000000, "running", false, false);
    expect_silence();
    report(9000001, "running", false, true);
    expect_message("WATCHDOG=1");
}

static void test_a_watchdog_of_another_process_is_not_fed(void **state)
{
    (void)state;
    setenv("WATCHDOG_USEC", "2000000", 1);
    setenv("WATCHDOG_PID", "1", 1);
    open_service();
    report(0, "running", false, true);
    expect_message("STATUS=running");
    expect_silence();
}

static void test_the_abstract_namespace(void **state)
{
    char name[64];
    (void)state;
    close(manager.socket);
    snprintf(name, sizeof name, "@wallwarp-test-%ld", (long)getpid());
    listen_at(name);
    open_service();
    report(0, "safe", false, true);
    expect_message("STATUS=safe");
}

/* The queue of a socket that nobody reads is full after some messages: no call waits, and what was lost is told later.
 */
static void test_a_busy_manager_is_not_waited_for(void **state)
{
    (void)state;
    setenv("WATCHDOG_USEC", "4", 1);
    open_service();
    alarm(20); /* a call that waits would wait for ever */
    for (int i = 0; i < FLOOD; i++)
        report(i, "running", false, true);
    report(FLOOD, "fault", true, true);
    alarm(0);
    char got[MESSAGE_LENGTH];
    int waiting = 0;
    for (; recv(manager.socket, got, sizeof got, 0) >= 0; waiting++)
        assert_true(waiting < FLOOD);
    report(FLOOD, "fault", true, false);
    expect_message("READY=1");
    expect_message("STATUS=fault");
    expect_silence();
}

static void test_a_manager_that_is_gone_is_no_fault(void **state)
{
    (void)state;
    open_service();
    close(manager.socket);
    manager.socket = -1;
    report(0, "running", true, true);
}

static void test_wrong_names_are_refused(void **state)
{
    char path[200];
    const char *const wrong[] = {"", "run/notify", path};
    (void)state;
    memset(path, 'x', sizeof path);
    path[0] = '/';
    path[sizeof path - 1] = '\0';
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        hal_service_t *const before = (hal_service_t *)&manager;
        hal_service_t *service = before;
        setenv("NOTIFY_SOCKET", wrong[i], 1);
        assert_int_equal(service_systemd_open(&service, manager.error), HAL_IO);
        assert_ptr_equal(service, before);
        assert_non_null(strstr(manager.error, "NOTIFY_SOCKET"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_nobody_to_tell, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_ready_and_state_are_told_once, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_long_state_is_told_whole, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_life_is_told_four_times_a_period, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_watchdog_of_another_process_is_not_fed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_the_abstract_namespace, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_busy_manager_is_not_waited_for, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_manager_that_is_gone_is_no_fault, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_wrong_names_are_refused, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
