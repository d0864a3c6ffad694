// SPDX-License-Identifier: Apache-2.0
// A small room of the simulator for tests.
#include "tests/support/room_bench.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/safe_picture.h"
#include "tests/support/small_room.h"

static const char room_text[] =
    "camera: {width: 96, height: 54, focal_px: [60, 60], principal_px: [48, 27]}\n"
    "boards:\n"
    "  - name: front\n"
    "    node: 5\n"
    "    projector: {width: 96, height: 54}\n"
    "    wall: {corners_mm: [[-2000, -1125, 2000], [2000, -1125, 2000], [2000, 1125, 2000], [-2000, 1125, 2000]]}\n"
    "  - name: left\n"
    "    node: 12\n"
    "    projector: {width: 96, height: 54}\n"
    "    wall: {corners_mm: [[-2000, -1125, -2000], [-2000, -1125, 2000], [-2000, 1125, 2000],\n"
    "                        [-2000, 1125, -2000]]}\n"
    "can: {bitrate: 500000, data_bitrate: 2000000, fd: ";

static void listen(void *context, int sender, const hal_can_frame_t *frame)
{
    room_bench_t *bench = context;
    (void)sender;
    for (int i = 0; i < ROOM_BENCH_BOARDS; i++) {
        room_bench_voice_t *voice = &bench->voice[i];
        can_heartbeat_t heartbeat;
        can_status_t status;
        can_stage_t stage;
        can_quality_t quality;
        can_update_t update;
        if (can_heartbeat_decode(&heartbeat, frame) == CAN_CHECK_OK && heartbeat.node == bench->room.board[i].node) {
            voice->heartbeats++;
            voice->flags_ever |= heartbeat.fault_flags;
            voice->states_ever |= 1U << heartbeat.state;
            voice->heartbeat = heartbeat;
        }
        if (can_status_decode(&status, frame) == CAN_CHECK_OK && status.node == bench->room.board[i].node) {
            voice->statuses++;
            voice->status = status;
        }
        if (can_stage_decode(&stage, frame) == CAN_CHECK_OK && stage.node == bench->room.board[i].node) {
            voice->stages++;
            voice->stage[stage.stage] = stage;
        }
        if (can_update_decode(&update, frame) == CAN_CHECK_OK && update.node == bench->room.board[i].node)
            voice->update = update;
        if (can_quality_decode(&quality, frame) == CAN_CHECK_OK && quality.node == bench->room.board[i].node) {
            voice->qualities++;
            voice->quality = quality;
        }
    }
}

void room_bench_open(room_bench_t *bench, bool fd)
{
    room_bench_open_with_key(bench, fd, NULL);
}

void room_bench_open_with_key(room_bench_t *bench, bool fd, can_auth_t *key)
{
    char text[sizeof room_text + 8], error[FILE_ERROR_LENGTH] = "";
    memset(bench, 0, sizeof *bench);
    (void)snprintf(text, sizeof text, "%s%s}\n", room_text, fd ? "true" : "false");
    room_from_text(&bench->room, text);
    bench->video = video_open("pattern", 96, 54, error);
    assert_string_equal(error, "");
    static const sim_update_settings_t update = {
        .running = "0.5", .install_us = ROOM_BENCH_INSTALL_US, .reboot_us = ROOM_BENCH_REBOOT_US};
    const sim_world_config_t config = {
        .room = &bench->room,
        .video = bench->video,
        .refresh = {1000000 / (2 * ROOM_BENCH_HZ), ROOM_BENCH_HZ, 1},
        .seed = 7,
        .key = key,
        .update = &update,
    };
    bench->world = sim_world_create(&config, error);
    assert_string_equal(error, "");
    bench->tracker = sim_bus_attach(sim_world_bus(bench->world));
    assert_non_null(bench->tracker);
    sim_bus_set_log(sim_world_bus(bench->world), listen, bench);
}

void room_bench_close(room_bench_t *bench)
{
    sim_world_destroy(bench->world);
    video_close(bench->video);
}

pose_t room_bench_pose(int n)
{
    const int64_t x_nm = n * INT64_C(5000000) % INT64_C(900000000);
    return (pose_t){.eye_nm = {x_nm, -100000000, 0}, .quaternion_q30 = {1 << 30, 0, 0, 0}};
}

static void send_pose(room_bench_t *bench)
{
    hal_can_frame_t frame[CAN_POSE_PARTS];
    const bool fd = bench->room.fd;
    const can_pose_t pose = {
        .pose = bench->pose != NULL ? *bench->pose : room_bench_pose(bench->poses),
        .capture_time_us = (uint64_t)bench->poses * 16667 % CAN_POSE_SET_WRAP_US,
        .quality = CAN_POSE_TRACKED,
        .counter = (uint8_t)(bench->poses % (fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS)),
    };
    bench->poses++;
    assert_true(fd ? can_pose_fd_encode(frame, &pose) : can_pose_set_encode(frame, &pose));
    for (int i = 0; i < (fd ? 1 : CAN_POSE_PARTS); i++)
        if (hal_can_send(bench->tracker, &frame[i]) != HAL_OK)
            break; /* a queue full behind a flood */
}

int64_t room_bench_now_us(const room_bench_t *bench)
{
    const sim_rate_t refresh = {1000000 / (2 * ROOM_BENCH_HZ), ROOM_BENCH_HZ, 1};
    return sim_rate_time_us(&refresh, bench->step);
}

void room_bench_advance(room_bench_t *bench)
{
    const int64_t now_us = room_bench_now_us(bench);
    char error[FILE_ERROR_LENGTH];
    sim_bus_advance(sim_world_bus(bench->world), now_us - 1000000 / (2 * ROOM_BENCH_HZ));
    if (bench->tracking)
        send_pose(bench);
    sim_bus_advance(sim_world_bus(bench->world), now_us);
    assert_true(sim_world_advance(bench->world, now_us, error));
}

void room_bench_step(room_bench_t *bench)
{
    char error[FILE_ERROR_LENGTH];
    room_bench_advance(bench);
    assert_true(sim_world_step(bench->world, room_bench_now_us(bench), error));
    bench->step++;
}

void room_bench_run(room_bench_t *bench, int milliseconds)
{
    for (int i = 0; i < milliseconds * ROOM_BENCH_HZ / 1000; i++)
        room_bench_step(bench);
}

const projector_report_t *room_bench_report(const room_bench_t *bench, int board)
{
    return &sim_world_projector(bench->world, board)->report;
}

bool room_bench_is_safe_picture(room_bench_t *bench, int board, const char *reason)
{
    uint8_t bytes[96 * 54 * 4];
    const image_t expected = {bytes, 96, 54, 96 * 4, IMAGE_XRGB8888};
    const image_t *shown = sim_world_shown(bench->world, board, room_bench_now_us(bench));
    if (shown == NULL)
        return false;
    const picture_t panel = picture_from_image(&expected);
    const safe_picture_t safe = {bench->room.board[board].name, bench->room.board[board].node, reason};
    safe_picture_draw(&panel, &safe);
    for (int32_t y = 0; y < expected.height; y++)
        if (memcmp(image_row(&expected, y), image_row(shown, y), 96 * 4) != 0)
            return false;
    return true;
}

const char *room_bench_safe_reason(room_bench_t *bench, int board)
{
    static const char *const reasons[] = {"bus off", "no video yet", "no pose yet",
                                          "no pose", "no video",     "this pose can't be shown here"};
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++)
        if (room_bench_is_safe_picture(bench, board, reasons[i]))
            return reasons[i];
    return NULL;
}
