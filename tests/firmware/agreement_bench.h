// SPDX-License-Identifier: Apache-2.0
// Eight whole projectors with clocks of their own and a tracker, compared content by content.
#ifndef TESTS_FIRMWARE_AGREEMENT_BENCH_H
#define TESTS_FIRMWARE_AGREEMENT_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/frame_choice.h"
#include "sim/pose/pose_sender.h"
#include "sim/run/sim_world.h"
#include "tests/support/scratch.h"
#include "tests/support/small_room.h"

enum { BOARDS = 8, HZ = 60, POSES_HZ = 237, START_S = 25, SEED = 3, CONTENTS = 16 };

static const sim_rate_t REFRESH = {8333, HZ, 1};

typedef struct {
    room_t room;
    video_t *video;
    sim_world_t *world;
    pose_list_t list;
    pose_sender_t sender;
    int64_t step, shown, in_step;
    int64_t last_in_step[BOARDS]; /* refresh at which each was in step last */
    int64_t number[CONTENTS];     /* the newest contents; each as the first board in step showed it */
    can_step_t content[CONTENTS];
} bench_t;

/* What differs from a room of CAN FD whose projectors take no time. */
typedef struct {
    const double *display_ms; /* of each board's projector; NULL: none */
    bool classic;
    bool video_60; /* a picture for every refresh, instead of every second one */
} bench_settings_t;

static inline video_t *open_video_60(char error[FILE_ERROR_LENGTH])
{
    static const char head[] = "YUV4MPEG2 W96 H54 F60:1 Cmono\n", frame[] = "FRAME\n";
    enum { FRAMES = 8, PIXELS = 96 * 54, HEAD = sizeof head - 1, FRAME = sizeof frame - 1 };
    static char file[HEAD + FRAMES * (FRAME + PIXELS)];
    scratch_t scratch;
    char path[SCRATCH_PATH_LENGTH];
    memcpy(file, head, HEAD);
    for (size_t n = 0; n < FRAMES; n++) {
        char *at = file + HEAD + n * (FRAME + PIXELS);
        memcpy(at, frame, FRAME);
        memset(at + FRAME, (int)(16 * n), PIXELS);
    }
    scratch_open(&scratch);
    scratch_path(&scratch, "video.y4m", path);
    scratch_write(path, file, sizeof file);
    video_t *video = video_open(path, 96, 54, error);
    scratch_close(&scratch);
    return video;
}

static inline void make_walk(pose_list_t *list, int seconds)
{
    list->count = (size_t)seconds * POSES_HZ;
    list->entry = calloc(list->count, sizeof *list->entry);
    assert_non_null(list->entry);
    for (size_t n = 0; n < list->count; n++)
        list->entry[n] = (pose_list_entry_t){
            .time_us = (int64_t)n * 1000000 / POSES_HZ,
            .pose = {.eye_nm = {(int64_t)(n % 1000) * 100000, 0, -500000000}, .quaternion_q30 = {1 << 30, 0, 0, 0}},
        };
}

static inline void bench_open_with(bench_t *b, int seconds, const bench_settings_t *settings)
{
    char error[FILE_ERROR_LENGTH] = "";
    memset(b, 0, sizeof *b);
    small_room_load(&b->room, &(small_room_t){.boards = BOARDS,
                                              .nodes_apart = 1,
                                              .classic = settings->classic,
                                              .display_ms = settings->display_ms});
    make_walk(&b->list, seconds);
    b->video = settings->video_60 ? open_video_60(error) : video_open("pattern", 96, 54, error);
    assert_string_equal(error, "");
    const sim_world_config_t config = {
        .room = &b->room,
        .video = b->video,
        .refresh = REFRESH,
        .seed = SEED,
        .clocks = {.offset_us = 3600000000, .drift_ppb = 50000, .jitter_us = 200},
    };
    b->world = sim_world_create(&config, error);
    assert_string_equal(error, "");
    const pose_sender_config_t sender = {
        .bus = sim_world_bus(b->world), .list = &b->list, .fd = !settings->classic, .start_us = 1000, .sync = true};
    assert_true(pose_sender_open(&b->sender, &sender));
}

