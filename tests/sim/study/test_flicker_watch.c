// SPDX-License-Identifier: Apache-2.0
// A watched method: nothing flickers for a viewer who stands, and each frame is seen from its own place.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/study/flicker_watch.h"
#include "sim/study/study_image.h"

enum { WIDTH = 64, HEIGHT = 36, FRAMES = 5 };

typedef struct {
    study_scene_t scene;
    image_t picture;
    flicker_watch_t watch;
} bench_t;

static void bench_open(bench_t *bench, const char *method, double speed_m_s)
{
    const study_sizes_t sizes = {WIDTH, HEIGHT, WIDTH, HEIGHT};
    study_scene(&bench->scene, &sizes);
    assert_true(study_image(STUDY_COFFEE, WIDTH, HEIGHT, 1, &bench->picture, NULL));
    bench->watch = (flicker_watch_t){.scene = &bench->scene,
                                     .picture = &bench->picture,
                                     .method = warp_method_from_name(method),
                                     .walk = {study_pose(0.0), speed_m_s, 0.0, 0.0},
                                     .frames = FRAMES,
                                     .looks = 4};
}

static void a_viewer_who_stands_sees_the_picture(void **state)
{
    (void)state;
    bench_t bench;
    flicker_sums_t sums;
    bench_open(&bench, "none+nearest", 0.0);
    assert_true(flicker_watch(&sums, &bench.watch));
    const int32_t inside = (WIDTH - 2 * 3) * (HEIGHT - 2 * 3); /* without the margin */
    assert_int_equal(sums.pixels, (FRAMES - 1) * inside);
    assert_int_equal(sums.change, 0);
    assert_true(flicker_sharpness(&sums) == 1.0);
    free(bench.picture.data);
}

/* The wall's mask at a frame, seen from where the viewer then is: in the middle of the walk before the wall's centre.
 */
static void mask_at(uint8_t mask[WIDTH * HEIGHT], const flicker_watch_t *watch, int32_t frame)
{
    const pose_t pose = study_walk_pose(&watch->walk, (frame - FRAMES / 2) / flicker_watch_hz);
    homography_t homography;
    double_homography_t seen;
    assert_true(homography_from_pose(&homography, &watch->scene->camera, &watch->scene->wall, &pose));
    double_homography_from_fixed(&seen, &homography);
    memset(mask, 1, WIDTH * HEIGHT);
    flicker_mask(mask, &seen, flicker_watch_margin_px);
}

static void a_viewer_who_runs_sees_change_where_both_frames_show_the_wall(void **state)
{
    (void)state;
    bench_t bench;
    flicker_sums_t sums;
    bench_open(&bench, "none+nearest", 20.0);
    assert_true(flicker_watch(&sums, &bench.watch));
    int64_t expected = 0;
    for (int32_t frame = 1; frame < FRAMES; frame++) {
        uint8_t before[WIDTH * HEIGHT], now[WIDTH * HEIGHT];
        mask_at(before, &bench.watch, frame - 1);
        mask_at(now, &bench.watch, frame);
        for (int n = 0; n < WIDTH * HEIGHT; n++)
            expected += before[n] & now[n];
    }
    assert_int_equal(sums.pixels, expected);
    assert_true(flicker_level(&sums) > 1.0);
    assert_true(flicker_sharpness(&sums) < 0.9);
    free(bench.picture.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_viewer_who_stands_sees_the_picture),
        cmocka_unit_test(a_viewer_who_runs_sees_change_where_both_frames_show_the_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
