// SPDX-License-Identifier: Apache-2.0
// The EDID of HDMI receivers: published timings, sums, the preferred mode read back, and what can't be offered.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "hal/linux/edid.h"
#include "tests/support/rng.h"

typedef struct {
    int32_t width, height, frames, seconds;
    int32_t whole_px, whole_lines, clock_khz, vic;
} published_t;

/* CTA-861-G table 1; VESA DMT 1.13 for the others, which are CVT with reduced blanking. */
static const published_t published[] = {
    {640, 480, 60, 1, 800, 525, 25200, 1},
    {1280, 720, 60, 1, 1650, 750, 74250, 4},
    {1280, 720, 50, 1, 1980, 750, 74250, 19},
    {1920, 1080, 60, 1, 2200, 1125, 148500, 16},
    {1920, 1080, 50, 1, 2640, 1125, 148500, 31},
    {1920, 1080, 30, 1, 2200, 1125, 74250, 34},
    {1920, 1080, 24, 1, 2750, 1125, 74250, 32},
    {3840, 2160, 30, 1, 4400, 2250, 297000, 95},
    {1920, 1080, 60000, 1001, 2200, 1125, 148351, 16},
    {1920, 1080, 24000, 1001, 2750, 1125, 74175, 32},
    {1280, 800, 60, 1, 1440, 823, 71000, 0},
    {1280, 768, 60, 1, 1440, 790, 68250, 0},
    {1400, 1050, 60, 1, 1560, 1080, 101000, 0},
    {1440, 900, 60, 1, 1600, 926, 88750, 0},
    {1680, 1050, 60, 1, 1840, 1080, 119000, 0},
    {1920, 1200, 60, 1, 2080, 1235, 154000, 0},
    {2560, 1600, 60, 1, 2720, 1646, 268500, 0},
};

static void modes_are_the_published_ones(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
        const published_t *p = &published[i];
        edid_mode_t mode;
        assert_true(edid_mode(&mode, p->width, p->height, p->frames, p->seconds));
        const int32_t whole_px = mode.width + mode.front_px + mode.sync_px + mode.back_px,
                      whole_lines = mode.height + mode.front_lines + mode.sync_lines + mode.back_lines;
        if (mode.width != p->width || mode.height != p->height || whole_px != p->whole_px ||
            whole_lines != p->whole_lines || mode.clock_khz != p->clock_khz || mode.vic != p->vic)
            fail_msg("%dx%d %d/%d: %d x %d, %d kHz, code %d", p->width, p->height, p->frames, p->seconds, whole_px,
                     whole_lines, mode.clock_khz, mode.vic);
    }
}

static int32_t twelve_bits(uint8_t low, uint8_t high)
{
    return low | high << 8;
}

/* The mode in the first descriptor. */
static edid_mode_t read_preferred(const uint8_t edid[EDID_BYTES])
{
    const uint8_t *at = edid + 54;
    edid_mode_t mode = {
        .clock_khz = 10 * (at[0] | at[1] << 8),
        .width = twelve_bits(at[2], at[4] >> 4),
        .height = twelve_bits(at[5], at[7] >> 4),
        .front_px = at[8] | (at[11] >> 6) << 8,
        .sync_px = at[9] | (at[11] >> 4 & 3) << 8,
        .front_lines = at[10] >> 4 | (at[11] >> 2 & 3) << 4,
        .sync_lines = (at[10] & 0xF) | (at[11] & 3) << 4,
        .positive_h = (at[17] & 2) != 0,
        .positive_v = (at[17] & 4) != 0,
    };
    mode.back_px = twelve_bits(at[3], at[4] & 0xF) - mode.front_px - mode.sync_px;
    mode.back_lines = twelve_bits(at[6], at[7] & 0xF) - mode.front_lines - mode.sync_lines;
    return mode;
}

static void any_size_is_read_back(void **state)
{
    (void)state;
    const uint64_t seed = 20261122;
    rng_t rng = {.state = seed};
    int offered = 0;
    for (int i = 0; i < 20000; i++) {
        const int32_t width = (int32_t)rng_int(&rng, 1, 4200), height = (int32_t)rng_int(&rng, 1, 4200),
                      rate = (int32_t)rng_int(&rng, 1, 200);
        edid_mode_t mode;
        if (!edid_mode(&mode, width, height, rate, 1))
            continue;
        offered++;
        mode.sync_px += (int32_t)rng_int(&rng, 0, 400);
        uint8_t edid[EDID_BYTES], sum[EDID_BLOCKS] = {0};
        edid_write(edid, &mode);
        for (int byte = 0; byte < EDID_BYTES; byte++)
            sum[byte / EDID_BLOCK_BYTES] = (uint8_t)(sum[byte / EDID_BLOCK_BYTES] + edid[byte]);
        mode.clock_khz = mode.clock_khz / 10 * 10;
        mode.vic = 0;
        const edid_mode_t read = read_preferred(edid);
        if (sum[0] != 0 || sum[1] != 0 || memcmp(&read, &mode, sizeof mode) != 0)
            fail_msg("seed %llu, %dx%d at %d Hz: sums %d, %d, or another mode", (unsigned long long)seed, width, height,
                     rate, sum[0], sum[1]);
    }
    assert_true(offered > 1000);
}

static void what_cannot_be_offered_is_refused(void **state)
{
    (void)state;
    static const int32_t cases[][4] = {
        {63, 480, 60, 1},    {4096, 2160, 60, 1}, {640, 63, 60, 1}, {640, 4096, 60, 1},   {1920, 1080, 0, 1},
        {1920, 1080, 60, 0}, {3840, 2160, 60, 1}, {64, 64, 24, 1},  {1920, 1080, -60, 1}, {1920, 1080, INT32_MAX, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        edid_mode_t mode = {.width = -1};
        if (edid_mode(&mode, cases[i][0], cases[i][1], cases[i][2], cases[i][3]) || mode.width != -1)
            fail_msg("case %zu: taken, or written", i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modes_are_the_published_ones),
        cmocka_unit_test(any_size_is_read_back),
        cmocka_unit_test(what_cannot_be_offered_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
