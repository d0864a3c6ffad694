// SPDX-License-Identifier: Apache-2.0
// The error by footprint: all bins together are the whole error, and areas are those that samples measure.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "sim/study/footprints_bins.h"
#include "sim/study/study_mesh.h"

/* The mean squared error of a method, once from PSNR and once from the bins and the exact means. */
static void bins_sum_up(const study_mesh_t *mesh, study_truth_t truth)
{
    const mesh_t *sampled = &mesh->mesh[truth];
    footprints_bin_t bin[FOOTPRINTS_BINS];
    footprints_bins(bin, sampled, &mesh->exact, &mesh->panel);
    double error = (double)sampled->sum_of_squares;
    int64_t pixels = 0, seen = 0, samples = 0;
    for (int32_t c = 0; c < sampled->panel_width * sampled->panel_height; c++)
        if (sampled->cell[c].count > 0) {
            error -= (double)sampled->cell[c].sum * (double)sampled->cell[c].sum / (double)sampled->cell[c].count;
            seen++;
        }
    for (int b = 0; b < FOOTPRINTS_BINS; b++) {
        error += bin[b].error;
        pixels += bin[b].pixels;
        samples += bin[b].samples;
    }
    assert_int_equal(pixels, seen);
    assert_int_equal(samples, sampled->covered);
    const double from_bins = 10.0 * log10(255.0 * 255.0 * (double)sampled->covered / error);
    const double from_mesh = mesh_psnr_db(sampled, &mesh->panel);
    if (!(fabs(from_bins - from_mesh) < 1e-6))
        fail_msg("truth %d: %.9f dB from the bins, %.9f from the mesh", (int)truth, from_bins, from_mesh);
}

static void bins_hold_the_whole_error(void **state)
{
    (void)state;
    const study_mesh_case_t at = {{120, 68, 90, 70}, STUDY_COFFEE, 4, 8, 55};
    study_mesh_t mesh;
    char error[FILE_ERROR_LENGTH] = "";
    if (!study_mesh_open(&mesh, &at, error))
        fail_msg("%s", error);
    for (int m = 0; m < WARP_METHODS; m += 5) {
        study_mesh_warp(&mesh, m);
        bins_sum_up(&mesh, STUDY_TRUTH_PICTURE);
        bins_sum_up(&mesh, STUDY_TRUTH_ORIGINAL);
    }
    study_mesh_close(&mesh);
}

/* At S = 64 a pixel of area A has 4096 A samples, but for its edges. */
static void areas_are_what_samples_measure(void **state)
{
    (void)state;
    const study_mesh_case_t at = {{40, 30, 24, 28}, STUDY_NOISE, 1, 64, 50};
    study_mesh_t mesh;
    char error[FILE_ERROR_LENGTH] = "";
    if (!study_mesh_open(&mesh, &at, error))
        fail_msg("%s", error);
    int inner = 0;
    for (int32_t j = 1; j < 27; j++)
        for (int32_t i = 1; i < 23; i++) {
            const mesh_cell_t *cell = &mesh.mesh[STUDY_TRUTH_PICTURE].cell[j * 24 + i];
            if (cell[-25].count == 0 || cell[-23].count == 0 || cell[23].count == 0 || cell[25].count == 0)
                continue; /* may be cut by the picture's edge */
            const double area = footprints_area(&mesh.exact, i, j), counted = (double)cell->count / 4096.0;
            if (!(fabs(area / counted - 1.0) < 0.03))
                fail_msg("pixel %d, %d: area %.4f, expected %.4f", i, j, area, counted);
            inner++;
        }
    assert_true(inner > 100);
    study_mesh_close(&mesh);
}

static void a_pixel_falls_in_the_bin_of_its_area(void **state)
{
    (void)state;
    const study_mesh_case_t at = {{40, 30, 24, 28}, STUDY_NOISE, 1, 8, 50};
    study_mesh_t mesh;
    char error[FILE_ERROR_LENGTH] = "";
    if (!study_mesh_open(&mesh, &at, error))
        fail_msg("%s", error);
    study_mesh_warp(&mesh, 0);
    footprints_bin_t bin[FOOTPRINTS_BINS];
    const mesh_t *sampled = &mesh.mesh[STUDY_TRUTH_PICTURE];
    footprints_bins(bin, sampled, &mesh.exact, &mesh.panel);
    int filled = 0;
    for (int b = 1; b < FOOTPRINTS_BINS - 1; b++) {
        int64_t expected = 0;
        for (int32_t c = 0; c < 24 * 28; c++) {
            const double area = footprints_area(&mesh.exact, c % 24, c / 24);
            expected +=
                sampled->cell[c].count > 0 && area >= footprints_bin_area(b) && area < footprints_bin_area(b + 1);
        }
        assert_int_equal(bin[b].pixels, expected);
        filled += expected > 0;
    }
    assert_true(filled > 3);
    assert_true(fabs(footprints_bin_area(12) - 1.0) < 1e-12);
    study_mesh_close(&mesh);
}

static void a_sum_is_from_one_area_on_and_below_another(void **state)
{
    (void)state;
    footprints_bin_t bin[FOOTPRINTS_BINS];
    for (int b = 0; b < FOOTPRINTS_BINS; b++)
        bin[b] = (footprints_bin_t){INT64_C(1) << b, INT64_C(2) << b, ldexp(4.0, b)};
    const footprints_bin_t sum = footprints_bins_sum(bin, footprints_bin_area(12), footprints_bin_area(15));
    assert_int_equal(sum.pixels, 7 << 12);
    assert_int_equal(sum.samples, 14 << 12);
    assert_true(sum.error == 28 << 12);
    assert_int_equal(footprints_bins_sum(bin, 0.0, HUGE_VAL).pixels, (1 << FOOTPRINTS_BINS) - 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_hold_the_whole_error),
        cmocka_unit_test(areas_are_what_samples_measure),
        cmocka_unit_test(a_pixel_falls_in_the_bin_of_its_area),
        cmocka_unit_test(a_sum_is_from_one_area_on_and_below_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
