// SPDX-License-Identifier: Apache-2.0
// Locked memory and real-time priority: given to who may have them; else a line that says which setting is missing.
#include "hal/linux/realtime_linux.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <linux/capability.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

/* How much of this process is locked. */
static long locked_kb(void)
{
    char line[128];
    long kb = -1;
    FILE *status = fopen("/proc/self/status", "r");
    assert_non_null(status);
    while (fgets(line, sizeof line, status) != NULL)
        if (sscanf(line, "VmLck: %ld kB", &kb) == 1)
            break;
    fclose(status);
    return kb;
}

static void no_priority_asks_for_nothing(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    assert_int_equal(realtime_linux_open(0, error), HAL_OK);
    assert_int_equal(locked_kb(), 0);
    realtime_linux_close();
}

static void impossible_priorities_are_refused(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    assert_int_equal(realtime_linux_open(100, error), HAL_IO);
    assert_memory_equal(error, "realtime: no right to priority 100 (Invalid argument)", 52);
    assert_int_equal(locked_kb(), 0);
}

/* The super-user may; then both are given, and the scheduler is left as it was. */
static void who_may_gets_both(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    const int policy = sched_getscheduler(0);
    const hal_status_t status = realtime_linux_open(50, error);
    assert_int_equal(sched_getscheduler(0), policy);
    if (status == HAL_OK) {
        assert_true(locked_kb() > 0);
        realtime_linux_close();
    } else {
        assert_memory_equal(error, "realtime: ", 10);
    }
    assert_int_equal(locked_kb(), 0);
}

/* Take this process what lets it pass a limit, and lower the limit. */
static bool take_right(unsigned capability, __rlimit_resource_t limit, rlim_t to)
{
    struct __user_cap_header_struct header = {.version = _LINUX_CAPABILITY_VERSION_3};
    struct __user_cap_data_struct sets[_LINUX_CAPABILITY_U32S_3];
    const struct rlimit lowered = {to, to};
    if (setrlimit(limit, &lowered) != 0 || syscall(SYS_capget, &header, sets) != 0)
        return false;
    sets[0].effective &= ~(UINT32_C(1) << capability);
    return syscall(SYS_capset, &header, sets) == 0;
}

/* Of a process of its own without that right. */
static void line_without(unsigned capability, __rlimit_resource_t limit, rlim_t to, char line[HAL_BOARD_ERROR_LENGTH])
{
    int pipe_ends[2], status;
    assert_int_equal(pipe(pipe_ends), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        char error[HAL_BOARD_ERROR_LENGTH] = "";
        const bool refused = take_right(capability, limit, to) && realtime_linux_open(50, error) == HAL_IO;
        const ssize_t written = write(pipe_ends[1], error, sizeof error);
        _exit(refused && written == sizeof error ? 0 : 1);
    }
    close(pipe_ends[1]);
    assert_int_equal(read(pipe_ends[0], line, HAL_BOARD_ERROR_LENGTH), HAL_BOARD_ERROR_LENGTH);
    close(pipe_ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

static void missing_rights_are_told(void **state)
{
    (void)state;
    char line[HAL_BOARD_ERROR_LENGTH], error[HAL_BOARD_ERROR_LENGTH];
    line_without(CAP_SYS_NICE, RLIMIT_RTPRIO, 0, line);
    assert_string_equal(line, "realtime: no right to priority 50 (Operation not permitted), the limit is 0: "
                              "`ulimit -r 50`, or LimitRTPRIO=50 in the service, or CAP_SYS_NICE");
    if (realtime_linux_open(50, error) != HAL_OK)
        return; /* without the first right, the second is not asked for */
    realtime_linux_close();
    line_without(CAP_IPC_LOCK, RLIMIT_MEMLOCK, 65536, line);
    assert_string_equal(line, "realtime: memory can't be locked (Cannot allocate memory), the limit is 64 KB: "
                              "`ulimit -l unlimited`, or LimitMEMLOCK=infinity in the service, or CAP_IPC_LOCK");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_priority_asks_for_nothing),
        cmocka_unit_test(impossible_priorities_are_refused),
        cmocka_unit_test(who_may_gets_both),
        cmocka_unit_test(missing_rights_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
