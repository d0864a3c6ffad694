// SPDX-License-Identifier: Apache-2.0
// What a CAN interface of Linux may do meanwhile, as the super-user does it to a virtual one: check_can INTERFACE
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/timex.h>
#include <time.h>
#include <unistd.h>

#include "hal/linux/can_socketcan.h"

enum { PATIENCE = 400, PATIENCE_US = 5000, KEPT = 256 };

static const char *interface;

/* A command of the shell, in which $CAN is the interface. */
static void run(const char *command)
{
    if (system(command) != 0)
        fail_msg("failed: %s", command);
}

static hal_can_t *open_can(void)
{
    const can_socketcan_settings_t settings = {interface, 500000, 2000000, true};
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_can_t *can;
    if (can_socketcan_open(&can, &settings, error) != HAL_OK)
        fail_msg("%s", error);
    return can;
}

static void assert_refused(bool fd, const char *line)
{
    const can_socketcan_settings_t settings = {interface, 500000, 2000000, fd};
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    hal_can_t *can;
    assert_int_equal(can_socketcan_open(&can, &settings, error), HAL_IO);
    assert_string_equal(error, line);
}

/* Receive until that comes out, and frames of no other kind than data frames pass by. */
static hal_can_frame_t receive_until(hal_can_t *can, hal_status_t wanted)
{
    hal_can_frame_t frame = {.id = 0};
    hal_status_t status = HAL_OK;
    for (int i = 0; i < PATIENCE; i++) {
        status = hal_can_receive(can, &frame);
        if (status == wanted)
            return frame;
        if (status != HAL_OK)
            usleep(PATIENCE_US);
    }
    fail_msg("receive gives %d, expected %d", (int)status, (int)wanted);
    return frame;
}

static int set_up(void **state)
{
    (void)state;
    run("ip link show $CAN >/dev/null 2>&1 || ip link add dev $CAN type vcan; ip link set $CAN down");
    run("ip link set $CAN up mtu 72");
    return 0;
}

static void wrong_settings_are_told(void **state)
{
    (void)state;
    run("ip link set $CAN down");
    assert_refused(true, "can vcan0: is down: `ip link set vcan0 down; ip link set vcan0 up mtu 72`");
    run("ip link set $CAN up mtu 16");
    assert_refused(true, "can vcan0: classic frames only, the room has CAN FD: `ip link set vcan0 down; ip link set "
                         "vcan0 up mtu 72`");
    run("ip link set $CAN down; ip link set $CAN up mtu 72"); /* the command of the line */
    can_socketcan_close(open_can());
    run("ip link del $CAN");
    assert_refused(true, "can vcan0: no such interface, expected one of `ip link show type can`; is the controller's "
                         "device-tree overlay loaded?");
}

static void remote_frames_are_not_delivered(void **state)
{
    (void)state;
    hal_can_t *can = open_can();
    run("cansend $CAN 123#R; cansend $CAN 12345678#R; cansend $CAN 124#01");
    assert_int_equal(receive_until(can, HAL_OK).id, 0x124);
    receive_until(can, HAL_EMPTY);
    can_socketcan_close(can);
}

/* Error frames of linux/can/error.h as another program can put them on a virtual bus. */
static void error_frames_change_the_state(void **state)
{
    (void)state;
    const hal_can_frame_t frame = {.id = 1, .length = 1};
    hal_can_t *can = open_can();
    assert_int_equal(hal_can_state(can), HAL_CAN_ERROR_ACTIVE);
    run("cansend $CAN 20000004#0020000000000000"); /* transmitter passive */
    receive_until(can, HAL_EMPTY);
    assert_int_equal(hal_can_state(can), HAL_CAN_ERROR_PASSIVE);
    assert_int_equal(hal_can_send(can, &frame), HAL_OK);
    run("cansend $CAN 20000004#0040000000000000"); /* active again */
    receive_until(can, HAL_EMPTY);
    assert_int_equal(hal_can_state(can), HAL_CAN_ERROR_ACTIVE);
    run("cansend $CAN 20000040#0000000000000000"); /* bus-off */
    receive_until(can, HAL_EMPTY);
    assert_int_equal(hal_can_state(can), HAL_CAN_BUS_OFF);
    assert_int_equal(hal_can_send(can, &frame), HAL_IO);
    assert_int_equal(hal_can_restart(can), HAL_IO); /* a virtual interface has nothing to restart */
    run("cansend $CAN 20000100#0000000000000000");  /* restarted */
    receive_until(can, HAL_EMPTY);
    assert_int_equal(hal_can_state(can), HAL_CAN_ERROR_ACTIVE);
    assert_int_equal(hal_can_send(can, &frame), HAL_OK);
    can_socketcan_close(can);
}

