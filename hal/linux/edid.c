// SPDX-License-Identifier: Apache-2.0
// The EDID that an HDMI receiver shows to the video source: see the header.
#include "hal/linux/edid.h"

#include <stddef.h>
#include <string.h>

enum {
    LEAST_KHZ = 25000,
    MOST_KHZ = 340000,     /* HDMI 1.4 */
    OLD_MOST_KHZ = 165000, /* more must be told */
    LEAST_SIZE = 64,
    MOST_SIZE = 4095, /* 12 bits */
    VGA_CODE = 1,     /* 640x480 at 60 Hz */
    DESCRIPTOR_BYTES = 18,
    FIRST_DESCRIPTOR = 54
};

typedef struct {
    edid_mode_t mode; /* of the whole rate */
    int32_t hz;
} known_mode_t;

static const known_mode_t known_modes[] = {
    {{640, 480, 16, 96, 48, 10, 2, 33, 25200, false, false, 1}, 60},
    {{1280, 720, 110, 40, 220, 5, 5, 20, 74250, true, true, 4}, 60},
    {{1280, 720, 440, 40, 220, 5, 5, 20, 74250, true, true, 19}, 50},
    {{1920, 1080, 88, 44, 148, 4, 5, 36, 148500, true, true, 16}, 60},
    {{1920, 1080, 528, 44, 148, 4, 5, 36, 148500, true, true, 31}, 50},
    {{1920, 1080, 88, 44, 148, 4, 5, 36, 74250, true, true, 34}, 30},
    {{1920, 1080, 528, 44, 148, 4, 5, 36, 74250, true, true, 33}, 25},
    {{1920, 1080, 638, 44, 148, 4, 5, 36, 74250, true, true, 32}, 24},
    {{3840, 2160, 176, 88, 296, 8, 10, 72, 297000, true, true, 95}, 30},
    {{3840, 2160, 1056, 88, 296, 8, 10, 72, 297000, true, true, 94}, 25},
    {{3840, 2160, 1276, 88, 296, 8, 10, 72, 297000, true, true, 93}, 24},
};

/* Is the rate hz, or hz / 1.001, give or take a tenth of their distance? In ten-thousandths. */
static bool has_rate(int32_t hz, int64_t frames, int64_t seconds)
{
    const int64_t ratio = (10000 * frames + seconds * hz / 2) / (seconds * hz);
    return (ratio >= 9999 && ratio <= 10001) || (ratio >= 9989 && ratio <= 9991);
}

static int32_t whole_px(const edid_mode_t *mode)
{
    return mode->width + mode->front_px + mode->sync_px + mode->back_px;
}

static int32_t whole_lines(const edid_mode_t *mode)
{
    return mode->height + mode->front_lines + mode->sync_lines + mode->back_lines;
}

/* The vertical sync tells the shape of the picture. */
static int32_t cvt_sync_lines(int32_t width, int32_t height)
{
    static const struct {
        int32_t across, down, lines;
    } shapes[] = {{4, 3, 4}, {16, 9, 5}, {16, 10, 6}, {5, 4, 7}, {15, 9, 7}};
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++)
        if (width == 8 * (height * shapes[i].across / shapes[i].down / 8))
            return shapes[i].lines;
    return 10;
}

static edid_mode_t cvt_mode(int32_t width, int32_t height, int64_t frames, int64_t seconds)
{
    edid_mode_t mode = {.width = width,
                        .height = height,
                        .front_px = 48,
                        .sync_px = 32,
                        .back_px = 80,
                        .front_lines = 3,
                        .positive_h = true};
    mode.sync_lines = cvt_sync_lines(width, height);
    /* At least 460 us of pause: a line lasts (1 / rate - 460 us) / height. */
    const int64_t visible_us_frames = 1000000 * seconds - 460 * frames;
    int64_t pause = visible_us_frames <= 0 ? 0 : 460 * frames * height / visible_us_frames + 1;
    if (pause < mode.front_lines + mode.sync_lines + 6)
        pause = mode.front_lines + mode.sync_lines + 6;
    mode.back_lines = (int32_t)pause - mode.front_lines - mode.sync_lines;
    const int64_t khz = (int64_t)whole_px(&mode) * whole_lines(&mode) * frames / (1000 * seconds);
    mode.clock_khz = (int32_t)(khz / 250 * 250);
    return mode;
}

