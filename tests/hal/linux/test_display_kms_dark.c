// SPDX-License-Identifier: Apache-2.0
// A display that goes dark, by its cable or by another program, and how it comes back.
#include "tests/hal/linux/kms_kernel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <errno.h>

#include "hal/hal_display.h"

static void expect_dark(void)
{
    picture_t buffer;
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_IO);
    assert_int_equal(hal_display_back_buffer(&kms_display, PICTURE_XRGB8888, PICTURE_BT709, &buffer), HAL_IO);
    assert_int_equal(hal_display_present(&kms_display), HAL_BAD_CALL);
}

static void an_unplugged_display_comes_back(void **state)
{
    (void)state;
    kms_kernel.at_once = false;
    const uint32_t newest = kms_kernel_show(HAL_OK);
    const uint64_t lost = kms_kernel.token;
    kms_kernel_set_status("disconnected\n");
    expect_dark();
    kms_kernel_set_status("unknown\n");
    expect_dark();
    assert_int_equal(kms_kernel.lights, 0);
    kms_kernel_set_status("connected\n");
    kms_kernel.mode.hdisplay = KMS_KERNEL_WIDTH - 1; /* another projector */
    expect_dark();
    assert_int_equal(kms_kernel.lights, 0);
    kms_kernel.mode.hdisplay = KMS_KERNEL_WIDTH;
    kms_kernel.answer = EINVAL;
    kms_kernel_set_status("connected\n");
    expect_dark();
    assert_int_equal(kms_kernel.lights, 1);
    kms_kernel.answer = 0;
    kms_kernel_set_status("connected\n");
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    assert_int_equal(kms_kernel.lights, 2);
    assert_int_equal(kms_kernel.lit.framebuffer, newest);
    kms_kernel_answer(lost); /* of the flip before */
    kms_kernel.at_once = true;
    assert_int_not_equal(kms_kernel_show(HAL_OK), newest);
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    assert_int_equal(kms_kernel.lights, 2);
}

static void a_display_that_others_took_comes_back(void **state)
{
    (void)state;
    kms_kernel.answer = EACCES;
    kms_kernel.master = false;
    kms_kernel_show(HAL_IO);
    expect_dark();
    assert_int_equal(kms_kernel.lights, 0);
    kms_kernel.answer = 0;
    kms_kernel.master = true;
    kms_kernel_set_status("connected\n");
    assert_int_equal(hal_display_wait_vblank(&kms_display), HAL_OK);
    assert_int_equal(kms_kernel.lights, 1);
    kms_kernel_show(HAL_OK);
}

/* Asking the projector what it offers takes long: twice a second is enough. */
static void a_dark_display_is_not_asked_all_the_time(void **state)
{
    (void)state;
    kms_kernel_set_status("disconnected\n");
    expect_dark();
    kms_kernel_set_status("connected\n");
    kms_kernel.answer = EINVAL;
    expect_dark();
    assert_int_equal(kms_kernel.lights, 1);
    const int64_t lit_ns = kms_display.lit_ns;
    for (int64_t later_ns = 60000000; later_ns < 500000000; later_ns += 60000000)
        kms_state_look(&kms_display, lit_ns + later_ns);
    assert_int_equal(kms_kernel.lights, 1);
    kms_state_look(&kms_display, lit_ns + 560000000);
    assert_int_equal(kms_kernel.lights, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(an_unplugged_display_comes_back, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_display_that_others_took_comes_back, kms_kernel_set_up, kms_kernel_tear_down),
        cmocka_unit_test_setup_teardown(a_dark_display_is_not_asked_all_the_time, kms_kernel_set_up,
                                        kms_kernel_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
