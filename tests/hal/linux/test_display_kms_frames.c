// SPDX-License-Identifier: Apache-2.0
// The display's contract on DRM/KMS: which buffer is shown, when a picture waits, is replaced or refused.
#include "tests/hal/linux/kms_kernel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <errno.h>
#include <string.h>

#include "hal/hal_display.h"

static const int64_t PATIENCE_NS = 100000000;

static void each_picture_is_flown_and_awaited(void **state)
{
    (void)state;
    uint32_t last = 1;
    for (int i = 0; i < 10; i++) {
        const uint32_t framebuffer = kms_kernel_show(HAL_OK);
        assert_int_not_equal(framebuffer, last);
        assert_int_equal(kms_kernel.flown.framebuffer, framebuffer);
        assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
        assert_int_equal(kms_display.shown + 1, framebuffer);
        last = framebuffer;
    }
    assert_int_equal(kms_kernel.flips, 10);
    assert_int_equal(kms_kernel.asked, 0);
}

static void a_blank_without_a_picture_is_awaited(void **state)
{
    (void)state;
    for (int i = 1; i <= 3; i++) {
        assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
        assert_int_equal(kms_kernel.asked, i);
    }
    const int64_t next_us = hal_display_next_vblank_us(&kms_display);
    assert_true(next_us > kms_kernel.now_ns / 1000 && next_us <= kms_kernel.now_ns / 1000 + 17000);
}

/* The first is with the kernel already; of those after it the last is next, and none is shown twice. */
static void the_last_picture_of_several_is_shown(void **state)
{
    (void)state;
    kms_kernel.at_once = false;
    const uint32_t first = kms_kernel_show(HAL_OK);
    const uint64_t token = kms_kernel.token;
    const uint32_t second = kms_kernel_show(HAL_OK);
    assert_int_equal(kms_kernel.flown.framebuffer, first);
    picture_t buffer;
    memset(&buffer, 0xA5, sizeof buffer);
    const picture_t untouched = buffer;
    assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_XRGB8888, PICTURE_BT709, &buffer), HAL_FULL);
    assert_memory_equal(&buffer, &untouched, sizeof buffer);
    kms_kernel_answer(token);
    const uint32_t third = kms_kernel_show(HAL_OK);
    assert_int_equal(kms_kernel.flown.framebuffer, second);
    kms_kernel_answer(kms_kernel.token);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    assert_int_equal(kms_kernel.flown.framebuffer, third);
    assert_int_equal(kms_kernel.flips, 3);
}

static void a_picture_on_its_way_is_replaced(void **state)
{
    (void)state;
    picture_t buffer;
    kms_kernel.answer = EBUSY;
    const uint32_t first = kms_kernel_show(HAL_OK);
    const uint32_t second = kms_kernel_show(HAL_OK);
    assert_int_not_equal(first, second);
    assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_XRGB8888, PICTURE_BT709, &buffer), HAL_OK);
    assert_int_not_equal(kms_display.borrowed + 1, second);
    kms_kernel.answer = 0;
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    assert_int_equal(kms_kernel.flown.framebuffer, second);
}

static void a_late_answer_counts_for_nothing_else(void **state)
{
    (void)state;
    kms_kernel.at_once = false;
    kms_kernel_show(HAL_OK);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_IO);
    const uint64_t late = kms_kernel.token;
    kms_kernel_answer(late - 1); /* of no request that is still open */
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_IO);
    assert_int_not_equal(kms_display.flying, KMS_NO_BUFFER);
    kms_kernel_answer(late);
    const uint32_t second = kms_kernel_show(HAL_OK);
    assert_int_equal(kms_kernel.flown.framebuffer, second);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_IO);
    kms_kernel_answer(late); /* both at once */
    kms_kernel_answer(kms_kernel.token);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
}

/* @return Of the next wait, after which there was no blank, in ns. */
static int64_t time_without_blank(void)
{
    const int64_t begin_ns = kms_kernel.now_ns;
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_IO);
    return kms_kernel.now_ns - begin_ns;
}