bool edid_mode(edid_mode_t *mode, int32_t width, int32_t height, int32_t rate_frames, int32_t rate_seconds)
{
    if (width < LEAST_SIZE || width > MOST_SIZE || height < LEAST_SIZE || height > MOST_SIZE || rate_frames < 1 ||
        rate_seconds < 1 || rate_frames / rate_seconds > 1000)
        return false;
    edid_mode_t result = cvt_mode(width, height, rate_frames, rate_seconds);
    for (size_t i = 0; i < sizeof known_modes / sizeof known_modes[0]; i++) {
        const edid_mode_t *known = &known_modes[i].mode;
        if (known->width != width || known->height != height || !has_rate(known_modes[i].hz, rate_frames, rate_seconds))
            continue;
        result = *known;
        const int64_t khz =
            (int64_t)whole_px(known) * whole_lines(known) * rate_frames / (1000 * (int64_t)rate_seconds);
        if (khz < known->clock_khz)
            result.clock_khz = (int32_t)khz;
    }
    if (result.clock_khz < LEAST_KHZ || result.clock_khz > MOST_KHZ)
        return false;
    *mode = result;
    return true;
}

static uint8_t low(int32_t value)
{
    return (uint8_t)(value & 0xFF);
}

/* Bits 8 to 11 of two numbers. */
static uint8_t high_of(int32_t first, int32_t second)
{
    return (uint8_t)(((first >> 8 & 0xF) << 4) | (second >> 8 & 0xF));
}

/* E-EDID A.1, section 3.10.2. */
static void write_timing(uint8_t at[DESCRIPTOR_BYTES], const edid_mode_t *mode)
{
    const int32_t pause_px = whole_px(mode) - mode->width, pause_lines = whole_lines(mode) - mode->height;
    const int32_t clock = mode->clock_khz / 10;
    memset(at, 0, DESCRIPTOR_BYTES);
    at[0] = low(clock);
    at[1] = low(clock >> 8);
    at[2] = low(mode->width);
    at[3] = low(pause_px);
    at[4] = high_of(mode->width, pause_px);
    at[5] = low(mode->height);
    at[6] = low(pause_lines);
    at[7] = high_of(mode->height, pause_lines);
    at[8] = low(mode->front_px);
    at[9] = low(mode->sync_px);
    at[10] = (uint8_t)((mode->front_lines & 0xF) << 4 | (mode->sync_lines & 0xF));
    at[11] = (uint8_t)((mode->front_px >> 8 & 3) << 6 | (mode->sync_px >> 8 & 3) << 4 |
                       (mode->front_lines >> 4 & 3) << 2 | (mode->sync_lines >> 4 & 3));
    at[17] = (uint8_t)(0x18 | (mode->positive_v ? 4 : 0) | (mode->positive_h ? 2 : 0));
}

static void write_checksum(uint8_t block[EDID_BLOCK_BYTES])
{
    int32_t sum = 0;
    for (int i = 0; i < EDID_BLOCK_BYTES - 1; i++)
        sum += block[i];
    block[EDID_BLOCK_BYTES - 1] = low(-sum);
}

