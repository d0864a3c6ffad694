// SPDX-License-Identifier: Apache-2.0
// The simulated camera's faults, one by one.
#include "sim/devices/sim_camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/camera_rig.h"

static void test_lost_pictures(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    sim_camera_faults_t *faults = sim_camera_faults(rig.camera);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(0)), 0);
    faults->drop_next = 2;
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(1)), -HAL_EMPTY);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(2)), -HAL_EMPTY);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(3)), 3);
    faults->drop_next = 1; /* of two that come together, the older one */
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(5)), 5);
    assert_int_equal(sim_camera_counts(rig.camera).lost, 3);
    faults->drop_ppm = 1000000;
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(6)), -HAL_EMPTY);
    faults->drop_ppm = 300000;
    const uint64_t lost = sim_camera_counts(rig.camera).lost;
    camera_rig_advance(&rig, camera_rig_time_us(10006));
    assert_in_range(sim_camera_counts(rig.camera).lost - lost, 2800, 3200);
    camera_rig_close(&rig);
}

static void test_late_pictures(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(4)), 4);
    sim_camera_faults(rig.camera)->late_us = 25000;
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(7)), -HAL_EMPTY);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(7) + 4999), -HAL_EMPTY);
    hal_camera_frame_t frame;
    camera_rig_advance(&rig, camera_rig_time_us(7) + 5000);
    assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_OK);
    assert_int_equal(frame.sequence, 5);
    assert_int_equal(frame.capture_time_us, camera_rig_time_us(5));
    camera_rig_close(&rig);
}

static void test_corrupt_pictures_are_the_same_each_time(void **state)
{
    (void)state;
    uint8_t *seen[2];
    for (int run = 0; run < 2; run++) {
        const camera_rig_t rig = camera_rig_open("pattern");
        hal_camera_frame_t frame;
        sim_camera_faults(rig.camera)->corrupt_next = 1;
        camera_rig_advance(&rig, camera_rig_time_us(0));
        assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_OK);
        assert_int_equal(camera_rig_spoilt_rows(&rig, &frame, 0), RIG_HEIGHT / 4);
        seen[run] = malloc(RIG_WIDTH * RIG_HEIGHT * 4);
        memcpy(seen[run], frame.picture.data[0], RIG_WIDTH * RIG_HEIGHT * 4);
        hal_camera_release(rig.camera, &frame);
        camera_rig_advance(&rig, camera_rig_time_us(64)); /* the same frame of the video, whole again */
        assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_OK);
        assert_int_equal(camera_rig_spoilt_rows(&rig, &frame, 0), 0);
        assert_int_equal(sim_camera_counts(rig.camera).corrupted, 1);
        sim_camera_faults(rig.camera)->corrupt_ppm = 500000;
        for (int64_t n = 65; n < 565; n++)
            camera_rig_advance(&rig, camera_rig_time_us(n));
        assert_in_range(sim_camera_counts(rig.camera).corrupted, 200, 300);
        camera_rig_close(&rig);
    }
    assert_memory_equal(seen[0], seen[1], RIG_WIDTH * RIG_HEIGHT * 4);
    free(seen[0]);
    free(seen[1]);
}

static void test_stuck(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    hal_camera_frame_t frame;
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(3)), 3);
    sim_camera_faults(rig.camera)->stuck = true;
    for (int64_t n = 4; n < 10; n++) {
        camera_rig_advance(&rig, camera_rig_time_us(n));
        assert_int_equal(hal_camera_take(rig.camera, &frame), HAL_OK);
        assert_int_equal(frame.sequence, 3);
        assert_int_equal(frame.capture_time_us, camera_rig_time_us(n));
        assert_int_equal(camera_rig_spoilt_rows(&rig, &frame, 3), 0);
        hal_camera_release(rig.camera, &frame);
    }
    sim_camera_faults(rig.camera)->stuck = false;
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(10)), 10);
    camera_rig_close(&rig);
}

static void test_unplugged(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    hal_camera_frame_t held;
    camera_rig_advance(&rig, camera_rig_time_us(1));
    assert_int_equal(hal_camera_take(rig.camera, &held), HAL_OK);
    camera_rig_advance(&rig, camera_rig_time_us(2));
    sim_camera_faults(rig.camera)->unplugged_until_us = camera_rig_time_us(5) - 2000;
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(2) + 1), -HAL_IO);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(5) - 2001), -HAL_IO);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(5) - 2000), -HAL_EMPTY); /* 2 is forgotten */
    assert_int_equal(camera_rig_spoilt_rows(&rig, &held, 1), 0);
    assert_int_equal(camera_rig_sequence_at(&rig, camera_rig_time_us(5)), 5);
    assert_int_equal(sim_camera_counts(rig.camera).lost, 2);
    hal_camera_release(rig.camera, &held);
    camera_rig_close(&rig);
}

/* A board's clock may well show less than 0. */
static void test_no_fault_before_time_0(void **state)
{
    (void)state;
    const camera_rig_t rig = camera_rig_open("pattern");
    sim_camera_settings_t settings = camera_rig_settings(rig.video);
    settings.rate.start_us = -1000000;
    char error[FILE_ERROR_LENGTH];
    const camera_rig_t early = {rig.video, sim_camera_create(&settings, error)};
    assert_int_equal(camera_rig_sequence_at(&early, -1000000 + 3 * RIG_PERIOD_US), 3);
    sim_camera_destroy(early.camera);
    camera_rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lost_pictures),
        cmocka_unit_test(test_late_pictures),
        cmocka_unit_test(test_corrupt_pictures_are_the_same_each_time),
        cmocka_unit_test(test_stuck),
        cmocka_unit_test(test_unplugged),
        cmocka_unit_test(test_no_fault_before_time_0),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
