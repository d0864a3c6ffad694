// SPDX-License-Identifier: Apache-2.0
// Pictures of luma and chroma on a display: which plane is taken, how buffers are told, and what is asked of the card.
#include "tests/hal/linux/drm_card.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <drm_fourcc.h>
#include <errno.h>
#include <string.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#include "hal/linux/display_kms_buffers.h"
#include "hal/linux/display_kms_pipe.h"
#include "hal/linux/display_kms_plane.h"

enum { CRTC = 30, CRTC_INDEX = 1, PRIMARY = 40, OVERLAY = 41, CURSOR = 42, WIDTH = 64, HEIGHT = 48, PITCH = 512 };

static const kms_screen_t screen = {
    .card = 9, .crtc = CRTC, .crtc_index = CRTC_INDEX, .width = WIDTH, .height = HEIGHT};
static drm_card_plane_t *const primary = &drm_card.plane[0], *const overlay = &drm_card.plane[1];

/* A card with an overlay that shows all, and can be told all. */
static int set_up(void **state)
{
    (void)state;
    memset(&drm_card, 0, sizeof drm_card);
    *primary =
        (drm_card_plane_t){PRIMARY, DRM_PLANE_TYPE_PRIMARY, 1 << CRTC_INDEX, CRTC, {DRM_FORMAT_XRGB8888}, false, false};
    *overlay = (drm_card_plane_t){OVERLAY,
                                  DRM_PLANE_TYPE_OVERLAY,
                                  3 << CRTC_INDEX,
                                  0,
                                  {DRM_FORMAT_XRGB8888, DRM_FORMAT_NV12, DRM_FORMAT_YUYV},
                                  true,
                                  true};
    drm_card.plane[2] = (drm_card_plane_t){CURSOR,
                                           DRM_PLANE_TYPE_CURSOR,
                                           1 << CRTC_INDEX,
                                           0,
                                           {DRM_FORMAT_XRGB8888, DRM_FORMAT_NV12, DRM_FORMAT_YUYV},
                                           true,
                                           true};
    return 0;
}

/* @return The plane for a format; 0: none. */
static uint32_t find(picture_format_t format)
{
    kms_plane_t plane, before;
    memset(&plane, 0xA5, sizeof plane);
    before = plane;
    if (kms_plane_find(&plane, &screen, format))
        return plane.id;
    assert_memory_equal(&plane, &before, sizeof plane);
    return 0;
}

static void luma_and_chroma_may_be_an_overlay(void **state)
{
    (void)state;
    assert_int_equal(find(PICTURE_XRGB8888), PRIMARY);
    assert_int_equal(find(PICTURE_NV12), OVERLAY);
    assert_int_equal(find(PICTURE_YUYV), OVERLAY);
    primary->format[1] = DRM_FORMAT_NV12; /* but it can't be told the matrix */
    assert_int_equal(find(PICTURE_NV12), OVERLAY);
    primary->encodings = primary->ranges = true;
    assert_int_equal(find(PICTURE_NV12), PRIMARY);
    assert_int_equal(find(PICTURE_YUYV), OVERLAY);
    primary->format[0] = 0;
    assert_int_equal(find(PICTURE_XRGB8888), 0);
}

static void an_overlay_must_fit(void **state)
{
    (void)state;
    const drm_card_plane_t fits = *overlay;
    overlay->possible_crtcs = 1 << (CRTC_INDEX + 1);
    assert_int_equal(find(PICTURE_NV12), 0);
    *overlay = fits;
    overlay->crtc = CRTC + 1;
    assert_int_equal(find(PICTURE_NV12), 0);
    overlay->crtc = CRTC;
    assert_int_equal(find(PICTURE_NV12), OVERLAY);
    overlay->format[1] = 0;
    assert_int_equal(find(PICTURE_NV12), 0);
    assert_int_equal(find(PICTURE_YUYV), OVERLAY);
    overlay->encodings = false;
    assert_int_equal(find(PICTURE_YUYV), 0);
    *overlay = fits;
    overlay->ranges = false;
    assert_int_equal(find(PICTURE_YUYV), 0);
    *overlay = fits;
    drm_card.without_bt601 = true;
    assert_int_equal(find(PICTURE_YUYV), 0);
}

