// SPDX-License-Identifier: Apache-2.0
// Advice for one wall: which places count, the range of k, gaps against a measurement done apart.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/leaves_picture.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/eval/wall_advice.h"
#include "sim/eval/wall_place.h"
#include "sim/eval/warp_once.h"

static const double down_is_y[3] = {0, -1, 0};

/* A picture of 160 x 90 px times `size`, as wide as the 4 m wall at 2.5 m. */
static camera_t camera_of(int32_t size)
{
    return (camera_t){160 * size, 90 * size, {100000000 * size, 100000000 * size}, {80000000 * size, 45000000 * size}};
}

/* A wall of 4 m x 2.25 m around the origin, its front to -z, lit by 160 x 90 px times `size`. */
static room_board_t board_of(int32_t size)
{
    static const int32_t corner_um[4][3] = {
        {-2000000, -1125000, 0}, {2000000, -1125000, 0}, {2000000, 1125000, 0}, {-2000000, 1125000, 0}};
    room_board_t board = {.name = "front", .method = warp_method_default()};
    ls_weights_init(&board.ls_weights);
    board.corners = (wall_corners_t){.panel_width = 160 * size, .panel_height = 90 * size};
    memcpy(board.corners.corner_um, corner_um, sizeof corner_um);
    for (int c = 0; c < 4; c++)
        board.corners.corner_known[c] = true;
    assert_int_equal(wall_from_corners(&board.wall, &board.corners), WALL_OK);
    return board;
}

static wall_advice_t survey(const room_board_t *board, const camera_t *camera, double (*eye_mm)[3], int32_t eyes)
{
    advice_walk_t walk = {.camera = camera, .eye_mm = eye_mm, .eyes = eyes};
    memcpy(walk.up, down_is_y, sizeof walk.up);
    wall_advice_t advice;
    assert_true(wall_advice_survey(&advice, board, &walk));
    return advice;
}

/* Straight on, k is the ratio of pixel sizes: 2.5 m over the distance. */
static void places_give_the_range_of_k(void **state)
{
    (void)state;
    const camera_t camera = camera_of(1);
    const room_board_t board = board_of(1);
    double eye_mm[7][3] = {{0, 0, -2500}, {0, 0, -1250}, {0, 0, -5000}, {300, 20, -299},
                           {0, 0, 2500},  {0, 0, 299},   {0, 0, -2000}};
    const wall_advice_t advice = survey(&board, &camera, eye_mm, 7);
    assert_ptr_equal(advice.board, &board);
    assert_int_equal(advice.too_near, 2);
    assert_int_equal(advice.unseen, 0);
    assert_int_equal(advice.from_behind, 1);
    assert_int_equal(advice.places, 5);
    assert_true(fabs(advice.k[ADVICE_LEAST_K] - 0.5) < 1e-3);
    assert_true(fabs(advice.k[ADVICE_MEDIAN_K] - 1.0) < 1e-3);
    assert_true(fabs(advice.k[ADVICE_LARGEST_K] - 2.0) < 1e-3);
    assert_int_equal(advice.pose[ADVICE_LEAST_K].eye_nm[2], -5000000000);
    assert_int_equal(advice.pose[ADVICE_LARGEST_K].eye_nm[2], -1250000000);
}

static void wall_with_no_place_has_no_numbers(void **state)
{
    (void)state;
    const camera_t camera = camera_of(1);
    const room_board_t board = board_of(1);
    double eye_mm[1][3] = {{5000, 0, 100}};
    wall_advice_t advice = survey(&board, &camera, eye_mm, 1);
    assert_int_equal(advice.too_near, 1);
    assert_int_equal(advice.places, 0);
    assert_true(wall_advice_measure(&advice, &camera, NULL, NULL));
}

/* The board's choice of step: from the side, k over the whole wall is larger than over what is in a narrow picture. */
static void k_is_what_the_board_takes(void **state)
{
    (void)state;
    camera_t camera = camera_of(1);
    camera.width = 40;
    camera.principal_upx[0] = 20000000;
    room_board_t board = board_of(1);
    double eye_mm[1][3] = {{1800, 0, -1000}};
    const double k_in = survey(&board, &camera, eye_mm, 1).k[ADVICE_MEDIAN_K];
    board.step_all = true;
    const double k_all = survey(&board, &camera, eye_mm, 1).k[ADVICE_MEDIAN_K];
    assert_true(k_in > 0.0 && k_all > 1.1 * k_in);
}

