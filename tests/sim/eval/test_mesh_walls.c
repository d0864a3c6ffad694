// SPDX-License-Identifier: Apache-2.0
// The mesh evaluation of several walls in one view, and of one channel of a colour picture.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "sim/eval/mesh_psnr.h"
#include "sim/eval/viewer_picture.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"

enum { PICTURE_WIDTH = 4, PICTURE_HEIGHT = 2, FACTOR = 4, SAMPLES = 4 * 2 * 4 * 4, MAX_RANDOM_WALLS = 6 };

/* A panel of 2 x 2 pixels that covers the picture from x0 to x1, all its height, at a depth in um (< 0: behind). */
static double_homography_t wall_at(double x0, double x1, double depth)
{
    const double rows[9] = {depth * (x1 - x0) / 2, 0, depth * x0, 0, depth * PICTURE_HEIGHT / 2, 0, 0, 0, depth};
    const homography_t fixed = homography_of(rows, (homography_sizes_t){2, 2, PICTURE_WIDTH, PICTURE_HEIGHT});
    double_homography_t homography;
    double_homography_from_fixed(&homography, &fixed);
    return homography;
}

static uint8_t pixels[PICTURE_WIDTH * PICTURE_HEIGHT] = {10, 20, 30, 40, 50, 60, 70, 80};
static const image_t picture = {pixels, PICTURE_WIDTH, PICTURE_HEIGHT, PICTURE_WIDTH, IMAGE_GRAY8};

static void sample(mesh_t *mesh, const double_homography_t *homography, int32_t walls)
{
    char error[FILE_ERROR_LENGTH] = "";
    if (!mesh_sample_walls(mesh, homography, walls, &picture, FACTOR, error))
        fail_msg("%s", error);
}

static void free_meshes(mesh_t *mesh, int32_t walls)
{
    for (int32_t n = 0; n < walls; n++)
        mesh_free(&mesh[n]);
}

static void walls_side_by_side_share_the_view(void **state)
{
    (void)state;
    const double_homography_t walls[2] = {wall_at(0, 1, 2e6), wall_at(1, 4, 1e6)};
    mesh_t mesh[2];
    sample(mesh, walls, 2);
    assert_int_equal(mesh[0].covered, SAMPLES / 4);
    assert_int_equal(mesh[1].covered, SAMPLES * 3 / 4);
    assert_int_equal(mesh[0].samples, SAMPLES);
    assert_int_equal(mesh[1].samples, SAMPLES);
    /* Each of the first wall's pixels is half a picture pixel wide. */
    const int64_t sum[4] = {8 * 10, 8 * 10, 8 * 50, 8 * 50};
    for (int p = 0; p < 4; p++) {
        assert_int_equal(mesh[0].cell[p].count, 8);
        assert_int_equal(mesh[0].cell[p].sum, sum[p]);
    }
    assert_int_equal(mesh[0].sum_of_squares, 16 * (10 * 10 + 50 * 50));
    assert_int_equal(mesh[1].cell[0].sum, 16 * 20 + 8 * 30);
    free_meshes(mesh, 2);
}

static void near_wall_hides_the_far_one(void **state)
{
    (void)state;
    const double_homography_t far_wall = wall_at(0, 4, 3e6), near_wall = wall_at(1, 3, 2e6);
    for (int near_first = 0; near_first < 2; near_first++) {
        const double_homography_t walls[2] = {near_first ? near_wall : far_wall, near_first ? far_wall : near_wall};
        mesh_t mesh[2];
        sample(mesh, walls, 2);
        const mesh_t *far_mesh = &mesh[near_first], *near_mesh = &mesh[1 - near_first];
        assert_int_equal(far_mesh->covered, SAMPLES / 2);
        assert_int_equal(near_mesh->covered, SAMPLES / 2);
        assert_int_equal(far_mesh->cell[0].sum, 16 * 10); /* the near wall has the 20 */
        assert_int_equal(near_mesh->cell[0].sum, 16 * 20);
        free_meshes(mesh, 2);
    }
}

static void first_of_equally_near_walls_has_the_sample(void **state)
{
    (void)state;
    const double_homography_t walls[2] = {wall_at(0, 4, 2e6), wall_at(0, 4, 2e6)};
    mesh_t mesh[2];
    sample(mesh, walls, 2);
    assert_int_equal(mesh[0].covered, SAMPLES);
    assert_int_equal(mesh[1].covered, 0);
    free_meshes(mesh, 2);
}

static void wall_behind_the_viewer_hides_nothing(void **state)
{
    (void)state;
    const double_homography_t walls[2] = {wall_at(0, 4, -1e6), wall_at(0, 4, 3e6)};
    mesh_t mesh[2];
    sample(mesh, walls, 2);
    assert_int_equal(mesh[0].covered, 0);
    assert_int_equal(mesh[1].covered, SAMPLES);
    free_meshes(mesh, 2);
}

