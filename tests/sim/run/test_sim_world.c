// SPDX-License-Identifier: Apache-2.0
// Tests of the virtual room: step n draws pose n, the same inputs give the same bytes, rates follow the pose list.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "sim/pose/pose_sender.h"
#include "sim/pose/pose_text.h"
#include "sim/run/run_rate.h"
#include "sim/run/run_record.h"
#include "tests/support/room_bench.h"

enum { POSES = 40, INTERVAL_US = 33333 };

static pose_list_entry_t entries[POSES];

/* Poses at the moments n / 30 s, their times rounded down, later by an hour: only differences count. */
static pose_list_t make_list(void)
{
    for (int n = 0; n < POSES; n++)
        entries[n] = (pose_list_entry_t){INT64_C(3600000000) + n * INT64_C(1000000) / 30, room_bench_pose(n)};
    return (pose_list_t){entries, POSES};
}

static sim_world_t *make_world(const room_bench_t *bench, const sim_rate_t *refresh)
{
    char error[FILE_ERROR_LENGTH] = "";
    const sim_world_config_t config = {.room = &bench->room, .video = bench->video, .refresh = *refresh};
    sim_world_t *world = sim_world_create(&config, error);
    assert_string_equal(error, "");
    return world;
}

static uint64_t hash_of(uint64_t hash, const image_t *image)
{
    for (int32_t y = 0; y < image->height; y++)
        for (int32_t x = 0; x < image->width * 4; x++)
            hash = (hash ^ image_row(image, y)[x]) * UINT64_C(1099511628211);
    return hash;
}

/* Play the list; every step must draw its own pose. Returns a hash of everything the walls have shown. */
static uint64_t play(bool fd)
{
    room_bench_t bench;
    char error[FILE_ERROR_LENGTH];
    const pose_list_t list = make_list();
    const sim_rate_t refresh = run_rate_of_poses(&list);
    uint64_t hash = UINT64_C(14695981039346656037);
    pose_sender_t sender;
    room_bench_open(&bench, fd);
    sim_world_t *world = make_world(&bench, &refresh);
    const pose_sender_config_t config = {.bus = sim_world_bus(world), .list = &list, .fd = fd, .sync = true};
    assert_true(pose_sender_open(&sender, &config));
    for (int n = 0; n < POSES; n++) {
        pose_sender_advance(&sender, sim_rate_time_us(&refresh, n));
        assert_true(sim_world_step(world, sim_rate_time_us(&refresh, n), error));
        for (int board = 0; board < ROOM_BENCH_BOARDS; board++) {
            const projector_report_t *report = &sim_world_projector(world, board)->report;
            assert_int_equal(report->state, CAN_BOARD_RUNNING);
            assert_memory_equal(report->pose.eye_nm, entries[n].pose.eye_nm, sizeof entries[n].pose.eye_nm);
            assert_int_equal(report->pose_counter, n % (fd ? 256 : 15));
            hash = hash_of(hash, sim_world_shown(world, board, sim_rate_time_us(&refresh, n + 1)));
        }
    }
    for (int board = 0; board < ROOM_BENCH_BOARDS; board++) { /* who have found the tracker's time by now */
        const can_poses_t *poses = &sim_world_projector(world, board)->poses;
        const int64_t sent_us = entries[POSES - 1].time_us - entries[0].time_us;
        assert_true(poses->captured);
        assert_in_range(poses->capture_bus_us, sent_us - 52, sent_us + 52);
    }
    assert_int_equal(sender.sent, POSES);
    assert_int_equal(sender.unsent, 0);
    sim_world_destroy(world);
    room_bench_close(&bench);
    return hash;
}

static void test_step_n_draws_pose_n_and_two_runs_are_alike(void **state)
{
    (void)state;
    const uint64_t fd = play(true);
    assert_true(play(true) == fd);
    const uint64_t classic = play(false);
    assert_true(play(false) == classic);
}

/* What a wall shows after a step is that step's picture, not the one before. */
static void test_the_wall_shows_what_the_step_drew(void **state)
{
    (void)state;
    room_bench_t bench;
    char error[FILE_ERROR_LENGTH];
    room_bench_open(&bench, true);
    const sim_rate_t refresh = {8333, 60, 1};
    assert_true(sim_world_step(bench.world, sim_rate_time_us(&refresh, 0), error));
    assert_null(sim_world_shown(bench.world, 0, sim_rate_time_us(&refresh, 1) - 1));
    assert_non_null(sim_world_shown(bench.world, 0, sim_rate_time_us(&refresh, 1)));
    assert_int_equal(sim_world_projector(bench.world, 0)->report.frame_number, 1);
    room_bench_close(&bench);
}

