// SPDX-License-Identifier: Apache-2.0
// The mesh evaluation against hand-made cases and a sample-by-sample count.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sim/eval/mesh_psnr.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"

enum { MAX_PIXELS = 64 * 64 };

static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static image_t gray(uint8_t *data, int32_t width, int32_t height)
{
    return (image_t){.data = data, .width = width, .height = height, .stride = width, .format = IMAGE_GRAY8};
}

static double_homography_t mapping(const double rows[9], homography_sizes_t sizes)
{
    const homography_t fixed = homography_of(rows, sizes);
    double_homography_t homography;
    double_homography_from_fixed(&homography, &fixed);
    return homography;
}

static void assert_db(const char *name, double got, double mean_square)
{
    const double expected = 10.0 * log10(255.0 * 255.0 / mean_square);
    if (!(fabs(got - expected) < 1e-9))
        fail_msg("%s: %.12f dB, expected %.12f", name, got, expected);
}

static mesh_t sample(const double rows[9], homography_sizes_t sizes, const image_t *truth, int32_t factor)
{
    const double_homography_t homography = mapping(rows, sizes);
    mesh_t mesh;
    char error[256] = "";
    if (!mesh_sample(&mesh, &homography, truth, factor, error))
        fail_msg("%s", error);
    return mesh;
}

static void same_picture_is_perfect(void **state)
{
    (void)state;
    uint8_t pixels[6] = {0, 255, 7, 80, 90, 200};
    const image_t picture = gray(pixels, 3, 2);
    mesh_t mesh = sample(identity, (homography_sizes_t){3, 2, 3, 2}, &picture, 4);
    assert_int_equal(mesh.samples, 6 * 16);
    assert_int_equal(mesh.covered, 6 * 16);
    assert_true(mesh_coverage(&mesh) == 1.0);
    for (int p = 0; p < 6; p++) {
        assert_int_equal(mesh.cell[p].count, 16);
        assert_int_equal(mesh.cell[p].sum, 16 * pixels[p]);
    }
    assert_true(isinf(mesh_psnr_db(&mesh, &picture)));
    uint8_t best[6];
    const image_t limit = gray(best, 3, 2);
    mesh_limit(&mesh, &limit);
    assert_memory_equal(best, pixels, 6);
    pixels[1] = 254; /* the panel is one level off in 1 of 6 pixels */
    assert_db("one level off", mesh_psnr_db(&mesh, &picture), 1.0 / 6.0);
    mesh_free(&mesh);
}

static void panel_twice_as_fine_has_its_pixels_in_place(void **state)
{
    (void)state;
    const double half[9] = {0.5, 0, 0, 0, 1, 0, 0, 0, 1};
    uint8_t pixels[2] = {10, 30}, right[4] = {10, 10, 30, 30}, slipped[4] = {10, 10, 10, 30};
    const image_t picture = gray(pixels, 2, 1), panel = gray(right, 4, 1), wrong = gray(slipped, 4, 1);
    mesh_t mesh = sample(half, (homography_sizes_t){4, 1, 2, 1}, &picture, 4);
    assert_true(isinf(mesh_psnr_db(&mesh, &panel)));
    assert_db("slipped by a pixel", mesh_psnr_db(&mesh, &wrong), 400.0 / 4.0);
    mesh_free(&mesh);
}

static void finer_original_is_the_truth(void **state)
{
    (void)state;
    uint8_t finer[8] = {0, 2, 10, 10, 1, 3, 10, 10}, means[2];
    const image_t original = gray(finer, 4, 2), panel = gray(means, 2, 1);
    mesh_t mesh = sample(identity, (homography_sizes_t){2, 1, 2, 1}, &original, 4);
    assert_int_equal(mesh.samples, 32);
    mesh_limit(&mesh, &panel);
    assert_int_equal(means[0], 2); /* 1.5, rounded half up */
    assert_int_equal(means[1], 10);
    assert_db("means of the original", mesh_psnr_db(&mesh, &panel), (4.0 + 0.0 + 1.0 + 1.0) / 8.0);
    mesh_free(&mesh);
}