static int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t most(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Of this mode and of 640x480: 60 pictures and 31,469 lines a second. */
static void write_limits(uint8_t at[DESCRIPTOR_BYTES], const edid_mode_t *mode)
{
    static const uint8_t begin[] = {0, 0, 0, 0xFD, 0};
    const int32_t lines_hz = (int32_t)((int64_t)mode->clock_khz * 1000 / whole_px(mode));
    const int32_t hz = lines_hz / whole_lines(mode);
    memset(at, ' ', DESCRIPTOR_BYTES);
    memcpy(at, begin, sizeof begin);
    at[5] = (uint8_t)least(59, hz);
    at[6] = (uint8_t)least(255, most(61, hz + 1));
    at[7] = (uint8_t)least(31, lines_hz / 1000);
    at[8] = (uint8_t)least(255, most(32, lines_hz / 1000 + 1));
    at[9] = (uint8_t)((mode->clock_khz + 9999) / 10000);
    at[10] = 0;
    at[11] = '\n';
}

static void write_base(uint8_t base[EDID_BLOCK_BYTES], const edid_mode_t *mode)
{
    static const uint8_t begin[FIRST_DESCRIPTOR] = {
        0,    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, /* always */
        0x31, 0xD8, 0,    0,    0,    0,    0,    0, /* made by LNX, as the kernel's own; no number */
        1,    36,   1,    3,                         /* week, year 2026; version */
        0x80, 0,    0,    0x78, 0x0E, /* digital; of no size; gamma 2.2; RGB, sRGB, preferred mode first */
        0xEE, 0x91, 0xA3, 0x54, 0x4C, 0x99, 0x26, 0x0F, 0x50, 0x54, /* sRGB */
        0x20, 0,    0,                                              /* 640x480 */
        1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1, 1, 1, 1, 1, 1,
    };
    static const uint8_t name[DESCRIPTOR_BYTES] = "\0\0\0\xFC\0wallwarp\n    ";
    memset(base, 0, EDID_BLOCK_BYTES);
    memcpy(base, begin, sizeof begin);
    uint8_t *descriptor = base + FIRST_DESCRIPTOR;
    write_timing(descriptor, mode);
    memcpy(descriptor + DESCRIPTOR_BYTES, name, sizeof name);
    write_limits(descriptor + 2 * DESCRIPTOR_BYTES, mode);
    descriptor[3 * DESCRIPTOR_BYTES + 3] = 0x10; /* nothing */
    base[126] = EDID_BLOCKS - 1;
    write_checksum(base);
}

/* CTA-861-G, section 7. */
static void write_cta(uint8_t block[EDID_BLOCK_BYTES], const edid_mode_t *mode)
{
    memset(block, 0, EDID_BLOCK_BYTES);
    uint8_t *at = block + 4;
    if (mode->vic != 0) {
        *at++ = (uint8_t)(2 << 5 | (mode->vic == VGA_CODE ? 1 : 2)); /* modes by code, as above */
        *at++ = (uint8_t)mode->vic;
        if (mode->vic != VGA_CODE)
            *at++ = VGA_CODE;
    }
    const bool fast = mode->clock_khz > OLD_MOST_KHZ;
    *at++ = (uint8_t)(3 << 5 | (fast ? 7 : 5)); /* HDMI, at the source's address 1.0.0.0 */
    *at++ = 0x03;
    *at++ = 0x0C;
    *at++ = 0x00;
    *at++ = 0x10;
    *at++ = 0x00;
    if (fast) {
        *at++ = 0;
        *at++ = (uint8_t)((mode->clock_khz + 4999) / 5000);
    }
    *at++ = 7 << 5 | 2; /* what it does with pictures: */
    *at++ = 0;
    *at++ = 0x4A; /* RGB of the range that the source names; shows all of them, to the edges */
    block[0] = 0x02;
    block[1] = 3;
    block[2] = (uint8_t)(at - block);
    block[3] = 0x81; /* shows all, to the edges; one native mode, the preferred one */
    write_checksum(block);
}

void edid_write(uint8_t edid[EDID_BYTES], const edid_mode_t *mode)
{
    write_base(edid, mode);
    write_cta(edid + EDID_BLOCK_BYTES, mode);
}
