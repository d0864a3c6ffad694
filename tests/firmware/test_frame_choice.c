// SPDX-License-Identifier: Apache-2.0
// Tests of the choice of a refresh's picture: it is certain to be every board's only when it, and the one after it,
// were not captured near the limit between them.
#include "firmware/frame_choice.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum {
    LAG_US = 20000,
    POSE_DELAY_US = 2000,
    PERIOD_US = 16667,
    EDGE_US = FRAME_CHOICE_EDGE_US,
    NODE = 7,
    LEADER = 1,
    NONE = -1
};

static const int64_t begin_us = 100000000; /* of a refresh, in bus time, which the board's clock shows too */

/* A board that is in step with its leader; the refresh at begin_us comes next. */
static frame_choice_t board_in_step(void)
{
    static const frame_choice_settings_t settings = {
        .clock = {.node = NODE, .rate = {60, 1}, .pose_delay_us = POSE_DELAY_US}, .width = 96, .height = 54};
    frame_choice_t choice;
    assert_true(frame_choice_init(&choice, &settings, begin_us));
    choice.clock.now = (frame_epoch_t){.any = true, .lag_us = LAG_US};
    choice.clock.leader = LEADER;
    choice.clock.proven = true;
    choice.clock.proven_us = begin_us;
    return choice;
}

/* @param blank_us  When the board's panel begins the refresh. */
static void step(frame_choice_t *choice, int64_t blank_us)
{
    static const can_poses_t poses = {.any = false};
    static const bus_master_t time = {.own = true};
    frame_choice_step(choice, &poses, &time, NULL, NULL, blank_us);
}

/* The limit is at 0: pictures captured so long before it and after it, one each interval_us; NONE: it is not there. */
typedef struct {
    int64_t before_us, after_us, interval_us;
    bool certain;
} scene_t;

static void test_a_picture_near_the_limit_is_not_certain(void **state)
{
    (void)state;
    static const scene_t scenes[] = {
        {EDGE_US + 1, EDGE_US + 1, 0, true},
        {EDGE_US, 8000, 0, false}, /* another board may see it as captured after the limit */
        {8000, EDGE_US, 0, false}, /* and this one before it */
        {-10, 8000, 0, false},     /* the first of all */
        {8000, NONE, 0, false},    /* the next one may be under way: when it comes is not known, */
        {8000, NONE, 20000, true}, /* or not before long; it may be a quarter early */
        {15000 - EDGE_US - 1, NONE, 20000, true},
        {15000 - EDGE_US, NONE, 20000, false},
        {NONE, NONE, 0, false},
    };
    const int64_t limit_us = begin_us - LAG_US + PERIOD_US / 4;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        const scene_t *scene = &scenes[i];
        frame_choice_t choice = board_in_step();
        choice.now = (kept_picture_t){.any = scene->before_us != NONE, .capture_us = limit_us - scene->before_us};
        choice.waiting[0] = (kept_picture_t){.any = true, .capture_us = limit_us + scene->after_us};
        choice.waiting_count = scene->after_us != NONE;
        choice.interval_us = scene->interval_us;
        step(&choice, begin_us);
        assert_true(choice.step.in_step);
        assert_int_equal(choice.step.picture_limit_us, limit_us);
        if (choice.picture_certain != scene->certain)
            fail_msg("scene %zu: certain is %d", i, choice.picture_certain);
        assert_false(frame_choice_report(&choice).in_step); /* there is no pose */
    }
}

static void test_out_of_step_no_picture_is_certain(void **state)
{
    (void)state;
    frame_choice_t choice = board_in_step();
    choice.now = (kept_picture_t){.any = true, .capture_us = begin_us - LAG_US - 2000};
    choice.interval_us = PERIOD_US;
    step(&choice, begin_us);
    assert_true(choice.picture_certain);
    step(&choice, begin_us + PERIOD_US / 4 + 10); /* its panel is too far off */
    assert_false(choice.step.in_step);
    assert_false(choice.picture_certain);
}

/* Panels differ by some hundred microseconds: what counts for a refresh must not. */
static void test_the_limits_do_not_depend_on_the_panel(void **state)
{
    (void)state;
    for (int64_t off_us = -4000; off_us <= 4000; off_us += 500) {
        frame_choice_t choice = board_in_step();
        step(&choice, begin_us + off_us);
        assert_true(choice.step.in_step);
        assert_int_equal(choice.step.off_us, off_us);
        assert_int_equal(choice.step.pose_limit_us, begin_us - POSE_DELAY_US);
        assert_int_equal(choice.step.picture_limit_us, begin_us - LAG_US + PERIOD_US / 4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_picture_near_the_limit_is_not_certain),
        cmocka_unit_test(test_out_of_step_no_picture_is_certain),
        cmocka_unit_test(test_the_limits_do_not_depend_on_the_panel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