static void wall_behind_the_viewer_covers_nothing(void **state)
{
    (void)state;
    const double behind[9] = {-1, 0, 0, 0, -1, 0, 0, 0, -1};
    const double edge_on[9] = {1, 0, 0, 2, 0, 0, 0, 0, 1};
    uint8_t pixels[4] = {1, 2, 3, 4}, shown[4] = {9, 9, 9, 9};
    const image_t picture = gray(pixels, 2, 2), panel = gray(shown, 2, 2);
    const homography_sizes_t sizes = {2, 2, 2, 2};
    mesh_t meshes[2] = {sample(behind, sizes, &picture, 2), sample(edge_on, sizes, &picture, 2)};
    for (int m = 0; m < 2; m++) {
        assert_int_equal(meshes[m].covered, 0);
        assert_true(mesh_coverage(&meshes[m]) == 0.0);
        assert_true(isinf(mesh_psnr_db(&meshes[m], &panel)));
        mesh_free(&meshes[m]);
    }
}

/* Of one random case: what to compare the mesh with. */
typedef struct {
    char name[64];
    double rows[9];
    homography_sizes_t sizes;
    int32_t factor, finer;
    uint8_t truth[MAX_PIXELS], shown[MAX_PIXELS];
} random_case_t;

static int32_t random_int(rng_t *rng, int32_t low, int32_t high)
{
    return (int32_t)rng_int(rng, low, high);
}

static double uniform(rng_t *rng, double limit)
{
    return rng_double(rng, -limit, limit);
}

static void make_case(random_case_t *random, uint64_t seed)
{
    rng_t numbers = {seed}, *rng = &numbers;
    const homography_sizes_t sizes = {random_int(rng, 1, 12), random_int(rng, 1, 12), random_int(rng, 1, 12),
                                      random_int(rng, 1, 12)};
    random->sizes = sizes;
    random->finer = random_int(rng, 1, 3);
    random->factor = random->finer * random_int(rng, 1, 3);
    snprintf(random->name, sizeof random->name, "seed %llu, factor %d, finer %d", (unsigned long long)seed,
             random->factor, random->finer);
    const double scale_x = (double)sizes.picture_width / sizes.panel_width;
    const double scale_y = (double)sizes.picture_height / sizes.panel_height;
    /* Depth varies by up to 2 times across the panel each way: often part of it is behind the viewer. */
    const double rows[9] = {
        scale_x + uniform(rng, scale_x),
        uniform(rng, scale_x),
        uniform(rng, 0.3 * sizes.picture_width),
        uniform(rng, scale_y),
        scale_y + uniform(rng, scale_y),
        uniform(rng, 0.3 * sizes.picture_height),
        uniform(rng, 2.0 / sizes.panel_width),
        uniform(rng, 2.0 / sizes.panel_height),
        1.0,
    };
    memcpy(random->rows, rows, sizeof rows);
    for (int p = 0; p < MAX_PIXELS; p++) {
        random->truth[p] = (uint8_t)rng_next(rng);
        random->shown[p] = (uint8_t)rng_next(rng);
    }
}

/* The number of the panel pixel that covers a sample, by solving for it; -1 for none. */
static int32_t pixel_under(const random_case_t *random, long double x, long double y)
{
    /* (row 0 - x row 2) . (u, v, 1) = 0 and (row 1 - y row 2) . (u, v, 1) = 0 */
    long double f[3], g[3], row_2[3];
    for (int k = 0; k < 3; k++) {
        row_2[k] = (long double)random->rows[6 + k];
        f[k] = (long double)random->rows[k] - x * row_2[k];
        g[k] = (long double)random->rows[3 + k] - y * row_2[k];
    }
    const long double determinant = f[0] * g[1] - f[1] * g[0];
    const long double u = (f[1] * g[2] - f[2] * g[1]) / determinant;
    const long double v = (f[2] * g[0] - f[0] * g[2]) / determinant;
    const long double depth = row_2[0] * u + row_2[1] * v + row_2[2];
    const homography_sizes_t sizes = random->sizes;
    if (!(depth > 0 && u >= 0 && v >= 0 && u < sizes.panel_width && v < sizes.panel_height))
        return -1;
    return (int32_t)v * sizes.panel_width + (int32_t)u;
}

