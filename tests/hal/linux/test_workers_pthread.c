// SPDX-License-Identifier: Apache-2.0
// Workers: every part once, at the same time, wrong settings refused; frames of the same bytes by any number of them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <pthread.h>
#include <stdbool.h>
#include <string.h>

#include "firmware/warp_steps.h"
#include "tests/support/homography_of.h"
#include "tests/support/rng.h"
#include "warp_fixed/warp.h"

static hal_workers_t *open_workers(int32_t count)
{
    const hal_workers_settings_t settings = {.count = count, .first_core = HAL_WORKERS_ANY_CORE};
    char error[HAL_WORKERS_ERROR_LENGTH];
    hal_workers_t *workers;
    if (hal_workers_open(&workers, &settings, error) != HAL_OK)
        fail_msg("%s", error);
    return workers;
}

typedef struct {
    int32_t parts[HAL_WORKERS_MAX]; /* how often each was done */
    int32_t of;
    pthread_t thread[HAL_WORKERS_MAX];
    pthread_barrier_t *all_here; /* NULL: don't wait for the others */
} tally_t;

static void count_part(void *context, int32_t part, int32_t parts)
{
    tally_t *tally = context;
    tally->parts[part]++;
    tally->thread[part] = pthread_self();
    if (part == 0)
        tally->of = parts;
    if (tally->all_here != NULL)
        pthread_barrier_wait(tally->all_here);
}

/* A barrier of all parts lets none go on unless each has a thread of its own. */
static void every_part_has_a_thread_of_its_own(void **state)
{
    (void)state;
    for (int32_t count = 1; count <= HAL_WORKERS_MAX; count++) {
        hal_workers_t *workers = open_workers(count);
        pthread_barrier_t all_here;
        pthread_barrier_init(&all_here, NULL, (unsigned)count);
        tally_t tally = {.all_here = &all_here};
        for (int run = 1; run <= 200; run++) {
            hal_workers_run(workers, count_part, &tally);
            assert_int_equal(tally.of, count);
            for (int32_t part = 0; part < HAL_WORKERS_MAX; part++)
                assert_int_equal(tally.parts[part], part < count ? run : 0);
            assert_true(pthread_equal(tally.thread[0], pthread_self()));
        }
        pthread_barrier_destroy(&all_here);
        hal_workers_close(workers);
    }
}

static void no_workers_are_one(void **state)
{
    (void)state;
    tally_t tally = {.of = 0};
    hal_workers_run(NULL, count_part, &tally);
    assert_int_equal(tally.of, 1);
    assert_int_equal(tally.parts[0], 1);
    hal_workers_close(NULL);
}

static void wrong_settings_are_refused(void **state)
{
    (void)state;
    static const struct {
        hal_workers_settings_t settings;
        hal_status_t status;
        const char *error;
    } wrong[] = {
        {{0, HAL_WORKERS_ANY_CORE, 0}, HAL_BAD_CALL, "workers: found 0, expected 1 to 4"},
        {{5, HAL_WORKERS_ANY_CORE, 0}, HAL_BAD_CALL, "workers: found 5, expected 1 to 4"},
        {{2, -2, 0}, HAL_BAD_CALL, "workers: first core -2, expected 0 to 1022, or -1 for any"},
        {{2, 1023, 0}, HAL_BAD_CALL, "workers: first core 1023, expected 0 to 1022, or -1 for any"},
        {{1, HAL_WORKERS_ANY_CORE, 100}, HAL_BAD_CALL, "workers: priority 100, expected 1 to 99, or 0 for none"},
        {{1, HAL_WORKERS_ANY_CORE, -1}, HAL_BAD_CALL, "workers: priority -1, expected 1 to 99, or 0 for none"},
        {{2, 1021, 0}, HAL_IO, "workers: can't pin worker 1 to core 1022: "},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char error[HAL_WORKERS_ERROR_LENGTH] = "";
        hal_workers_t *workers = NULL;
        assert_int_equal(hal_workers_open(&workers, &wrong[i].settings, error), wrong[i].status);
        assert_null(workers);
        assert_memory_equal(error, wrong[i].error, strlen(wrong[i].error));
    }
}

static void workers_are_pinned(void **state)
{
    (void)state;
    cpu_set_t before, now;
    assert_int_equal(pthread_getaffinity_np(pthread_self(), sizeof before, &before), 0);
    int32_t core = 0;
    while (!CPU_ISSET((unsigned)core, &before))
        core++;
    const hal_workers_settings_t settings = {.count = 1, .first_core = core};
    char error[HAL_WORKERS_ERROR_LENGTH];
    hal_workers_t *workers;
    assert_int_equal(hal_workers_open(&workers, &settings, error), HAL_OK);
    assert_int_equal(pthread_getaffinity_np(pthread_self(), sizeof now, &now), 0);
    assert_int_equal(CPU_COUNT(&now), 1);
    assert_true(CPU_ISSET((unsigned)core, &now));
    hal_workers_close(workers);
    assert_int_equal(pthread_setaffinity_np(pthread_self(), sizeof before, &before), 0);
}

