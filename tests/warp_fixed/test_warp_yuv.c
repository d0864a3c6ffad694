// SPDX-License-Identifier: Apache-2.0
// Frames of luma and chroma: each plane is what it would be alone; formats in and out; where chroma lies.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "firmware/warp_steps.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"
#include "warp_fixed/color.h"
#include "warp_fixed/homography_of_chroma.h"

enum { WIDTH = 90, HEIGHT = 70, PANEL_WIDTH = 84, PANEL_HEIGHT = 78, GUARD = 32, MAX_BYTES = 100 * 100 * 4 };

static const uint8_t border[3] = {200, 30, 90};
static warp_t warp, alone;

/* Bytes of a picture or panel, with guards before and after. */
typedef struct {
    uint8_t bytes[GUARD + MAX_BYTES + GUARD];
    picture_t picture;
} memory_t;

static memory_t from, to;
static ls_weights_t weights;

static size_t plane_bytes(const picture_t *p, int plane)
{
    return (size_t)p->stride[plane] * (size_t)(plane == 0 ? p->height : p->height / 2);
}

static void lay_out(memory_t *memory, picture_format_t format, int32_t width, int32_t height)
{
    static const int32_t bytes[PICTURE_FORMATS] = {4, 1, 3, 3, 2, 2, 1};
    memset(memory->bytes, 0xa5, sizeof memory->bytes);
    picture_t *p = &memory->picture;
    *p = (picture_t){.format = format, .width = width, .height = height};
    p->stride[0] = width * bytes[format] + 3;
    p->stride[1] = width + 5;
    p->data[0] = memory->bytes + GUARD;
    if (format == PICTURE_NV12)
        p->data[1] = p->data[0] + plane_bytes(p, 0);
    assert_true(plane_bytes(p, 0) + (format == PICTURE_NV12 ? plane_bytes(p, 1) : 0) <= MAX_BYTES);
}

static void fill_with_noise(memory_t *memory, uint64_t seed)
{
    rng_t rng = {seed};
    for (size_t i = GUARD; i < GUARD + MAX_BYTES; i++)
        memory->bytes[i] = (uint8_t)rng_int(&rng, 16, 235);
}

/* Y, U or V that belongs to a pixel. */
static uint8_t *component(const picture_t *p, int32_t x, int32_t y, int channel)
{
    uint8_t *row = p->data[0] + (ptrdiff_t)y * p->stride[0];
    const int32_t pair = x / 2;
    if (p->format == PICTURE_NV12)
        return channel == 0 ? row + x : p->data[1] + (ptrdiff_t)(y / 2) * p->stride[1] + 2 * pair + channel - 1;
    const int32_t first = p->format == PICTURE_UYVY;
    return channel == 0 ? row + 2 * x + first : row + 4 * pair + 2 * (channel - 1) + 1 - first;
}

static void run(const homography_t *h, warp_report_t *report)
{
    assert_true(warp_plan(&warp, warp_kernels_best(), report, h, &to.picture, &from.picture));
    warp_steps_run(&warp, NULL);
    for (int i = 0; i < GUARD; i++)
        assert_int_equal(to.bytes[i], 0xa5);
}

static homography_t homography_number(int n)
{
    static const double rows[4][9] = {
        {0.75, -1, 60, 1, 0.75, -30, 0, 0, 1}, /* turned, with a k that has few bits: for NV12, chroma's is the same */
        {1.25, 0, -6, 0, 0.875, 5, 0, 0, 1},   /* scaled: so it is for YUYV */
        {1.3, 0.2, -10, 0.1, 0.9, 3, 0.003, 0.002, 1}, /* perspective */
        {90, 3, -4000, 2, 70, -3000, 0.002, 0.001, 1}, /* levels */
    };
    return homography_of(rows[n], (homography_sizes_t){PANEL_WIDTH, PANEL_HEIGHT, WIDTH, HEIGHT});
}

static const chroma_log2_t chroma_of[PICTURE_FORMATS] = {
    [PICTURE_YUYV] = {1, 0}, [PICTURE_UYVY] = {1, 0}, [PICTURE_NV12] = {1, 1}};

/* What a channel is, warped as a gray picture by itself. @return where a pixel of the panel finds its own. */
static const uint8_t *warped_alone(const homography_t *h, int channel, picture_format_t panel_format)
{
    static uint8_t picture_bytes[MAX_BYTES], panel_bytes[MAX_BYTES];
    const picture_t *p = &from.picture;
    const chroma_log2_t none = {0, 0};
    const chroma_log2_t in = channel == 0 ? none : chroma_of[p->format];
    const chroma_log2_t out = channel == 0 ? none : chroma_of[panel_format];
    homography_t own;
    homography_of_chroma(&own, h, out, in);
    for (int32_t y = 0; y < own.picture_height; y++)
        for (int32_t x = 0; x < own.picture_width; x++)
            picture_bytes[y * own.picture_width + x] = *component(p, x << in.x, y << in.y, channel);
    const image_t picture = {picture_bytes, own.picture_width, own.picture_height, own.picture_width, IMAGE_GRAY8};
    const image_t panel = {panel_bytes, own.panel_width, own.panel_height, own.panel_width, IMAGE_GRAY8};
    static ls_weights_t of_channel;
    for (int32_t x = 0; x < own.picture_width; x++)
        of_channel.x[x] = weights.x[x << in.x];
    for (int32_t y = 0; y < own.picture_height; y++)
        of_channel.y[y] = weights.y[y << in.y];
    warp_set_ls_weights(&alone, &of_channel);
    const uint8_t bgr[3] = {border[2], border[1], border[0]};
    uint8_t yuv[3];
    color_yuv_from_bgr(yuv, bgr, p->matrix);
    memset(alone.border, yuv[channel], sizeof alone.border);
    assert_true(warp_frame(&alone, warp_kernels_best(), NULL, &own, &panel, &picture));
    return panel_bytes;
}