static void errors_of_walls_add_up(void **state)
{
    (void)state;
    const double_homography_t walls[2] = {wall_at(0, 2, 1e6), wall_at(2, 4, 1e6)};
    uint8_t left[4] = {10, 20, 50, 63}, right[4] = {30, 40, 74, 80};
    const image_t left_panel = {left, 2, 2, 2, IMAGE_GRAY8}, right_panel = {right, 2, 2, 2, IMAGE_GRAY8};
    mesh_t mesh[2];
    sample(mesh, walls, 2);
    const int64_t error = mesh_square_error(&mesh[0], &left_panel) + mesh_square_error(&mesh[1], &right_panel);
    assert_int_equal(error, 16 * (3 * 3 + 4 * 4));
    const double db = mesh_db((double)error, mesh[0].covered + mesh[1].covered);
    assert_true(fabs(db - 10.0 * log10(255.0 * 255.0 * 8 / 25)) < 1e-9);
    assert_true(isinf(mesh_db(0, 0)));
    free_meshes(mesh, 2);
}

/* One channel of a colour picture and panel counts as a gray picture of its values would. */
static void channel_counts_alone(void **state)
{
    (void)state;
    const double_homography_t wall = wall_at(0, 4, 1e6);
    uint8_t gray[4] = {9, 99, 55, 70}, xrgb[16], truth[4 * PICTURE_WIDTH * PICTURE_HEIGHT];
    const image_t gray_panel = {gray, 2, 2, 2, IMAGE_GRAY8}, panel = {xrgb, 2, 2, 8, IMAGE_XRGB8888};
    const image_t colour = {truth, PICTURE_WIDTH, PICTURE_HEIGHT, 4 * PICTURE_WIDTH, IMAGE_XRGB8888};
    mesh_t expected, mesh;
    sample(&expected, &wall, 1);
    for (int byte = 0; byte < 4; byte++) {
        memset(truth, 200, sizeof truth);
        memset(xrgb, 100, sizeof xrgb);
        for (int p = 0; p < PICTURE_WIDTH * PICTURE_HEIGHT; p++)
            truth[4 * p + byte] = pixels[p];
        for (int p = 0; p < 4; p++)
            xrgb[4 * p + byte] = gray[p];
        const image_t one = mesh_channel(&colour, byte), shown = mesh_channel(&panel, byte);
        char error[FILE_ERROR_LENGTH];
        assert_true(mesh_sample_walls(&mesh, &wall, 1, &one, FACTOR, error));
        assert_memory_equal(mesh.cell, expected.cell, 4 * sizeof *mesh.cell);
        assert_int_equal(mesh_square_error(&mesh, &shown), mesh_square_error(&expected, &gray_panel));
        mesh_limit(&mesh, &shown);
        for (int p = 0; p < 16; p++)
            if (p % 4 != byte)
                assert_int_equal(xrgb[p], 100);
        assert_int_equal(xrgb[byte], 15);
        mesh_free(&mesh);
    }
    mesh_free(&expected);
}

/* What the eye of viewer_picture() sees: walls that show their number, one look per sample. */
static void agrees_with_the_viewers_eye(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        rng_t rng = {seed};
        const int32_t walls = (int32_t)rng_int(&rng, 1, MAX_RANDOM_WALLS);
        double_homography_t homography[MAX_RANDOM_WALLS];
        viewer_wall_t shown[MAX_RANDOM_WALLS];
        uint8_t number[MAX_RANDOM_WALLS], seen[SAMPLES];
        for (int32_t n = 0; n < walls; n++) {
            double rows[9];
            for (int r = 0; r < 9; r++)
                rows[r] = rng_double(&rng, -2e6, 2e6);
            rows[8] = 2e6; /* most of them at least partly before the viewer */
            const homography_t fixed = homography_of(rows, (homography_sizes_t){2, 2, PICTURE_WIDTH, PICTURE_HEIGHT});
            double_homography_from_fixed(&homography[n], &fixed);
            number[n] = (uint8_t)(100 + n);
            shown[n] = (viewer_wall_t){homography[n], {&number[n], 1, 1, 1, IMAGE_GRAY8}};
        }
        const image_t view = {seen, PICTURE_WIDTH * FACTOR, PICTURE_HEIGHT * FACTOR, PICTURE_WIDTH * FACTOR,
                              IMAGE_GRAY8};
        viewer_picture(&view, shown, walls, 1);
        mesh_t mesh[MAX_RANDOM_WALLS];
        sample(mesh, homography, walls);
        for (int32_t n = 0; n < walls; n++) {
            int64_t looks = 0;
            for (int s = 0; s < SAMPLES; s++)
                looks += seen[s] == number[n];
            if (mesh[n].covered != looks)
                fail_msg("seed %llu: wall %d of %d has %lld samples, the eye gives it %lld looks",
                         (unsigned long long)seed, n, walls, (long long)mesh[n].covered, (long long)looks);
        }
        free_meshes(mesh, walls);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_side_by_side_share_the_view),
        cmocka_unit_test(near_wall_hides_the_far_one),
        cmocka_unit_test(first_of_equally_near_walls_has_the_sample),
        cmocka_unit_test(wall_behind_the_viewer_hides_nothing),
        cmocka_unit_test(errors_of_walls_add_up),
        cmocka_unit_test(channel_counts_alone),
        cmocka_unit_test(agrees_with_the_viewers_eye),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