static void check_case(const random_case_t *random, const mesh_t *mesh, const image_t *truth)
{
    const homography_sizes_t sizes = random->sizes;
    mesh_cell_t cell[MAX_PIXELS] = {{0, 0}};
    int64_t covered = 0, wrong = 0;
    const int32_t per = random->factor / random->finer;
    for (int32_t y = 0; y < sizes.picture_height * random->factor; y++)
        for (int32_t x = 0; x < sizes.picture_width * random->factor; x++) {
            const int32_t at = pixel_under(random, (x + 0.5L) / random->factor, (y + 0.5L) / random->factor);
            if (at < 0)
                continue;
            const int32_t value = image_row(truth, y / per)[x / per], difference = value - random->shown[at];
            cell[at].count++;
            cell[at].sum += value;
            covered++;
            wrong += difference * difference;
        }
    if (mesh->covered != covered)
        fail_msg("%s: %lld covered, expected %lld", random->name, (long long)mesh->covered, (long long)covered);
    for (int32_t p = 0; p < sizes.panel_width * sizes.panel_height; p++)
        if (mesh->cell[p].count != cell[p].count || mesh->cell[p].sum != cell[p].sum)
            fail_msg("%s: panel pixel %d has %lld samples, sum %lld; expected %lld, %lld", random->name, p,
                     (long long)mesh->cell[p].count, (long long)mesh->cell[p].sum, (long long)cell[p].count,
                     (long long)cell[p].sum);
    uint8_t shown[MAX_PIXELS];
    memcpy(shown, random->shown, sizeof shown);
    const image_t panel = gray(shown, sizes.panel_width, sizes.panel_height);
    if (wrong > 0)
        assert_db(random->name, mesh_psnr_db(mesh, &panel), (double)wrong / (double)covered);
}

/* No pixel one level up or down does better. */
static void check_limit(const random_case_t *random, const mesh_t *mesh)
{
    uint8_t best[MAX_PIXELS];
    const image_t panel = gray(best, random->sizes.panel_width, random->sizes.panel_height);
    mesh_limit(mesh, &panel);
    const double limit_db = mesh_psnr_db(mesh, &panel);
    for (int32_t p = 0; p < panel.width * panel.height; p++)
        for (int change = -1; change <= 1; change += 2) {
            const uint8_t kept = best[p];
            best[p] = (uint8_t)(kept + change);
            if (mesh_psnr_db(mesh, &panel) > limit_db)
                fail_msg("%s: the limit is beaten with %d instead of %d in panel pixel %d", random->name, best[p], kept,
                         p);
            best[p] = kept;
        }
}

static void agrees_with_a_count_by_sample(void **state)
{
    (void)state;
    static random_case_t random;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        make_case(&random, seed);
        const image_t truth =
            gray(random.truth, random.sizes.picture_width * random.finer, random.sizes.picture_height * random.finer);
        mesh_t mesh = sample(random.rows, random.sizes, &truth, random.factor);
        check_case(&random, &mesh, &truth);
        check_limit(&random, &mesh);
        mesh_free(&mesh);
    }
}

static void bad_sizes_are_refused(void **state)
{
    (void)state;
    static const struct {
        int32_t width, height, factor;
        const char *says;
    } bad[] = {
        {4, 4, 0, "factor 0, expected 1 to 64"},
        {4, 4, 65, "factor 65, expected 1 to 64"},
        {4, 3, 4, "4 x 3 pixels, expected a whole multiple of the picture's 4 x 4"},
        {6, 6, 4, "6 x 6 pixels, expected a whole multiple of the picture's 4 x 4"},
        {8, 4, 4, "8 x 4 pixels, expected a whole multiple of the picture's 4 x 4"},
        {2, 2, 4, "2 x 2 pixels, expected a whole multiple of the picture's 4 x 4"},
        {12, 12, 4, "factor 4, expected a multiple of 3: the original is 3 times as fine as the picture"},
    };
    static uint8_t pixels[MAX_PIXELS];
    const double_homography_t homography = mapping(identity, (homography_sizes_t){4, 4, 4, 4});
    for (size_t b = 0; b < sizeof bad / sizeof *bad; b++) {
        const image_t truth = gray(pixels, bad[b].width, bad[b].height);
        mesh_t mesh = {.samples = -1};
        char error[256] = "";
        assert_false(mesh_sample(&mesh, &homography, &truth, bad[b].factor, error));
        assert_string_equal(error, bad[b].says);
        assert_int_equal(mesh.samples, -1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_picture_is_perfect),       cmocka_unit_test(panel_twice_as_fine_has_its_pixels_in_place),
        cmocka_unit_test(finer_original_is_the_truth),   cmocka_unit_test(wall_behind_the_viewer_covers_nothing),
        cmocka_unit_test(agrees_with_a_count_by_sample), cmocka_unit_test(bad_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
