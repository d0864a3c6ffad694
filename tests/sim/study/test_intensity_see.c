// SPDX-License-Identifier: Apache-2.0
// Models of pixels and wall: the first is the paper's mesh evaluation, and each other costs what it must.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "sim/study/intensity_see.h"
#include "sim/study/study_mesh.h"

enum { WIDTH = 96, HEIGHT = 54, METHODS = 2 };

static const double angle_deg = 35.0;

static void see(intensity_seen_t seen[INTENSITY_MODELS])
{
    const study_sizes_t sizes = {WIDTH, HEIGHT, WIDTH, HEIGHT};
    const warp_method_t *const method[METHODS] = {warp_method_from_name("none+nearest"),
                                                  warp_method_from_name("mean+cubic")};
    study_scene_t scene;
    image_t picture;
    study_scene(&scene, &sizes);
    assert_true(study_image(STUDY_COFFEE, WIDTH, HEIGHT, 1, &picture, NULL));
    const intensity_place_t place = {&scene, &picture, angle_deg, method, METHODS};
    assert_true(intensity_see(seen, &place));
    free(picture.data);
}

static void ideal_pixels_are_the_mesh_evaluation(void **state)
{
    (void)state;
    intensity_seen_t seen[INTENSITY_MODELS];
    see(seen);
    study_mesh_run_t run = {.at = {{WIDTH, HEIGHT, WIDTH, HEIGHT}, STUDY_COFFEE, 1, INTENSITY_FACTOR, angle_deg}};
    study_mesh_measure(&run);
    assert_string_equal(run.error, "");
    const double *psnr_db = run.found.psnr_db[STUDY_TRUTH_PICTURE];
    assert_true(fabs(seen[0].fine_db[0] - psnr_db[warp_method_from_name("none+nearest") - warp_methods]) < 1e-3);
    assert_true(fabs(seen[0].fine_db[1] - psnr_db[warp_method_from_name("mean+cubic") - warp_methods]) < 1e-3);
    assert_true(fabs(seen[0].fine_db[METHODS] - run.found.limit_db[STUDY_TRUTH_PICTURE]) < 1e-3);
    assert_true(fabs(seen[0].gain - 1.0) < 1e-6);
}

static void every_model_but_the_first_is_seen(void **state)
{
    (void)state;
    intensity_seen_t seen[INTENSITY_MODELS];
    see(seen);
    for (int model = 0; model < INTENSITY_MODELS; model++) {
        const intensity_model_t *of = &intensity_models[model];
        const bool uneven_pixels = of->fill < 1.0 || of->falloff > 0.0, shines = of->lobe > 0.0;
        assert_true(uneven_pixels || shines || model == 0);
        /* single pixels' shapes are errors sample by sample, and mostly gone for the eye */
        for (int row = 0; row <= METHODS; row++) {
            const double lost_db = seen[0].fine_db[row] - seen[model].fine_db[row];
            assert_true(uneven_pixels ? lost_db > 6.0 : fabs(lost_db) < 3.0);
            assert_true(seen[model].eye_db[row] > seen[model].fine_db[row] + 5.0);
            /* a hot spot is an error only against an even wall */
            const double spot_db = seen[model].eye_db[row] - seen[model].uneven_db[row];
            assert_true(shines ? spot_db > 6.0 : fabs(spot_db) < 1e-6);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ideal_pixels_are_the_mesh_evaluation),
        cmocka_unit_test(every_model_but_the_first_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
