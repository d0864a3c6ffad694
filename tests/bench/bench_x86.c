// SPDX-License-Identifier: Apache-2.0
// Times frames on this machine beside OpenCV doing the same work on the same picture and homography, and memcpy().
//
// usage: bench_x86 ROUNDS FOLDER    CSV on stdout, what goes on on stderr, FOLDER/bench.svg
//
// The four ways take turns, ROUNDS times after one that is not timed, so that a busy moment of the machine meets all of
// them; a ratio is of times of one round. First OpenCV's picture is compared with ours: where both have the method and
// disagree, this fails. Times are per pixel of the panel, for a whole warp_frame(); of `gauss` per pixel of the
// picture.
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "tests/bench/x86_plot.h"
#include "tests/bench/x86_row.h"

enum { MAX_ROUNDS = 1000 };

enum { THREAD_COUNTS = 2 };
enum { ROWS = X86_CASES * BENCH_FORMATS * BENCH_POSES * THREAD_COUNTS };

static warp_t warp;
static uint8_t picture_bytes[BENCH_PIXELS * 4], panel_bytes[BENCH_PIXELS * 4], opencv_bytes[BENCH_PIXELS * 4];
static double samples[X86_WAYS][MAX_ROUNDS], ratios[MAX_ROUNDS];

static double now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

/* Compare our outcome with OpenCV's. */
static bool agrees(const x86_job_t *job, x86_row_t *row, const image_t *ours, const image_t *theirs)
{
    row->psnr_db = ours->data == NULL ? (double)NAN : x86_psnr_db(job, ours, theirs);
    if (row->psnr_db >= row->work->at_least_db)
        return true;
    fprintf(stderr, "bench: our %s %s %s is %.1f dB from OpenCV's %s, expected %.0f dB at least\n", row->work->name,
            row->format, row->pose, row->psnr_db, row->work->opencv_name, row->work->at_least_db);
    return false;
}

/* Do it once in every way: so nothing is timed for the first time, and is checked before. */
static bool check(const x86_job_t *job, x86_row_t *row)
{
    if (!x86_prepare(job)) {
        fprintf(stderr, "bench: there is no method or filter for %s\n", row->work->name);
        return false;
    }
    x86_job_t opencv_job = *job;
    opencv_job.panel.data = opencv_bytes;
    const image_t theirs = x86_do(&opencv_job, X86_OPENCV);
    x86_do(job, X86_MEMCPY);
    const image_t scalar = x86_do(job, X86_SCALAR);
    if (!agrees(job, row, &scalar, &theirs))
        return false;
    const image_t neon = x86_do(job, X86_NEON);
    return agrees(job, row, &neon, &theirs);
}

static bool measure(const x86_job_t *job, x86_row_t *row, int rounds)
{
    opencv_set_threads(row->threads);
    if (!check(job, row))
        return false;
    for (int round = 0; round < rounds; round++) {
        for (x86_way_t way = X86_NEON; way < X86_WAYS; way++) {
            const double began = now_ns();
            x86_do(job, way);
            samples[way][round] = (now_ns() - began) / BENCH_PIXELS;
        }
        ratios[round] = samples[X86_OPENCV][round] / samples[X86_NEON][round];
    }
    row->ratio = x86_spread_of(ratios, rounds);
    for (x86_way_t way = X86_NEON; way < X86_WAYS; way++)
        row->ns_per_px[way] = x86_spread_of(samples[way], rounds);
    fprintf(stderr, "bench: %s %s %s, %d thread%s: %.2f ns/px, OpenCV's %s %.2f, memcpy %.2f\n", row->work->name,
            row->format, row->pose, row->threads, row->threads == 1 ? "" : "s", row->ns_per_px[X86_NEON].median,
            row->work->opencv_name, row->ns_per_px[X86_OPENCV].median, row->ns_per_px[X86_MEMCPY].median);
    return true;
}

/* Rows come in order of their threads; `workers` are that many. */
static bool measure_row(x86_row_t *row, int number, int rounds, hal_workers_t *workers)
{
    const bench_pose_t *pose = &bench_poses[number % BENCH_POSES];
    const bench_format_t *format = &bench_formats[number / BENCH_POSES % BENCH_FORMATS];
    *row = (x86_row_t){
        .work = &x86_cases[number / BENCH_POSES / BENCH_FORMATS % X86_CASES],
        .format = format->name,
        .pose = pose->name,
        .threads = 1 + number / BENCH_POSES / BENCH_FORMATS / X86_CASES,
    };
    const x86_job_t job = {
        .work = row->work,
        .pose = pose,
        .homography = bench_homography(pose->rows),
        .picture = bench_image(picture_bytes, format->format),
        .panel = bench_image(panel_bytes, format->format),
        .warp = &warp,
        .workers = workers,
    };
    bench_paint(&job.picture);
    return measure(&job, row, rounds);
}

int main(int argc, char **argv)
{
    char *rest = NULL;
    const long rounds = argc == 3 ? strtol(argv[1], &rest, 10) : 0;
    if (rest == NULL || *rest != '\0' || rounds < 1 || rounds > MAX_ROUNDS) {
        fprintf(stderr, "usage: bench_x86 ROUNDS FOLDER     ROUNDS from 1 to %d\n", MAX_ROUNDS);
        return 2;
    }
    static x86_row_t rows[ROWS];
    fprintf(stderr, "bench: OpenCV is %s\n", opencv_version());
    x86_print_header(stdout);
    for (int32_t threads = 1, r = 0; threads <= THREAD_COUNTS; threads++) {
        const hal_workers_settings_t settings = {threads, HAL_WORKERS_ANY_CORE, 0};
        char refused[HAL_WORKERS_ERROR_LENGTH];
        hal_workers_t *workers;
        if (hal_workers_open(&workers, &settings, refused) != HAL_OK) {
            fprintf(stderr, "bench: %s\n", refused);
            return 1;
        }
        for (; r < ROWS / THREAD_COUNTS * threads; r++) {
            if (!measure_row(&rows[r], r, (int)rounds, workers))
                return 1;
            x86_print_row(stdout, &rows[r]);
        }
        hal_workers_close(workers);
    }
    x86_print_figures(stderr, rows, ROWS);
    char error[FILE_ERROR_LENGTH];
    if (!x86_plot(rows, ROWS, argv[2], error)) {
        fprintf(stderr, "bench: %s\n", error);
        return 1;
    }
    return 0;
}