static void test_a_method_for_all_boards_replaces_the_rooms(void **state)
{
    (void)state;
    room_bench_t bench;
    char error[FILE_ERROR_LENGTH] = "";
    room_bench_open(&bench, true);
    const sim_world_config_t config = {.room = &bench.room,
                                       .video = bench.video,
                                       .method = warp_method_from_name("none+nearest"),
                                       .refresh = {8333, 60, 1}};
    assert_non_null(config.method);
    sim_world_t *world = sim_world_create(&config, error);
    assert_string_equal(error, "");
    assert_int_equal(sim_world_projector(world, 1)->warp.method.resampler, WARP_NEAREST);
    assert_int_equal(sim_world_projector(bench.world, 1)->warp.method.resampler, WARP_MEAN_CUBIC);
    sim_world_destroy(world);
    room_bench_close(&bench);
}

/* In real time the boards wait for each other: what a step takes says nothing of a board. */
static void test_only_boards_in_virtual_time_may_take_cheaper_methods(void **state)
{
    (void)state;
    char error[FILE_ERROR_LENGTH] = "";
    room_bench_t bench;
    room_bench_open(&bench, true);
    assert_int_equal(sim_world_projector(bench.world, 0)->degrade.steps, 4);
    const sim_world_config_t config = {
        .room = &bench.room, .video = bench.video, .real = true, .refresh = {0, ROOM_BENCH_HZ, 1}};
    sim_world_t *world = sim_world_create(&config, error);
    assert_string_equal(error, "");
    assert_int_equal(sim_world_projector(world, 0)->degrade.steps, 1);
    sim_world_destroy(world);
    room_bench_close(&bench);
}

static void check_rate(const int64_t *time_us, size_t count, int frames, int seconds, int64_t lasts)
{
    pose_list_entry_t entry[8];
    for (size_t i = 0; i < count; i++)
        entry[i] = (pose_list_entry_t){.time_us = time_us[i]};
    const pose_list_t list = {entry, count};
    const sim_rate_t rate = run_rate_of_poses(&list);
    assert_int_equal(rate.frames, frames);
    assert_int_equal(rate.seconds, seconds);
    assert_int_equal(rate.start_us, (int64_t)seconds * 1000000 / (2 * frames));
    assert_int_equal(run_rate_frames(&rate, &list), lasts);
}

static void test_the_rate_follows_the_list(void **state)
{
    (void)state;
    check_rate((const int64_t[]){5}, 1, 60, 1, 1);
    check_rate((const int64_t[]){5, 5}, 2, 60, 1, 1);
    check_rate((const int64_t[]){0, INTERVAL_US, 2 * INTERVAL_US, 100000}, 4, 30, 1, 4);
    check_rate((const int64_t[]){0, 4167, 8333, 12500, 16667}, 5, 60, 1, 2);      /* 240 Hz: every fourth */
    check_rate((const int64_t[]){0, 40000, 80000, 900000, 940000}, 5, 25, 1, 24); /* a gap is no rate */
    check_rate((const int64_t[]){0, 41708, 83416}, 3, 24000, 1001, 3);            /* 23.976 Hz */
    check_rate((const int64_t[]){0, 5000000, 10000000}, 3, 1, 1, 11);             /* never slower than 1 Hz */
}

/* What boards can number by: 1 to 240 Hz, both parts up to 240240. */
static void test_every_list_has_a_rate_for_boards(void **state)
{
    (void)state;
    for (int64_t us = 1; us < 2000000; us += 1 + us / 97) {
        pose_list_entry_t entry[2] = {{.time_us = 0}, {.time_us = us}};
        const sim_rate_t rate = run_rate_of_poses(&(pose_list_t){entry, 2});
        const double hz = (double)rate.frames / rate.seconds, wanted = fmin(60, fmax(1, 1e6 / (double)us));
        if (rate.frames < 1 || rate.frames > 240240 || rate.seconds < 1 || rate.seconds > 240240 ||
            fabs(hz / wanted - 1) > 1 / (double)us + 4e-6)
            fail_msg("poses each %lld us: %d / %d Hz", (long long)us, rate.frames, rate.seconds);
    }
}