static void a_link_may_go_down_and_come_up(void **state)
{
    (void)state;
    const hal_can_frame_t frame = {.id = 1, .length = 1};
    hal_can_t *can = open_can();
    for (int i = 0; i < 3; i++) {
        run("ip link set $CAN down");
        receive_until(can, HAL_IO);
        assert_int_equal(hal_can_send(can, &frame), HAL_IO);
        run("ip link set $CAN up; cansend $CAN 123#01");
        assert_int_equal(receive_until(can, HAL_OK).id, 0x123);
        receive_until(can, HAL_EMPTY);
        assert_int_equal(hal_can_send(can, &frame), HAL_OK);
    }
    can_socketcan_close(can);
}

static void a_link_may_vanish_and_come_back(void **state)
{
    (void)state;
    const hal_can_frame_t frame = {.id = 1, .length = 1};
    hal_can_t *can = open_can();
    run("ip link del $CAN");
    receive_until(can, HAL_IO);
    assert_int_equal(hal_can_send(can, &frame), HAL_IO);
    run("ip link add dev $CAN type vcan");
    receive_until(can, HAL_IO);
    run("ip link set $CAN up mtu 16"); /* not as wanted */
    usleep(50000);
    for (int i = 0; i < 3; i++)
        assert_int_equal(hal_can_receive(can, &(hal_can_frame_t){.id = 0}), HAL_IO);
    run("ip link set $CAN down; ip link set $CAN up mtu 72");
    receive_until(can, HAL_EMPTY);
    run("cansend $CAN 123#01");
    assert_int_equal(receive_until(can, HAL_OK).id, 0x123);
    assert_int_equal(hal_can_send(can, &frame), HAL_OK);
    can_socketcan_close(can);
}

/* More than the queue holds: the first are kept, the rest is counted, and then all goes on. */
static void a_flood_is_counted(void **state)
{
    (void)state;
    enum { SENT = 5000 };
    hal_can_t *can = open_can();
    run("cangen $CAN -g 0 -n 5000 -I 7 -L 8 -D i");
    int received = 0;
    for (hal_can_frame_t frame; hal_can_receive(can, &frame) == HAL_OK; received++)
        assert_int_equal(frame.data[0] | frame.data[1] << 8, received);
    run("cansend $CAN 123#01");
    assert_int_equal(receive_until(can, HAL_OK).id, 0x123);
    print_message("queue: %d frames kept\n", received);
    assert_true(received >= KEPT && received < SENT);
    assert_int_equal(hal_can_lost(can), SENT - received);
    assert_int_equal(hal_can_state(can), HAL_CAN_ERROR_ACTIVE);
    can_socketcan_close(can);
}

static int64_t monotonic_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static void set_the_clock(int64_t by_s)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    now.tv_sec += by_s;
    assert_int_equal(clock_settime(CLOCK_REALTIME, &now), 0);
}

/* Frames are stamped, the clock is set, then they are taken. */
static void a_set_clock_does_not_hurt_the_stamps(void **state)
{
    (void)state;
    static const int64_t steps_s[] = {3600, -3600, 5, -5};
    hal_can_t *can = open_can();
    for (int i = 0; i < 4; i++) {
        receive_until(can, HAL_EMPTY);
        const int64_t before_us = monotonic_us();
        run("cansend $CAN 123#01");
        const int64_t after_us = monotonic_us();
        set_the_clock(steps_s[i]);
        usleep(20000);
        const hal_can_frame_t frame = receive_until(can, HAL_OK);
        if (frame.time_us < before_us || frame.time_us > after_us)
            fail_msg("clock set by %lld s: stamped %lld us after the command began, which took %lld us",
                     (long long)steps_s[i], (long long)(frame.time_us - before_us), (long long)(after_us - before_us));
    }
    can_socketcan_close(can);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(wrong_settings_are_told, set_up),
        cmocka_unit_test_setup(remote_frames_are_not_delivered, set_up),
        cmocka_unit_test_setup(error_frames_change_the_state, set_up),
        cmocka_unit_test_setup(a_link_may_go_down_and_come_up, set_up),
        cmocka_unit_test_setup(a_link_may_vanish_and_come_back, set_up),
        cmocka_unit_test_setup(a_flood_is_counted, set_up),
        cmocka_unit_test_setup(a_set_clock_does_not_hurt_the_stamps, set_up),
    };
    if (argc != 2)
        return 2;
    interface = argv[1];
    if (setenv("CAN", interface, 1) != 0)
        return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