/* Planes of every format; set up by hand, as kms_pipe_open() needs a connector. */
static void open_pipe(kms_pipe_t *pipe)
{
    *pipe = (kms_pipe_t){.screen = screen};
    assert_true(kms_plane_find(&pipe->plane[PICTURE_XRGB8888], &screen, PICTURE_XRGB8888));
    assert_true(kms_plane_find(&pipe->plane[PICTURE_NV12], &screen, PICTURE_NV12));
    assert_true(kms_plane_find(&pipe->plane[PICTURE_YUYV], &screen, PICTURE_YUYV));
}

static void expect_whole_screen(uint32_t plane, int64_t framebuffer)
{
    assert_int_equal(drm_card_asked(plane, "FB_ID"), framebuffer);
    assert_int_equal(drm_card_asked(plane, "CRTC_ID"), CRTC);
    assert_int_equal(drm_card_asked(plane, "SRC_X"), 0);
    assert_int_equal(drm_card_asked(plane, "SRC_Y"), 0);
    assert_int_equal(drm_card_asked(plane, "SRC_W"), WIDTH << 16);
    assert_int_equal(drm_card_asked(plane, "SRC_H"), HEIGHT << 16);
    assert_int_equal(drm_card_asked(plane, "CRTC_X"), 0);
    assert_int_equal(drm_card_asked(plane, "CRTC_Y"), 0);
    assert_int_equal(drm_card_asked(plane, "CRTC_W"), WIDTH);
    assert_int_equal(drm_card_asked(plane, "CRTC_H"), HEIGHT);
}

static void expect_hidden(uint32_t plane)
{
    assert_int_equal(drm_card_asked(plane, "FB_ID"), 0);
    assert_int_equal(drm_card_asked(plane, "CRTC_ID"), 0);
    assert_int_equal(drm_card_asked(plane, "SRC_W"), -1);
}

static void a_flip_tells_the_matrix(void **state)
{
    (void)state;
    kms_pipe_t pipe;
    open_pipe(&pipe);
    assert_int_equal(kms_pipe_flip(&pipe, &(kms_scan_t){71, PICTURE_NV12, PICTURE_BT601}, 12345), 0);
    assert_int_equal(drm_card.flags, DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT);
    assert_int_equal(drm_card.token, 12345);
    expect_whole_screen(OVERLAY, 71);
    expect_hidden(PRIMARY);
    assert_int_equal(drm_card_asked(OVERLAY, "COLOR_ENCODING"), DRM_CARD_BT601);
    assert_int_equal(drm_card_asked(OVERLAY, "COLOR_RANGE"), DRM_CARD_LIMITED);
    assert_int_equal(kms_pipe_try(&pipe, &(kms_scan_t){72, PICTURE_YUYV, PICTURE_BT709}), 0);
    assert_int_equal(drm_card.flags, DRM_MODE_ATOMIC_TEST_ONLY);
    expect_whole_screen(OVERLAY, 72);
    assert_int_equal(drm_card_asked(OVERLAY, "COLOR_ENCODING"), DRM_CARD_BT709);
    assert_int_equal(drm_card_asked(OVERLAY, "COLOR_RANGE"), DRM_CARD_LIMITED);
    assert_int_equal(kms_pipe_flip(&pipe, &(kms_scan_t){73, PICTURE_XRGB8888, PICTURE_BT709}, 12346), 0);
    expect_whole_screen(PRIMARY, 73);
    expect_hidden(OVERLAY);
    assert_int_equal(drm_card_asked(PRIMARY, "COLOR_ENCODING"), -1);
}