static void test_a_rate_in_hz(void **state)
{
    (void)state;
    const sim_rate_t film = run_rate_from_hz(23.976), whole = run_rate_from_hz(50), odd = run_rate_from_hz(72.5);
    const sim_rate_t most = run_rate_from_hz(240), slowed = run_rate_from_hz(239.76);
    assert_true(film.frames == 24000 && film.seconds == 1001);
    assert_true(whole.frames == 50 && whole.seconds == 1 && whole.start_us == 10000);
    assert_true(odd.frames == 72500 && odd.seconds == 1000);
    assert_true(most.frames == 240 && slowed.frames == 240000 && slowed.seconds == 1001);
}

/* The text of frames.csv, read again, is the pose that was used. */
static void test_a_written_pose_is_read_back(void **state)
{
    (void)state;
    char text[RUN_POSE_TEXT_LENGTH], error[POSE_TEXT_MESSAGE_LENGTH];
    const pose_t pose = {.eye_nm = {-1, INT64_C(-123456789012), 1000000}, .quaternion_q30 = {1 << 30, 0, 0, 0}};
    pose_t again;
    run_pose_text(text, &pose);
    assert_string_equal(text, "-0.000001 -123456.789012 1.000000 1.0000000000 0.0000000000 0.0000000000 0.0000000000");
    assert_true(pose_from_text(text, &again, error));
    assert_memory_equal(&again, &pose, sizeof pose);
}

static void test_sums_over_a_run(void **state)
{
    (void)state;
    run_record_t record = {.boards = 2};
    const wall_t wall = {.panel_width = 10, .panel_height = 10};
    for (int n = 0; n < 300; n++) {
        assert_true(run_record_add_frame(&record));
        run_wall_t *board = &record.wall[n * 2 + 1];
        board->step_time_us = 1000 * (n % 2);
        board->report.corrected = n >= 200;
        board->report.warp.lit_pixels = 50;
        board->report.warp.k_in_q16 = n == 250 ? 0 : 65536 + n;
    }
    assert_true(run_record_add_psnr(&record, &(run_psnr_t){.frame = 9, .board = 1, .db = {30, 31, 0, 0}}));
    const run_psnr_t endless = {.frame = 3, .board = 1, .db = {20, (double)INFINITY, 0, 0}};
    assert_true(run_record_add_psnr(&record, &endless));
    assert_true(run_record_add_psnr(&record, &(run_psnr_t){.frame = 3, .board = 0}));
    run_record_sort(&record);
    assert_int_equal(record.psnr[0].board, 0);
    assert_int_equal(record.psnr[2].frame, 9);
    const run_board_sum_t sum = run_record_board(&record, 1, &wall);
    assert_true(sum.drawn && sum.k_least > 1.003 && sum.k_least < 1.0031 && sum.k_most > 1.0045 && sum.k_most < 1.0046);
    assert_true(sum.lit_share > 0.4999 && sum.lit_share < 0.5001);
    assert_true(sum.step_ms_mean > 0.499 && sum.step_ms_mean < 0.501 && sum.step_ms_most > 0.999);
    assert_true(sum.judged == 2 && sum.db[RUN_DB_PSNR] > 24.9 && sum.db[RUN_DB_PSNR] < 25.1);
    assert_true(sum.db[RUN_DB_LIMIT] > 30.9 && sum.db[RUN_DB_LIMIT] < 31.1);
    assert_false(run_record_board(&record, 0, &wall).drawn);
    run_record_free(&record);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_step_n_draws_pose_n_and_two_runs_are_alike),
        cmocka_unit_test(test_the_wall_shows_what_the_step_drew),
        cmocka_unit_test(test_a_method_for_all_boards_replaces_the_rooms),
        cmocka_unit_test(test_only_boards_in_virtual_time_may_take_cheaper_methods),
        cmocka_unit_test(test_the_rate_follows_the_list),
        cmocka_unit_test(test_every_list_has_a_rate_for_boards),
        cmocka_unit_test(test_a_rate_in_hz),
        cmocka_unit_test(test_a_written_pose_is_read_back),
        cmocka_unit_test(test_sums_over_a_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
