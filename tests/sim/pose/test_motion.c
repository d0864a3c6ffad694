// SPDX-License-Identifier: Apache-2.0
// Tests of the made-up motions: each is what its description says, from any pose.
#include "sim/pose/motion.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "sim/trackers/tracker_rotation.h"

/* Half a turn about x: its down is -y, its forward -z. */
static const pose_t start = {.eye_nm = {1000000, 2000000, 3000000}, .quaternion_q30 = {0, 1 << 30, 0, 0}};

static pose_list_t make(motion_kind_t kind, double rate_hz, double duration_s, uint64_t seed)
{
    pose_list_t list;
    const motion_t motion = {.kind = kind, .start = start, .rate_hz = rate_hz, .duration_s = duration_s, .seed = seed};
    assert_true(motion_make(&list, &motion));
    return list;
}

/* Of a pose: the way from the start, m, along the room's axes. */
static double way_m(const pose_list_t *list, size_t i, int axis)
{
    return (double)(list->entry[i].pose.eye_nm[axis] - start.eye_nm[axis]) / 1e9;
}

/* Its forward direction. */
static void forward_of(const pose_list_t *list, size_t i, double forward[3])
{
    double quaternion[4];
    for (int k = 0; k < 4; k++)
        quaternion[k] = list->entry[i].pose.quaternion_q30[k] / 1073741824.0;
    tracker_rotation_apply(forward, quaternion, (const double[3]){0, 0, 1});
}

static void test_times_and_lengths(void **state)
{
    (void)state;
    pose_list_t list = make(MOTION_STILL, 240.0, 2.0, 0);
    assert_int_equal(list.count, 480);
    assert_int_equal(list.entry[0].time_us, 0);
    assert_int_equal(list.entry[1].time_us, 4167);
    assert_int_equal(list.entry[479].time_us, 1995833);
    for (size_t i = 0; i < list.count; i++)
        assert_memory_equal(&list.entry[i].pose, &start, sizeof start);
    pose_list_free(&list);
    list = make(MOTION_STILL, 1.0, 0.0, 0);
    assert_int_equal(list.count, 1);
    pose_list_free(&list);
}

static void test_walk(void **state)
{
    (void)state;
    pose_list_t list = make(MOTION_WALK, 240.0, 20.0, 0);
    double farthest = 0.0, fastest = 0.0, highest = 0.0, widest = 0.0, forward[3];
    for (size_t i = 0; i < list.count; i++) {
        farthest = fmax(farthest, fabs(way_m(&list, i, 0)));
        highest = fmax(highest, fabs(way_m(&list, i, 1)));
        assert_true(fabs(way_m(&list, i, 2)) < 1e-6);
        if (i > 0)
            fastest = fmax(fastest, fabs(way_m(&list, i, 0) - way_m(&list, i - 1, 0)) * 240.0);
        forward_of(&list, i, forward);
        widest = fmax(widest, asin(forward[0]) * 180.0 / M_PI);
    }
    assert_true(fabs(farthest - 1.0) < 0.001 && fabs(fastest - 1.4) < 0.001);
    assert_true(fabs(highest - 0.03) < 0.0001 && fabs(widest - 20.0) < 0.01);
    pose_list_free(&list);
}

/* The middle is 1 m ahead of the start: at -1 m along z. */
static void test_orbit_keeps_the_middle_in_view(void **state)
{
    (void)state;
    pose_list_t list = make(MOTION_ORBIT, 100.0, 10.0, 0);
    double forward[3], length = 0.0;
    for (size_t i = 0; i < list.count; i++) {
        forward_of(&list, i, forward);
        for (int k = 0; k < 3; k++)
            assert_true(fabs(way_m(&list, i, k) + forward[k] - (k == 2 ? -1.0 : 0.0)) < 1e-6);
        if (i > 0)
            length += hypot(way_m(&list, i, 0) - way_m(&list, i - 1, 0), way_m(&list, i, 2) - way_m(&list, i - 1, 2));
    }
    assert_true(fabs(length - 2.0 * M_PI * 999.0 / 1000.0) < 0.001);
    pose_list_free(&list);
}

static void test_noise_has_its_deviation_and_its_seed(void **state)
{
    (void)state;
    pose_list_t list = make(MOTION_NOISE, 1000.0, 20.0, 1), same = make(MOTION_NOISE, 1000.0, 20.0, 1);
    pose_list_t other = make(MOTION_NOISE, 1000.0, 20.0, 2);
    assert_memory_equal(list.entry, same.entry, list.count * sizeof *list.entry);
    assert_memory_not_equal(list.entry, other.entry, list.count * sizeof *list.entry);
    double metres[3] = {0}, sine[2] = {0}, forward[3];
    for (size_t i = 0; i < list.count; i++) {
        forward_of(&list, i, forward);
        for (int k = 0; k < 3; k++)
            metres[k] += way_m(&list, i, k) * way_m(&list, i, k) / (double)list.count;
        for (int k = 0; k < 2; k++)
            sine[k] += forward[k] * forward[k] / (double)list.count;
    }
    for (int k = 0; k < 3; k++)
        assert_true(fabs(sqrt(metres[k]) - 0.0005) < 0.00002);
    for (int k = 0; k < 2; k++)
        assert_true(fabs(sqrt(sine[k]) * 180.0 / M_PI - 0.05) < 0.002);
    pose_list_free(&list);
    pose_list_free(&same);
    pose_list_free(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_times_and_lengths),
        cmocka_unit_test(test_walk),
        cmocka_unit_test(test_orbit_keeps_the_middle_in_view),
        cmocka_unit_test(test_noise_has_its_deviation_and_its_seed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
