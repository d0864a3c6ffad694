// SPDX-License-Identifier: Apache-2.0
// Uneven pixels and walls: their light, and PSNR with them where it is known.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/double_view.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/eval/pixel_view.h"
#include "sim/study/study_scene.h"
#include "tests/support/rng.h"

enum { WIDTH = 32, HEIGHT = 18, PIXELS = WIDTH * HEIGHT, FACTOR = 8, SEED = 5 };

static const pixel_model_t ideal = {{1.0, 0.0}, {1.0, 0.0, 1.0, {0.0, 0.0, -6.0}}};

static void profile_has_mean_one(void **state)
{
    (void)state;
    for (double fill = 0.1; fill <= 1.0; fill += 0.1)
        for (double falloff = 0.0; falloff <= 1.0; falloff += 0.25) {
            const pixel_profile_t profile = {fill, falloff};
            if (fabs(pixel_profile_mean(&profile, 3.0, 4.0) - 1.0) > 1e-12 ||
                fabs(pixel_profile_mean(&profile, -0.3, 4.7) - 1.0) > 1e-12)
                fail_msg("fill %g, falloff %g: %.15f", fill, falloff, pixel_profile_mean(&profile, 3.0, 4.0));
        }
}

static void profile_is_as_described(void **state)
{
    (void)state;
    for (double fill = 0.25; fill <= 1.0; fill += 0.25)
        for (double falloff = 0.0; falloff <= 1.0; falloff += 0.5)
            for (double x = 0.005; x < 1.0; x += 0.01) {
                const pixel_profile_t profile = {fill, falloff};
                const double from_middle = x - 0.5;
                if (fabs(fabs(from_middle) - fill / 2) < 1e-4)
                    continue; /* the edge of the lit part */
                const double expected =
                    fabs(from_middle) > fill / 2 ? 0.0 : (1.0 + falloff * cos(2.0 * M_PI * from_middle / fill)) / fill;
                const double light = pixel_profile_mean(&profile, 7.0 + x - 1e-5, 7.0 + x + 1e-5);
                if (fabs(light - expected) > 1e-4)
                    fail_msg("fill %g, falloff %g, x %g: %g, expected %g", fill, falloff, x, light, expected);
            }
}

static void gain_is_symmetric(void **state)
{
    (void)state;
    rng_t rng = {SEED};
    for (int n = 0; n < 200; n++) {
        double p[4][3];
        for (int k = 0; k < 12; k++)
            p[k / 3][k % 3] = rng_double(&rng, -3, 3);
        pixel_screen_t screen = {0.3, 1.7, 5.0, {p[0][0], p[0][1], p[0][2]}};
        const double there = pixel_screen_gain(&screen, p[1], p[2], p[3]);
        memcpy(screen.projector_m, p[3], sizeof screen.projector_m);
        const double back = pixel_screen_gain(&screen, p[1], p[2], p[0]);
        const double other_side[3] = {-p[2][0], -p[2][1], -p[2][2]};
        if (fabs(there - back) > 1e-9 || fabs(pixel_screen_gain(&screen, p[1], other_side, p[0]) - back) > 1e-9)
            fail_msg("seed %d, case %d: %g and %g", SEED, n, there, back);
    }
}

static void lobe_is_where_a_mirror_throws_it(void **state)
{
    (void)state;
    const double at[3] = {0, 0, 0}, normal[3] = {0, 0, 2};
    const pixel_screen_t screen = {0.4, 1.6, 2.0, {3, 0, -4}};
    assert_true(fabs(pixel_screen_gain(&screen, at, normal, (const double[3]){-6, 0, -8}) - 2.0) < 1e-12);
    /* 60 degrees off it: cos^2 is a quarter */
    const double turn = atan2(-3, -4) + M_PI / 3;
    assert_true(fabs(pixel_screen_gain(&screen, at, normal, (const double[3]){sin(turn), 0, cos(turn)}) - 0.8) < 1e-12);
    /* behind it */
    assert_true(fabs(pixel_screen_gain(&screen, at, normal, (const double[3]){6, 0, 8}) - 0.4) < 1e-12);
}