static void compare_channel(const homography_t *h, const warp_method_t *method, int channel)
{
    const picture_t *p = &to.picture;
    const uint8_t *expected = warped_alone(h, channel, p->format);
    const chroma_log2_t out = channel == 0 ? (chroma_log2_t){0, 0} : chroma_of[p->format];
    for (int32_t j = 0; j < p->height; j++)
        for (int32_t i = 0; i < p->width; i++) {
            const uint8_t e = expected[(j >> out.y) * (p->width >> out.x) + (i >> out.x)];
            if (*component(p, i, j, channel) != e)
                fail_msg("%s, format %d to %d, pixel (%d, %d) of channel %d: %d, expected %d", method->name,
                         (int)from.picture.format, (int)p->format, i, j, channel, *component(p, i, j, channel), e);
        }
}

/* Does the method depend on the step k? Then chroma alone would have its own, but where the homography is affine. */
static bool needs_step(const warp_method_t *method)
{
    return method->filter != WARP_FILTER_NONE || method->resampler == WARP_LS || method->resampler == WARP_AUTO;
}

static void planes_are_warped_as_if_alone(void **state)
{
    (void)state;
    static const picture_format_t pairs[][2] = {{PICTURE_NV12, PICTURE_NV12},
                                                {PICTURE_YUYV, PICTURE_YUYV},
                                                {PICTURE_UYVY, PICTURE_YUYV},
                                                {PICTURE_NV12, PICTURE_YUYV},
                                                {PICTURE_UYVY, PICTURE_NV12}};
    for (int32_t k = 0; k < WIDTH; k++)
        weights.x[k] = weights.y[k] = (uint16_t)(LS_WEIGHT_ONE / 2 + k * 7919 % (LS_WEIGHT_ONE / 2));
    for (int m = 0; m < WARP_METHODS; m++) {
        warp_init(&warp, warp_methods[m], false, border);
        warp_set_ls_weights(&warp, &weights);
        warp_init(&alone, warp_methods[m], false, border);
        for (int n = 0; n < 4; n++) {
            const picture_format_t *formats = pairs[(m + n) % 5];
            const homography_t h = homography_number(n);
            lay_out(&from, formats[0], WIDTH, HEIGHT);
            fill_with_noise(&from, (uint64_t)(m * 4 + n + 1));
            lay_out(&to, formats[1], PANEL_WIDTH, PANEL_HEIGHT);
            run(&h, NULL);
            compare_channel(&h, &warp_methods[m], 0);
            const bool same_kind = chroma_of[formats[0]].y == chroma_of[formats[1]].y;
            const bool same_step = same_kind && (n == 1 || (n == 0 && formats[0] == PICTURE_NV12));
            for (int channel = 1; channel < 3; channel++)
                if (!needs_step(&warp_methods[m]) || same_step)
                    compare_channel(&h, &warp_methods[m], channel);
        }
    }
}

/* Lit pixels are the converted bytes of a panel of YUV; the others have the border's very colour. */
static void yuv_becomes_xrgb(void **state)
{
    (void)state;
    static memory_t planes;
    for (int n = 0; n < 4; n++) {
        for (picture_format_t format = PICTURE_YUYV; format <= PICTURE_NV12; format++) {
            const homography_t h = homography_number(n);
            warp_init(&warp, *warp_method_default(), false, border);
            lay_out(&from, format, WIDTH, HEIGHT);
            fill_with_noise(&from, (uint64_t)n + 7);
            from.picture.matrix = n % 2 == 0 ? PICTURE_BT709 : PICTURE_BT601;
            lay_out(&to, format == PICTURE_NV12 ? PICTURE_NV12 : PICTURE_YUYV, PANEL_WIDTH, PANEL_HEIGHT);
            run(&h, NULL);
            planes = to;
            planes.picture.data[0] = planes.bytes + (to.picture.data[0] - to.bytes);
            if (format == PICTURE_NV12)
                planes.picture.data[1] = planes.bytes + (to.picture.data[1] - to.bytes);
            lay_out(&to, PICTURE_XRGB8888, PANEL_WIDTH, PANEL_HEIGHT);
            run(&h, NULL);
            const color_matrix_t matrix = color_matrix(from.picture.matrix);
            for (int32_t j = 0; j < PANEL_HEIGHT; j++)
                for (int32_t i = 0; i < PANEL_WIDTH; i++) {
                    const uint8_t *pixel = to.picture.data[0] + (ptrdiff_t)j * to.picture.stride[0] + 4 * i;
                    const uint8_t luma[2] = {*component(&planes.picture, i, j, 0), 0};
                    const uint8_t chroma[2] = {*component(&planes.picture, i, j, 1),
                                               *component(&planes.picture, i, j, 2)};
                    uint8_t lit[8];
                    warp_kernels_scalar.xrgb_from_yuv(lit, luma, chroma, &matrix, 1);
                    const uint8_t unlit[4] = {border[2], border[1], border[0], 0};
                    int32_t x, y;
                    assert_memory_equal(pixel, grid_point(&warp.plane[0].grid, i, j, &x, &y) ? lit : unlit, 4);
                }
        }
    }
}