/* The pictures are all on their way, which the firmware tells as a fault, at the pace that its LED needs. */
static void a_driver_that_hangs_keeps_the_pace(void **state)
{
    (void)state;
    picture_t buffer;
    kms_kernel.at_once = false;
    kms_kernel_show(HAL_OK);
    const uint64_t lost = kms_kernel.token;
    assert_int_equal(time_without_blank(), PATIENCE_NS);
    kms_kernel_show(HAL_OK);
    for (int i = 0; i < 10; i++) {
        const int64_t next_us = hal_display_next_vblank_us(&kms_display);
        assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_XRGB8888, PICTURE_BT709, &buffer), HAL_FULL);
        assert_true(time_without_blank() < 17000000);
        assert_int_equal(kms_kernel.now_ns / 1000, next_us);
    }
    kms_kernel_answer(lost);
    kms_kernel_show(HAL_OK);
    kms_kernel_answer(kms_kernel.token);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    assert_int_equal(time_without_blank(), PATIENCE_NS); /* of the last one */
}

/* One that is answered after its time is a sign of life: the next has as long as any. */
static void a_driver_may_begin_late(void **state)
{
    (void)state;
    kms_kernel.holds = true;
    assert_int_equal(time_without_blank(), PATIENCE_NS);
    assert_true(time_without_blank() < 17000000);
    kms_kernel_answer(kms_kernel.token);
    assert_int_equal(time_without_blank(), PATIENCE_NS);
    kms_kernel.holds = false;
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
}

static void a_refused_picture_is_given_back(void **state)
{
    (void)state;
    kms_kernel.answer = EINVAL;
    for (int i = 0; i < 5; i++)
        kms_kernel_show(HAL_IO);
    assert_int_equal(kms_display.shown, 0);
    assert_int_equal(hal_display_present(&kms_display), HAL_BAD_CALL);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    kms_kernel.answer = 0;
    kms_kernel_show(HAL_OK);
}

static void a_borrowed_buffer_stays_the_same(void **state)
{
    (void)state;
    picture_t first, second;
    assert_true(hal_display_takes(&kms_display, PICTURE_NV12));
    assert_false(hal_display_takes(&kms_display, PICTURE_YUYV));
    assert_false(hal_display_takes(&kms_display, PICTURE_GRAY8));
    assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_XRGB8888, PICTURE_BT709, &first), HAL_OK);
    assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_NV12, PICTURE_BT601, &second), HAL_OK);
    assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_YUYV, PICTURE_BT601, &second), HAL_BAD_CALL);
    assert_ptr_equal(first.data[0], second.data[0]);
    assert_int_equal(first.stride[0], KMS_KERNEL_WIDTH * 4);
    assert_true(picture_is_valid(&second) && second.format == PICTURE_NV12 && second.matrix == PICTURE_BT601);
    assert_ptr_equal(second.data[1], second.data[0] + second.stride[0] * KMS_KERNEL_HEIGHT);
    const uint32_t framebuffer = KMS_KERNEL_NV12 + (uint32_t)kms_display.borrowed;
    assert_int_equal(hal_display_present(&kms_display), HAL_OK);
    assert_int_equal(kms_kernel.flown.framebuffer, framebuffer);
    assert_int_equal(kms_kernel.flown.format, PICTURE_NV12);
    assert_int_equal(kms_kernel.flown.matrix, PICTURE_BT601);
}

static void without_blanks_the_clock_tells_them(void **state)
{
    (void)state;
    kms_kernel.blanks = false;
    kms_display.dark = true;
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    assert_true(kms_display.by_clock);
    for (int i = 0; i < 5; i++) {
        const int64_t next_us = hal_display_next_vblank_us(&kms_display);
        if (i % 2 == 0)
            kms_kernel_show(HAL_OK);
        assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
        assert_int_equal(kms_kernel.now_ns / 1000, next_us);
    }
    assert_int_equal(kms_kernel.asked, 0);
    kms_kernel.at_once = false;
    kms_kernel_show(HAL_OK);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(each_picture_is_flown_and_awaited, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_blank_without_a_picture_is_awaited, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(the_last_picture_of_several_is_shown, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_picture_on_its_way_is_replaced, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_late_answer_counts_for_nothing_else, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_driver_that_hangs_keeps_the_pace, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_driver_may_begin_late, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_refused_picture_is_given_back, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_borrowed_buffer_stays_the_same, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(without_blanks_the_clock_tells_them, kms_kernel_set_up, kms_kernel_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