static inline void bench_open(bench_t *b, int seconds)
{
    bench_open_with(b, seconds, &(bench_settings_t){.display_ms = NULL});
}

static inline void bench_close(bench_t *b)
{
    sim_world_destroy(b->world);
    video_close(b->video);
    free(b->list.entry);
}

/* Whoever shows a content in step shows the same picture for the same pose; at this refresh or at another. */
static inline void compare_content(bench_t *b, int board, const frame_step_t *refresh, const can_step_t *step)
{
    const size_t place = (size_t)refresh->content % CONTENTS;
    const can_step_t *first = &b->content[place];
    if (b->number[place] != refresh->content) {
        b->number[place] = refresh->content;
        b->content[place] = *step;
    } else if (step->refresh != first->refresh || step->picture != first->picture || step->pose_us != first->pose_us)
        fail_msg("seed %d, step %lld: board %d shows picture %u at refresh %u, pose %llu us; another %u at %u, %llu us",
                 SEED, (long long)b->step, board + 1, step->picture, step->refresh, (unsigned long long)step->pose_us,
                 first->picture, first->refresh, (unsigned long long)first->pose_us);
}

/* And all boards in step number this refresh alike. */
static inline void compare(bench_t *b)
{
    int64_t number = -1;
    for (int i = 0; i < BOARDS; i++) {
        const projector_t *projector = sim_world_projector(b->world, i);
        const frame_step_t *refresh = &projector->choice.step;
        b->shown++;
        if (!projector->report.agreement.in_step)
            continue;
        b->in_step++;
        b->last_in_step[i] = b->step;
        if (number >= 0 && refresh->number != number)
            fail_msg("seed %d, step %lld: board %d has refresh %lld, another %lld", SEED, (long long)b->step, i + 1,
                     (long long)refresh->number, (long long)number);
        number = refresh->number;
        compare_content(b, i, refresh, &projector->report.agreement);
    }
}

static inline void run(bench_t *b, int refreshes)
{
    char error[FILE_ERROR_LENGTH];
    for (const int64_t until = b->step + refreshes; b->step < until; b->step++) {
        const int64_t now_us = sim_rate_time_us(&REFRESH, b->step);
        pose_sender_advance(&b->sender, now_us);
        assert_true(sim_world_step(b->world, now_us, error));
        compare(b);
    }
}

/* All boards are in step, or were within these refreshes; and of all refreshes since the last check at least a share.
 */
static inline void check_share(bench_t *b, const char *what, int refreshes, double least)
{
    for (int i = 0; i < BOARDS; i++)
        if (b->step - 1 - b->last_in_step[i] > refreshes)
            fail_msg("seed %d, %s: board %d was in step last %lld refreshes ago", SEED, what, i + 1,
                     (long long)(b->step - 1 - b->last_in_step[i]));
    const double share = (double)b->in_step / (double)b->shown;
    printf("%s: %lld refreshes of all boards, %.2f %% in step\n", what, (long long)b->shown, 100 * share);
    if (share < least)
        fail_msg("seed %d, %s: expected %.1f %%", SEED, what, 100 * least);
    b->shown = b->in_step = 0;
}

static inline hal_can_t *can_of(const bench_t *b, int board)
{
    return sim_world_devices(b->world, board)->can;
}

/* Lose frames with a chance of 1 %: everybody the same, or one board after the other its own. */
static inline void lose_one_percent(const bench_t *b, const hal_can_t *only)
{
    sim_bus_fail(sim_world_bus(b->world), SIM_BUS_LOSE, (sim_bus_fail_t){.ppm = 10000, .only = only});
}

/* @return Refreshes until the board was in step again. The leader is the first of them. */
static inline int64_t go_bus_off(bench_t *b, int board)
{
    sim_bus_fail_bus_off(can_of(b, board));
    run(b, 1); /* it sees so, and asks to be let back */
    const int64_t begin = b->step;
    while (b->last_in_step[board] < begin && b->step < begin + HZ)
        run(b, 1);
    return b->step - begin;
}

#endif