/* The same numbers by hand: one place, sizes that need not be made smaller. */
static void check_gaps(double eye_mm[1][3], int32_t factor)
{
    const camera_t camera = camera_of(1);
    const room_board_t board = board_of(1);
    wall_advice_t advice = survey(&board, &camera, eye_mm, 1);
    assert_true(wall_advice_measure(&advice, &camera, NULL, NULL));

    image_t picture, original, panel, limit;
    assert_true(leaves_picture(camera.width, camera.height, ADVICE_FINER, &picture, &original));
    warp_once_t once = {
        .camera = camera, .board = board, .kernels = warp_kernels_best(), .warp = malloc(sizeof *once.warp)};
    assert_non_null(once.warp);
    assert_true(homography_from_pose(&once.homography, &camera, &board.wall, &advice.pose[0]));
    assert_true(warp_once_panel(&once, IMAGE_GRAY8, &panel) && warp_once_panel(&once, IMAGE_GRAY8, &limit));
    double_homography_t homography;
    double_homography_from_fixed(&homography, &once.homography);
    for (int finer = 0; finer < 2; finer++) {
        mesh_t mesh;
        char error[FILE_ERROR_LENGTH];
        assert_true(mesh_sample(&mesh, &homography, finer ? &original : &picture, factor, error));
        mesh_limit(&mesh, &limit);
        for (int m = 0; m < WARP_METHODS; m++) {
            assert_true(warp_once(&once, &warp_methods[m], &panel, &picture));
            const double expected = mesh_psnr_db(&mesh, &limit) - mesh_psnr_db(&mesh, &panel);
            const double got = finer ? advice.gap_original_db[m] : advice.gap_db[m];
            if (!(expected > 0.0 && fabs(got - expected) < 1e-9))
                fail_msg("%s: gap %f dB, expected %f", warp_methods[m].name, got, expected);
        }
        mesh_free(&mesh);
    }
    warp_once_close(&once);
    free(picture.data);
    free(original.data);
    free(panel.data);
    free(limit.data);
}

static void gaps_are_those_of_the_mesh(void **state)
{
    (void)state;
    double aside_mm[1][3] = {{-1500, 300, -1800}}, far_mm[1][3] = {{300, 100, -7000}};
    check_gaps(aside_mm, 4);
    check_gaps(far_mm, 16);
}

/* auto costs what it chooses. */
static void cost_of_auto_is_its_choices(void **state)
{
    (void)state;
    const camera_t camera = camera_of(1);
    const room_board_t board = board_of(1);
    double eye_mm[2][1][3] = {{{0, 0, -3000}}, {{0, 0, -2000}}};
    static const char *const choice[2] = {"mean+spline", "mean+cubic"};
    const ptrdiff_t automatic = warp_method_from_name("auto") - warp_methods;
    for (int n = 0; n < 2; n++) {
        wall_advice_t advice = survey(&board, &camera, eye_mm[n], 1);
        assert_true(wall_advice_measure(&advice, &camera, NULL, NULL));
        const warp_method_t *chosen = wall_advice_auto(advice.k[0]);
        assert_string_equal(chosen->name, choice[n]);
        assert_true(advice.cost[automatic] == advice.cost[chosen - warp_methods]);
        assert_true(advice.gap_original_db[automatic] == advice.gap_original_db[chosen - warp_methods]);
    }
}

static void count_methods(void *context, const wall_advice_t *advice, int32_t method)
{
    (void)advice;
    int32_t *next = context;
    assert_int_equal(method, *next);
    (*next)++;
}

/* Ten times as many pixels in picture and projector: both are brought to the same size as a room three times as fine.
 */
static void large_sizes_are_made_smaller_alike(void **state)
{
    (void)state;
    wall_advice_t advice[2];
    const int32_t sizes[2] = {3, 10};
    for (int n = 0; n < 2; n++) {
        const camera_t camera = camera_of(sizes[n]);
        room_board_t board = board_of(sizes[n]);
        for (int32_t i = 0; i < camera.width; i++) /* the left quarter weighs less */
            board.ls_weights.x[i] = 4 * i < camera.width ? LS_WEIGHT_ONE / 100 : LS_WEIGHT_ONE;
        double eye_mm[1][3] = {{1500, 0, -1500}};
        advice[n] = survey(&board, &camera, eye_mm, 1);
        int32_t methods = 0;
        assert_true(wall_advice_measure(&advice[n], &camera, count_methods, &methods));
        assert_int_equal(methods, WARP_METHODS);
    }
    assert_true(fabs(advice[0].k[0] - advice[1].k[0]) < 0.01 * advice[0].k[0]);
    for (int m = 0; m < WARP_METHODS; m++)
        if (!(fabs(advice[0].gap_db[m] - advice[1].gap_db[m]) < 1e-6 &&
              fabs(advice[0].gap_original_db[m] - advice[1].gap_original_db[m]) < 1e-6))
            fail_msg("%s: gaps %f and %f dB at one size, %f and %f at another", warp_methods[m].name,
                     advice[0].gap_db[m], advice[0].gap_original_db[m], advice[1].gap_db[m],
                     advice[1].gap_original_db[m]);
}

/* A projector so fine that the limit is exact still has finite gaps, and methods that are exact have none. */
static void gaps_are_finite_where_the_limit_is_exact(void **state)
{
    (void)state;
    camera_t camera = camera_of(1);
    const room_board_t board = board_of(2);
    double far_mm[1][3] = {{0, 0, -50000}};
    wall_advice_t advice = survey(&board, &camera, far_mm, 1);
    assert_true(wall_advice_measure(&advice, &camera, NULL, NULL));
    for (int m = 0; m < WARP_METHODS; m++)
        assert_true(advice.gap_db[m] >= 0.0 && advice.gap_db[m] < advice_exact_db);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_give_the_range_of_k),
        cmocka_unit_test(wall_with_no_place_has_no_numbers),
        cmocka_unit_test(k_is_what_the_board_takes),
        cmocka_unit_test(gaps_are_those_of_the_mesh),
        cmocka_unit_test(cost_of_auto_is_its_choices),
        cmocka_unit_test(large_sizes_are_made_smaller_alike),
        cmocka_unit_test(gaps_are_finite_where_the_limit_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
