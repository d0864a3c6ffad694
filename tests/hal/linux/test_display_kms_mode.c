// SPDX-License-Identifier: Apache-2.0
// The choice of a mode: size, nearest rate, no interlaced one; and the list of what is offered.
#include "hal/linux/display_kms_mode.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

/* Timings of CTA-861 and VESA DMT: size, kHz, totals. */
static const struct {
    uint16_t width, height;
    uint32_t clock;
    uint16_t across, down;
    uint32_t flags, type;
} timings[] = {
    {1280, 800, 83500, 1680, 831, 0, DRM_MODE_TYPE_PREFERRED},
    {1920, 1080, 74250, 2200, 1125, DRM_MODE_FLAG_INTERLACE, 0},
    {1920, 1080, 148352, 2200, 1125, 0, 0},
    {1920, 1080, 148500, 2200, 1125, 0, 0},
    {1920, 1080, 148500, 2200, 1125, 0, DRM_MODE_TYPE_PREFERRED},
    {1920, 1080, 148500, 2640, 1125, 0, 0},
    {1920, 1080, 74250, 2750, 1125, 0, 0},
    {1280, 720, 74250, 1650, 750, 0, 0},
    {1280, 720, 74250, 1650, 750, 0, 0},
    {720, 480, 27000, 1716, 262, DRM_MODE_FLAG_DBLSCAN, 0},
};
enum { OFFERED = sizeof timings / sizeof *timings };
static drmModeModeInfo offered[OFFERED];

static int offer(void **state)
{
    (void)state;
    for (int i = 0; i < OFFERED; i++)
        offered[i] = (drmModeModeInfo){.clock = timings[i].clock,
                                       .hdisplay = timings[i].width,
                                       .htotal = timings[i].across,
                                       .vdisplay = timings[i].height,
                                       .vtotal = timings[i].down,
                                       .flags = timings[i].flags,
                                       .type = timings[i].type};
    return 0;
}

static void expect(int32_t width, int32_t height, int32_t frames, int32_t seconds, int32_t index)
{
    const kms_mode_wanted_t wanted = {width, height, frames, seconds};
    const int32_t found = kms_mode_choose(offered, OFFERED, &wanted);
    if (found != index)
        fail_msg("%dx%d at %d / %d: found %d, expected %d", width, height, frames, seconds, found, index);
}

static void rates_come_from_the_timing(void **state)
{
    (void)state;
    assert_int_equal(kms_mode_millihertz(&offered[2]), 59940);
    assert_int_equal(kms_mode_millihertz(&offered[3]), 60000);
    assert_int_equal(kms_mode_millihertz(&offered[0]), 59810);
    assert_int_equal(kms_mode_period_ns(&offered[3]), 16666667);
    assert_int_equal(kms_mode_period_ns(&offered[5]), 20000000);
    const drmModeModeInfo none = {.clock = 1};
    const drmModeModeInfo fastest = {.clock = UINT32_MAX, .htotal = UINT16_MAX, .vtotal = UINT16_MAX};
    assert_int_equal(kms_mode_millihertz(&none), 0);
    assert_int_equal(kms_mode_period_ns(&(drmModeModeInfo){.htotal = 1, .vtotal = 1}), 0);
    assert_int_equal(kms_mode_millihertz(&fastest), 1000031);
}

static void the_nearest_rate_is_chosen(void **state)
{
    (void)state;
    expect(1920, 1080, 60000, 1001, 2);
    expect(1920, 1080, 60, 1, 4); /* of equals the preferred one */
    expect(1920, 1080, 50, 1, 5);
    expect(1920, 1080, 24, 1, 6);
    expect(1920, 1080, 24000, 1001, 6);
    expect(1280, 720, 60000, 1001, 7); /* the other one is not offered */
    expect(1280, 800, 60, 1, 0);
}