typedef struct {
    uint8_t picture[PIXELS], panel[PIXELS];
    study_scene_t scene;
    double_homography_t homography;
    double_view_t eye;
} bench_t;

static image_t image_of(uint8_t *data)
{
    return (image_t){.data = data, .width = WIDTH, .height = HEIGHT, .stride = WIDTH, .format = IMAGE_GRAY8};
}

static void bench_at(bench_t *bench, double angle_deg)
{
    const pose_t pose = study_pose(angle_deg);
    homography_t homography;
    rng_t rng = {SEED};
    for (int n = 0; n < PIXELS; n++) {
        bench->picture[n] = (uint8_t)rng_int(&rng, 0, 255);
        bench->panel[n] = (uint8_t)rng_int(&rng, 0, 255);
    }
    study_scene(&bench->scene, &(study_sizes_t){WIDTH, HEIGHT, WIDTH, HEIGHT});
    assert_true(homography_from_pose(&homography, &bench->scene.camera, &bench->scene.wall, &pose));
    double_homography_from_fixed(&bench->homography, &homography);
    double_view(&bench->eye, &bench->scene.camera, &pose);
}

static pixel_psnr_t psnr_of(bench_t *bench, const pixel_model_t *model)
{
    pixel_view_t view;
    assert_true(pixel_view(&view, &bench->homography, &bench->scene.wall, bench->eye.eye_m, model, FACTOR));
    const image_t panel = image_of(bench->panel), picture = image_of(bench->picture);
    const pixel_psnr_t psnr = pixel_view_psnr(&view, &panel, &picture);
    pixel_view_free(&view);
    return psnr;
}

static void ideal_pixels_are_the_mesh_evaluation(void **state)
{
    (void)state;
    for (int angle = 5; angle <= 65; angle += 15) {
        bench_t bench;
        bench_at(&bench, angle);
        mesh_t mesh;
        char error[FILE_ERROR_LENGTH];
        const image_t panel = image_of(bench.panel), picture = image_of(bench.picture);
        assert_true(mesh_sample(&mesh, &bench.homography, &picture, FACTOR, error));
        const double expected_db = mesh_psnr_db(&mesh, &panel);
        mesh_free(&mesh);
        const pixel_psnr_t psnr = psnr_of(&bench, &ideal);
        if (fabs(psnr.fine - expected_db) > 1e-6 || !(psnr.eye > psnr.fine) || fabs(psnr.eye - psnr.uneven) > 1e-9)
            fail_msg("angle %d: %g and %g dB, the mesh has %g", angle, psnr.fine, psnr.eye, expected_db);
    }
}

/* A picture and a panel of one gray level: what is off is the light alone. */
static void gaps_cost_what_their_light_says(void **state)
{
    (void)state;
    bench_t bench;
    bench_at(&bench, 0.0);
    memset(bench.picture, 100, PIXELS);
    memset(bench.panel, 100, PIXELS);
    pixel_model_t gaps = ideal;
    gaps.profile.fill = 0.5;
    const pixel_psnr_t psnr = psnr_of(&bench, &gaps);
    /* a quarter has 4 times the light, the rest none: the mean of (light - 1)^2 is 3 */
    assert_true(fabs(psnr.fine - 10.0 * log10(255.0 * 255.0 / 30000.0)) < 0.01);
    assert_true(psnr.eye > 60.0); /* each pixel's mean is right, and that is all that the eye sees */
}

/* One column is 16 too bright: over half pixels 16 16, which the blur makes 1 5 10 10 5 1. */
static void eye_blurs_as_described(void **state)
{
    (void)state;
    bench_t bench;
    bench_at(&bench, 0.0);
    memset(bench.picture, 100, PIXELS);
    for (int n = 0; n < PIXELS; n++)
        bench.panel[n] = n % WIDTH == 9 ? 116 : 100;
    const double square = 1 + 25 + 100 + 100 + 25 + 1;
    assert_true(fabs(psnr_of(&bench, &ideal).eye - 10.0 * log10(255.0 * 255.0 * (2 * WIDTH - 4) / square)) < 1e-6);
}

