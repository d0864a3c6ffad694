// SPDX-License-Identifier: Apache-2.0
// The clock is CLOCK_MONOTONIC in microseconds.
#include "hal/linux/time_linux.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <time.h>

static int64_t monotonic_us(void)
{
    struct timespec now;
    assert_int_equal(clock_gettime(CLOCK_MONOTONIC, &now), 0);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static void readings_lie_between_those_of_the_system(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_time_t *clock;
    assert_int_equal(time_linux_open(&clock, error), HAL_OK);
    for (int i = 0; i < 1000; i++) {
        const int64_t before_us = monotonic_us();
        const int64_t now_us = hal_time_now_us(clock);
        assert_true(before_us <= now_us && now_us <= monotonic_us());
    }
    time_linux_close(clock);
    time_linux_close(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(readings_lie_between_those_of_the_system)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