static void another_rate_or_size_is_none(void **state)
{
    (void)state;
    expect(1920, 1080, 30, 1, KMS_NO_MODE); /* interlaced */
    expect(1920, 1080, 25, 1, KMS_NO_MODE);
    expect(1280, 720, 50, 1, KMS_NO_MODE);
    expect(720, 480, 60, 1, KMS_NO_MODE); /* line-doubled */
    expect(1080, 1920, 60, 1, KMS_NO_MODE);
    expect(1280, 800, 5922, 100, KMS_NO_MODE + 1); /* 0.99 % off */
    expect(1280, 800, 5921, 100, KMS_NO_MODE);     /* 1.01 % off */
    const kms_mode_wanted_t wanted = {1920, 1080, 60, 1};
    assert_int_equal(kms_mode_choose(offered, 0, &wanted), KMS_NO_MODE);
}

static void expect_preferred(int32_t count, int32_t width, int32_t height, int32_t millihertz)
{
    const kms_mode_wanted_t wanted = kms_mode_preferred(offered, count);
    assert_int_equal(wanted.width, width);
    assert_int_equal(wanted.height, height);
    assert_int_equal(INT64_C(1000) * wanted.refresh_frames / wanted.refresh_seconds, millihertz);
}

static void the_preferred_mode_is_of_the_projector(void **state)
{
    expect_preferred(OFFERED, 1280, 800, 59810);
    const kms_mode_wanted_t wanted = kms_mode_preferred(offered, OFFERED);
    assert_int_equal(kms_mode_choose(offered, OFFERED, &wanted), 0);
    offered[0].type = 0;
    expect_preferred(OFFERED, 1920, 1080, 60000); /* marked, though others came before */
    offered[4].type = 0;
    expect_preferred(OFFERED, 1920, 1080, 59940); /* the first of the largest */
    expect_preferred(2, 1280, 800, 59810);        /* the larger one is interlaced */
    offered[0].vdisplay = 2161;
    offered[0].type = DRM_MODE_TYPE_PREFERRED;
    expect_preferred(OFFERED, 1920, 1080, 59940); /* what is too large is not preferred */
    expect_preferred(2, 640, 480, 60000);         /* none is left */
    offer(state);
}

static void the_list_is_short(void **state)
{
    (void)state;
    const kms_mode_wanted_t other = {640, 480, 60, 1}, small = {1280, 720, 50, 1};
    char text[200];
    kms_mode_list(text, sizeof text, offered, OFFERED, &other);
    assert_string_equal(text, "1280x800 at 59.81, 1920x1080 at 59.94 60 50 24, 1280x720 at 60");
    kms_mode_list(text, sizeof text, offered, OFFERED, &small);
    assert_string_equal(text, "1280x720 at 60, 1280x800 at 59.81, 1920x1080 at 59.94 60 50 24");
    kms_mode_list(text, sizeof text, offered, 0, &small);
    assert_string_equal(text, "");
}

/* In every room the list ends in it, and what is left out is seen. */
static void the_list_fits(void **state)
{
    (void)state;
    const kms_mode_wanted_t wanted = {640, 480, 60, 1};
    char whole[200], text[200];
    kms_mode_list(whole, sizeof whole, offered, OFFERED, &wanted);
    for (size_t size = 8; size < strlen(whole) + 10; size++) {
        memset(text, '#', sizeof text);
        kms_mode_list(text, size, offered, OFFERED, &wanted);
        const char *end = strstr(text, "...");
        const size_t same = end == NULL ? strlen(text) : (size_t)(end - text);
        assert_true(memchr(text, '\0', size) != NULL);
        assert_int_equal(text[size], '#');
        assert_true(end != NULL || strcmp(text, whole) == 0);
        assert_true(same < 2 || strncmp(text, whole, same - 2) == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_come_from_the_timing),
        cmocka_unit_test(the_nearest_rate_is_chosen),
        cmocka_unit_test(another_rate_or_size_is_none),
        cmocka_unit_test(the_preferred_mode_is_of_the_projector),
        cmocka_unit_test(the_list_is_short),
        cmocka_unit_test(the_list_fits),
    };
    return cmocka_run_group_tests(tests, offer, NULL);
}