/* All is 10 too bright. What is beside the wall must not count as right. */
static void only_covered_places_count(void **state)
{
    (void)state;
    bench_t bench;
    bench_at(&bench, 50.0);
    memset(bench.picture, 100, PIXELS);
    memset(bench.panel, 110, PIXELS);
    const pixel_psnr_t psnr = psnr_of(&bench, &ideal);
    const double expected_db = 10.0 * log10(255.0 * 255.0 / 100.0);
    assert_true(fabs(psnr.eye - expected_db) < 1e-6 && fabs(psnr.fine - expected_db) < 1e-6);
}

static void shine_is_forgiven_except_against_an_even_wall(void **state)
{
    (void)state;
    bench_t bench;
    bench_at(&bench, 40.0);
    memset(bench.picture, 100, PIXELS);
    memset(bench.panel, 100, PIXELS);
    pixel_model_t shining = ideal;
    shining.screen.lobe = 2.0;
    shining.screen.exponent = 8.0;
    const pixel_psnr_t psnr = psnr_of(&bench, &shining);
    assert_true(psnr.fine > 100.0 && psnr.eye > 100.0);
    assert_true(psnr.uneven < 30.0);
    /* a wall that is evenly brighter is no brighter to an eye that adapts */
    shining.screen.lobe = 0.0;
    shining.screen.diffuse = 3.0;
    assert_true(psnr_of(&bench, &shining).uneven > 100.0);
}

static void nothing_covered_is_infinite(void **state)
{
    (void)state;
    bench_t bench;
    bench_at(&bench, 0.0);
    memset(bench.homography.panel_from_picture, 0, sizeof bench.homography.panel_from_picture);
    const pixel_psnr_t psnr = psnr_of(&bench, &ideal);
    assert_true(isinf(psnr.fine) && isinf(psnr.eye) && isinf(psnr.uneven));
}

static void view_projects_where_the_homography_says(void **state)
{
    (void)state;
    bench_t bench;
    bench_at(&bench, 35.0);
    double_wall_t wall;
    double_wall(&wall, &bench.scene.wall);
    for (int n = 0; n <= 20; n++) {
        const double uv[2] = {n * WIDTH / 20.0, HEIGHT - n * HEIGHT / 20.0};
        double point_m[3], xy[2], ray[3], back[3];
        double_wall_point(&wall, uv, point_m);
        assert_true(double_view_project(&bench.eye, point_m, xy));
        for (int r = 0; r < 3; r++) {
            const double *row = bench.homography.panel_from_picture[r];
            back[r] = row[0] * xy[0] + row[1] * xy[1] + row[2];
        }
        assert_true(fabs(back[0] / back[2] - uv[0]) < 1e-6 && fabs(back[1] / back[2] - uv[1]) < 1e-6);
        double_view_ray(&bench.eye, xy, ray);
        const double along = (point_m[2] - bench.eye.eye_m[2]) / ray[2];
        for (int i = 0; i < 3; i++)
            assert_true(fabs(bench.eye.eye_m[i] + along * ray[i] - point_m[i]) < 1e-6);
    }
    double xy[2] = {7.0, 7.0};
    const double behind[3] = {bench.eye.eye_m[0] * 2, bench.eye.eye_m[1] * 2, bench.eye.eye_m[2] * 2};
    assert_false(double_view_project(&bench.eye, behind, xy));
    assert_true(xy[0] == 7.0 && xy[1] == 7.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(profile_has_mean_one),
        cmocka_unit_test(profile_is_as_described),
        cmocka_unit_test(gain_is_symmetric),
        cmocka_unit_test(lobe_is_where_a_mirror_throws_it),
        cmocka_unit_test(ideal_pixels_are_the_mesh_evaluation),
        cmocka_unit_test(gaps_cost_what_their_light_says),
        cmocka_unit_test(eye_blurs_as_described),
        cmocka_unit_test(only_covered_places_count),
        cmocka_unit_test(shine_is_forgiven_except_against_an_even_wall),
        cmocka_unit_test(nothing_covered_is_infinite),
        cmocka_unit_test(view_projects_where_the_homography_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