static void rgb_is_expanded(void **state)
{
    (void)state;
    const homography_t h = homography_number(2);
    static uint8_t expected[MAX_BYTES], expanded[MAX_BYTES];
    for (int bgr = 0; bgr < 2; bgr++) {
        warp_init(&warp, *warp_method_default(), false, border);
        lay_out(&from, bgr ? PICTURE_BGR888 : PICTURE_RGB888, WIDTH, HEIGHT);
        fill_with_noise(&from, 3);
        lay_out(&to, PICTURE_XRGB8888, PANEL_WIDTH, PANEL_HEIGHT);
        run(&h, NULL);
        for (int32_t y = 0; y < HEIGHT; y++)
            for (int32_t x = 0; x < WIDTH; x++)
                for (int c = 0; c < 3; c++)
                    expanded[(y * WIDTH + x) * 4 + (bgr ? 2 - c : c)] =
                        from.picture.data[0][y * from.picture.stride[0] + 3 * x + c];
        const image_t picture = {expanded, WIDTH, HEIGHT, WIDTH * 4, IMAGE_XRGB8888};
        const image_t panel = {expected, PANEL_WIDTH, PANEL_HEIGHT, PANEL_WIDTH * 4, IMAGE_XRGB8888};
        assert_true(warp_frame(&warp, warp_kernels_best(), NULL, &h, &panel, &picture));
        for (int32_t j = 0; j < PANEL_HEIGHT; j++)
            assert_memory_equal(to.picture.data[0] + (ptrdiff_t)j * to.picture.stride[0],
                                expected + (ptrdiff_t)j * PANEL_WIDTH * 4, (size_t)PANEL_WIDTH * 4);
    }
}

/* Chroma that is a ramp over the picture: a panel's pair shows the ramp at its own centre's point. */
static void chroma_lies_at_its_rectangles_centre(void **state)
{
    (void)state;
    for (picture_format_t format = PICTURE_YUYV; format <= PICTURE_NV12; format++) {
        const double rows[9] = {0.9, 0.05, 3.3, -0.07, 0.8, 8.7, 0.001, -0.0005, 1};
        const homography_t h = homography_of(rows, (homography_sizes_t){PANEL_WIDTH, PANEL_HEIGHT, WIDTH, HEIGHT});
        const int32_t rows_of = format == PICTURE_NV12 ? 2 : 1;
        warp_init(&warp, *warp_method_from_name("none+linear"), false, border);
        lay_out(&from, format, WIDTH, HEIGHT);
        for (int32_t y = 0; y < HEIGHT; y++)
            for (int32_t x = 0; x < WIDTH; x++) {
                *component(&from.picture, x, y, 1) = (uint8_t)(20 + 2 * (x / 2 * 2 + 1));
                *component(&from.picture, x, y, 2) = (uint8_t)lround(20 + 2 * (y / rows_of * rows_of + rows_of / 2.0));
            }
        lay_out(&to, format == PICTURE_NV12 ? PICTURE_NV12 : PICTURE_YUYV, PANEL_WIDTH, PANEL_HEIGHT);
        run(&h, NULL);
        int compared = 0;
        for (int32_t j = 0; j < PANEL_HEIGHT; j += rows_of)
            for (int32_t i = 0; i < PANEL_WIDTH; i += 2) {
                const double u = i + 1, v = j + rows_of / 2.0;
                const double w = rows[6] * u + rows[7] * v + rows[8];
                const double x = (rows[0] * u + rows[1] * v + rows[2]) / w;
                const double y = (rows[3] * u + rows[4] * v + rows[5]) / w;
                if (x < 2 || x > WIDTH - 2 || y < 2 || y > HEIGHT - 2)
                    continue;
                compared++;
                assert_true(fabs(*component(&to.picture, i, j, 1) - (20 + 2 * x)) < 0.6);
                assert_true(fabs(*component(&to.picture, i, j, 2) - (20 + 2 * y)) < 1.1);
            }
        assert_true(compared > 500);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_warped_as_if_alone),
        cmocka_unit_test(yuv_becomes_xrgb),
        cmocka_unit_test(rgb_is_expanded),
        cmocka_unit_test(chroma_lies_at_its_rectangles_centre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
