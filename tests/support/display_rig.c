// SPDX-License-Identifier: Apache-2.0
// A simulated display with its clock, for tests: 100 blanks a second.
#include "tests/support/display_rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "sim/devices/sim_clock.h"

int64_t display_rig_blank_us(int64_t n)
{
    return 3000 + 10000 * n;
}

sim_display_settings_t display_rig_settings(hal_time_t *clock)
{
    return (sim_display_settings_t){
        .width = DISPLAY_RIG_WIDTH, .height = DISPLAY_RIG_HEIGHT, .clock = clock, .blanks = {3000, 100, 1}};
}

display_rig_t display_rig_open(int64_t epoch_us)
{
    char error[FILE_ERROR_LENGTH] = "";
    display_rig_t rig = {.clock = sim_clock_create(&(sim_clock_settings_t){.epoch_us = epoch_us}, error)};
    assert_non_null(rig.clock);
    const sim_display_settings_t settings = display_rig_settings(rig.clock);
    rig.display = sim_display_create(&settings, error);
    assert_non_null(rig.display);
    return rig;
}

void display_rig_close(const display_rig_t *rig)
{
    sim_display_destroy(rig->display);
    sim_clock_destroy(rig->clock);
}

void display_rig_go_to(const display_rig_t *rig, int64_t time_us)
{
    sim_clock_set_us(rig->clock, time_us);
    sim_display_advance(rig->display, time_us);
}

hal_status_t display_rig_borrow(const display_rig_t *rig, picture_t *buffer)
{
    return hal_display_back_buffer(rig->display, PICTURE_XRGB8888, PICTURE_BT709, buffer);
}

hal_status_t display_rig_draw(const display_rig_t *rig, int value)
{
    picture_t buffer;
    const hal_status_t status = display_rig_borrow(rig, &buffer);
    if (status != HAL_OK)
        return status;
    assert_true(buffer.width == DISPLAY_RIG_WIDTH && buffer.height == DISPLAY_RIG_HEIGHT &&
                buffer.format == PICTURE_XRGB8888);
    memset(buffer.data[0], value, (size_t)buffer.stride[0] * DISPLAY_RIG_HEIGHT);
    return hal_display_present(rig->display);
}

int display_rig_wall(const display_rig_t *rig)
{
    const image_t *shown = sim_display_shown(rig->display);
    if (shown == NULL)
        return -1;
    for (int32_t y = 0; y < DISPLAY_RIG_HEIGHT; y++)
        for (int32_t x = 0; x < DISPLAY_RIG_WIDTH * 4; x++)
            assert_int_equal(image_row(shown, y)[x], shown->data[0]);
    return shown->data[0];
}