static void a_plane_for_all_is_never_hidden(void **state)
{
    (void)state;
    kms_pipe_t pipe;
    primary->format[1] = DRM_FORMAT_NV12;
    primary->format[2] = DRM_FORMAT_YUYV;
    primary->encodings = primary->ranges = true;
    open_pipe(&pipe);
    assert_int_equal(kms_pipe_flip(&pipe, &(kms_scan_t){71, PICTURE_YUYV, PICTURE_BT601}, 1), 0);
    expect_whole_screen(PRIMARY, 71);
    assert_int_equal(drm_card_asked(OVERLAY, "FB_ID"), -1);
    assert_int_equal(drm_card.count, 2 + KMS_PLACE_PROPERTIES + 2);
}

/* The memory of XRGB8888 pictures. */
static void make_buffers(kms_buffers_t *buffers, uint8_t *memory)
{
    *buffers = (kms_buffers_t){.width = WIDTH, .height = HEIGHT, .pitch = PITCH, .bytes = PITCH * HEIGHT};
    for (uint32_t i = 0; i < KMS_BUFFERS; i++)
        buffers->buffer[i] = (kms_buffer_t){.handle = 80 + i, .data = memory};
}

/* What the card is told of a format is where the firmware draws it, and lies within the buffer. */
static void expect_layout(picture_format_t format, uint32_t fourcc, uint32_t pitch, int planes)
{
    static uint8_t memory[PITCH * HEIGHT];
    kms_buffers_t buffers;
    make_buffers(&buffers, memory);
    drm_card.added_count = 0;
    assert_int_equal(kms_buffers_add_format(&buffers, screen.card, format), 0);
    assert_int_equal(drm_card.added_count, KMS_BUFFERS);
    for (int32_t i = 0; i < KMS_BUFFERS; i++) {
        const drm_card_framebuffer_t *added = &drm_card.added[i];
        const picture_t picture = kms_buffers_picture(&buffers, i, format);
        assert_true(picture_is_valid(&picture));
        assert_int_equal(buffers.buffer[i].framebuffer[format], added->id);
        assert_true(added->fourcc == fourcc && added->width == WIDTH && added->height == HEIGHT);
        for (int plane = 0; plane < 4; plane++) {
            const bool used = plane < planes;
            assert_int_equal(added->handle[plane], used ? buffers.buffer[i].handle : 0);
            assert_int_equal(added->pitch[plane], used ? pitch : 0);
            assert_int_equal(added->offset[plane], used ? picture.data[plane] - memory : 0);
            assert_true(!used || picture.stride[plane] == (int32_t)pitch);
            assert_true(added->offset[plane] + pitch * HEIGHT / (plane == 0 ? 1 : 2) <= sizeof memory);
        }
    }
}

static void a_buffer_holds_each_format(void **state)
{
    (void)state;
    expect_layout(PICTURE_XRGB8888, DRM_FORMAT_XRGB8888, PITCH, 1);
    expect_layout(PICTURE_YUYV, DRM_FORMAT_YUYV, PITCH / 2, 1);
    expect_layout(PICTURE_NV12, DRM_FORMAT_NV12, PITCH / 4, 2);
    assert_int_equal(drm_card.added[0].offset[1], PITCH / 4 * HEIGHT);
}

static void a_refused_format_leaves_nothing(void **state)
{
    (void)state;
    uint8_t memory[1];
    kms_buffers_t buffers;
    make_buffers(&buffers, memory);
    drm_card.refuses_after = KMS_BUFFERS - 1;
    assert_int_equal(kms_buffers_add_format(&buffers, screen.card, PICTURE_NV12), EINVAL);
    for (int32_t i = 0; i < KMS_BUFFERS; i++) {
        assert_int_equal(buffers.buffer[i].framebuffer[PICTURE_NV12], 0);
        assert_int_equal(drm_card.added[i].id, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(luma_and_chroma_may_be_an_overlay, set_up),
        cmocka_unit_test_setup(an_overlay_must_fit, set_up),
        cmocka_unit_test_setup(a_flip_tells_the_matrix, set_up),
        cmocka_unit_test_setup(a_plane_for_all_is_never_hidden, set_up),
        cmocka_unit_test_setup(a_buffer_holds_each_format, set_up),
        cmocka_unit_test_setup(a_refused_format_leaves_nothing, set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