enum { WIDTH = 150, HEIGHT = 100, PANEL_WIDTH = 100, PANEL_HEIGHT = 94, POSES = 4 };

static warp_t warps[2];
static uint8_t picture_bytes[WIDTH * HEIGHT * 4], panel_bytes[2][PANEL_WIDTH * PANEL_HEIGHT * 4];

/* Tilted, magnified, with footprints of 90 texels that need levels, and close to the horizon with blocks of 1 px. */
static homography_t homography_number(int n)
{
    static const double rows[POSES][9] = {
        {1.2, 0.2, -10, -0.1, 1.2, 3, 0.0004, 0.0002, 1},
        {0.5, 0, 30, 0, 0.5, 20, 0, 0, 1},
        {90, 4, -4000, 3, 80, -3500, 0.002, 0.001, 1},
        {1, 0, 0, 0.1, 0.02, 0, -0.0095, 0.0001, 1},
    };
    return homography_of(rows[n], (homography_sizes_t){PANEL_WIDTH, PANEL_HEIGHT, WIDTH, HEIGHT});
}

static picture_t picture_in(uint8_t *bytes, picture_format_t format, int32_t width, int32_t height)
{
    static const int32_t pixel_bytes[PICTURE_FORMATS] = {4, 1, 3, 3, 2, 2, 1};
    const int32_t stride = width * pixel_bytes[format];
    return (picture_t){.format = format,
                       .width = width,
                       .height = height,
                       .data = {bytes, bytes + (ptrdiff_t)stride * height},
                       .stride = {stride, width}};
}

static void check_frame(hal_workers_t *workers, const warp_method_t *method, int pose,
                        const picture_format_t formats[2])
{
    const picture_t picture = picture_in(picture_bytes, formats[0], WIDTH, HEIGHT);
    const homography_t homography = homography_number(pose);
    warp_report_t report[2];
    for (int i = 0; i < 2; i++) {
        const picture_t panel = picture_in(panel_bytes[i], formats[1], PANEL_WIDTH, PANEL_HEIGHT);
        memset(panel_bytes[i], 0xa5, sizeof panel_bytes[i]);
        assert_true(warp_plan(&warps[i], warp_kernels_best(), &report[i], &homography, &panel, &picture));
        warp_steps_run(&warps[i], i == 0 ? NULL : workers);
    }
    assert_memory_equal(&report[0], &report[1], sizeof report[0]);
    if (memcmp(panel_bytes[0], panel_bytes[1], sizeof panel_bytes[0]) != 0)
        fail_msg("%s, pose %d, format %d to %d: other bytes than of one worker", method->name, pose, (int)formats[0],
                 (int)formats[1]);
}

static void frames_do_not_depend_on_the_workers(void **state)
{
    (void)state;
    static const uint8_t border[3] = {10, 20, 30};
    static const picture_format_t formats[5][2] = {{PICTURE_XRGB8888, PICTURE_XRGB8888},
                                                   {PICTURE_GRAY8, PICTURE_GRAY8},
                                                   {PICTURE_NV12, PICTURE_NV12},
                                                   {PICTURE_NV12, PICTURE_XRGB8888},
                                                   {PICTURE_UYVY, PICTURE_YUYV}};
    rng_t rng = {7};
    for (size_t i = 0; i < sizeof picture_bytes; i++)
        picture_bytes[i] = (uint8_t)rng_next(&rng);
    for (int m = 0; m < WARP_METHODS; m++) {
        warp_init(&warps[0], warp_methods[m], false, border);
        warp_init(&warps[1], warp_methods[m], false, border);
        for (int32_t count = 2; count <= HAL_WORKERS_MAX; count++) {
            hal_workers_t *workers = open_workers(count);
            for (int pose = 0; pose < POSES; pose++)
                check_frame(workers, &warp_methods[m], pose, formats[(m + pose) % 5]);
            hal_workers_close(workers);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_part_has_a_thread_of_its_own),  cmocka_unit_test(no_workers_are_one),
        cmocka_unit_test(wrong_settings_are_refused),          cmocka_unit_test(workers_are_pinned),
        cmocka_unit_test(frames_do_not_depend_on_the_workers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
