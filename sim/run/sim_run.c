// SPDX-License-Identifier: Apache-2.0
// A run of a whole room: from a pose list in virtual time, or in real time with the bus open on a port.
#include "sim/run/sim_run.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/auth_key.h"
#include "hal/hal_random.h"
#include "sim/devices/sim_clock.h"
#include "sim/files/png_file.h"
#include "sim/program.h"
#include "sim/run/page.h"
#include "sim/run/plots.h"
#include "sim/run/run_clean.h"
#include "sim/run/run_loop.h"
#include "sim/run/run_rate.h"
#include "sim/run/run_summary.h"

enum { JUDGED_FRAMES = 8, JUDGED_WITHOUT_END = 60, SESSION = 1, ERROR_LENGTH = ROOM_MESSAGE_LENGTH };

/* Everything that is open during a run. */
typedef struct {
    const sim_run_options_t *options;
    room_t room;
    video_t *video;
    pose_list_t poses;
    image_t original;
    can_auth_t *key;
    uint64_t seed; /* of what nobody shall guess; 0 in virtual time */
    sim_world_t *world;
    pose_sender_t sender;
    socketcand_server_t *server;
    run_files_t files;
    bool files_open;
    run_record_t record;
    run_draw_config_t draw;
    run_pictures_t *pictures;
    run_loop_t loop;
    bool interrupted; /* before the end of a run in virtual time */
    char error[ERROR_LENGTH];
} run_t;

static bool is_real(const run_t *run)
{
    return run->options->poses == NULL;
}

static double refresh_hz(const run_t *run)
{
    return (double)run->loop.refresh.frames / run->loop.refresh.seconds;
}

static bool open_original(run_t *run)
{
    const char *path = run->options->original;
    const camera_t *camera = &run->room.camera;
    if (path == NULL)
        return true;
    if (!png_file_load(path, IMAGE_GRAY8, &run->original, run->error))
        return false;
    const int32_t q = run->original.width / camera->width;
    if (q >= 1 && run->original.width == q * camera->width && run->original.height == q * camera->height)
        return true;
    return file_error(run->error, path, "%d x %d pixels, expected a multiple of the camera's %d x %d",
                      run->original.width, run->original.height, camera->width, camera->height);
}

/* Room, video, poses, original: whatever is read. */
static bool open_inputs(run_t *run)
{
    const sim_run_options_t *options = run->options;
    if (!room_load(&run->room, options->room, program_warn, NULL, run->error))
        return false;
    if (options->poses != NULL && !pose_list_load(&run->poses, options->poses, run->error))
        return false;
    run->video = video_open(options->video, run->room.camera.width, run->room.camera.height, run->error);
    return run->video != NULL && open_original(run);
}

static sim_rate_t choose_refresh(const run_t *run)
{
    if (run->options->rate_hz > 0)
        return run_rate_from_hz(run->options->rate_hz);
    return is_real(run) || run->room.refresh_stated ? run_rate_from_frames(run->room.refresh)
                                                    : run_rate_of_poses(&run->poses);
}

static bool plan(run_t *run)
{
    const sim_run_options_t *options = run->options;
    run_loop_t *loop = &run->loop;
    loop->refresh = choose_refresh(run);
    run->room.refresh = (frame_rate_t){loop->refresh.frames, loop->refresh.seconds}; /* the boards number by it */
    loop->start_us = is_real(run) ? sim_clock_monotonic_us() : 0;
    loop->frames = options->frames > 0 ? options->frames
                   : is_real(run)      ? INT64_MAX
                                       : run_rate_frames(&loop->refresh, &run->poses);
    if (loop->frames > SIM_RUN_MAX_FRAMES && !is_real(run))
        return file_error(run->error, options->poses,
                          "lasts %" PRId64 " frames at %.5g Hz, expected at most %d; --frames N makes the first N",
                          loop->frames, refresh_hz(run), SIM_RUN_MAX_FRAMES);
    loop->refresh.start_us += loop->start_us;
    loop->house = (house_signal_t){.options = options->house, .refresh = loop->refresh};
    if (options->house.node != 0 && room_board_with_node(&run->room, options->house.node) == NULL)
        return file_error(run->error, options->room, "no board has node %d, which --genlock names",
                          options->house.node);
    loop->judge_every = options->judge;
    if (options->judge == SIM_RUN_JUDGE_USUAL)
        loop->judge_every = loop->frames == INT64_MAX      ? JUDGED_WITHOUT_END
                            : loop->frames < JUDGED_FRAMES ? 1
                                                           : (int32_t)(loop->frames / JUDGED_FRAMES);
    return true;
}

static bool open_key(run_t *run)
{
    const char *file = run->options->key;
    if (file == NULL)
        return true;
    if (is_real(run) && hal_random(&run->seed) != HAL_OK)
        return file_error(run->error, file, "no random numbers from the system");
    char error[HAL_KEY_ERROR_LENGTH];
    run->key = auth_key_open(file, error);
    if (run->key == NULL)
        snprintf(run->error, sizeof run->error, "--key: %.500s", error);
    return run->key != NULL;
}

static bool open_world(run_t *run)
{
    static const sim_update_settings_t update = {.running = "0.5", .install_us = 5000000, .reboot_us = 3000000};
    const sim_world_config_t config = {
        .room = &run->room,
        .video = run->video,
        .method = run->options->method,
        .kernels = run->options->kernels,
        .camera = run->options->camera,
        .display = run->options->display,
        .real = is_real(run),
        .start_us = run->loop.start_us,
        .refresh = run->loop.refresh,
        .seed = run->seed,
        .key = run->key,
        .update = &update,
    };
    run->world = sim_world_create(&config, run->error);
    if (run->world == NULL)
        return false;
    sim_bus_t *bus = sim_world_bus(run->world);
    if (is_real(run)) {
        run->server = socketcand_server_open(run->options->bus_port, bus, run->error);
        return run->server != NULL;
    }
    const pose_sender_config_t sender = {
        .bus = bus, .list = &run->poses, .fd = run->room.fd, .sync = true, .key = run->key, .session = SESSION};
    return pose_sender_open(&run->sender, &sender) || file_error(run->error, "bus", "has no room for a tracker");
}

/* What the run is made of must not lie where run_clean() deletes. */
static bool inputs_lie_elsewhere(run_t *run)
{
    const char *inputs[2] = {run->options->video, run->options->original};
    for (int i = 0; i < 2; i++)
        if (inputs[i] != NULL && run_clean_lies_in(run->options->out, inputs[i]))
            return file_error(run->error, inputs[i], "lies in the folder that the run writes to, expected another");
    return true;
}

static bool open_outputs(run_t *run)
{
    if (!inputs_lie_elsewhere(run) || !run_clean(run->options->out, &run->room, run->error))
        return false;
    if (!run_files_open(&run->files, run->options->out, run->loop.start_us, run->error))
        return false;
    run->files_open = true;
    sim_bus_set_log(sim_world_bus(run->world), run_files_log, &run->files);
    run->draw = (run_draw_config_t){&run->room, run->options->out, run->original.data ? &run->original : NULL};
    run->pictures = run_pictures_start(&run->draw, run->error);
    return run->pictures != NULL;
}

static bool make_frames(run_t *run, const volatile sig_atomic_t *stop)
{
    run_loop_t *loop = &run->loop;
    run->record.boards = run->room.board_count;
    loop->room = &run->room;
    loop->world = run->world;
    loop->sender = is_real(run) ? NULL : &run->sender;
    loop->server = run->server;
    loop->record = &run->record;
    loop->files = &run->files;
    loop->pictures = run->pictures;
    loop->stop = stop;
    if (is_real(run)) {
        printf("bus on 127.0.0.1:%d (socketcand, channel can0)\n", socketcand_server_port(run->server));
        fflush(stdout);
    }
    const bool looped = is_real(run) ? run_loop_real(loop) : run_loop_virtual(loop);
    const bool drawn = run_pictures_finish(run->pictures, &run->record, run->error);
    run->pictures = NULL;
    run->interrupted = looped && !is_real(run) && run->record.frames < loop->frames;
    if (!looped && drawn)
        file_error(run->error, "run", "out of memory");
    return looped && drawn;
}

/* Tables, plots, page, and the table on stdout: each is made even when one before it has failed. */
static bool tell(run_t *run)
{
    const sim_run_options_t *options = run->options;
    const run_summary_t summary = {
        .room = &run->room,
        .record = &run->record,
        .folder = options->out,
        .room_name = options->room,
        .video_name = options->video,
        .poses_name = options->poses,
        .original_name = options->original,
        .method_name = options->method != NULL ? options->method->name : NULL,
        .rate_hz = refresh_hz(run),
        .real = is_real(run),
        .skipped = run->loop.skipped,
        .genlock = options->house.on,
        .poses_sent = run->sender.sent,
        .bus = sim_bus_stats(sim_world_bus(run->world)),
    };
    bool ok = run_files_close(&run->files, &run->record, &run->room, run->error);
    run->files_open = false;
    ok = page_write(&summary, run->error) && ok;
    run_summary_print(&summary, stdout);
    fflush(stdout);
    return plots_write(&summary, run->error) && ok;
}

/* A run that ends before its time, on a full disk for one, is told of as well; what is said is why it ended. */
static bool make_and_tell(run_t *run, const volatile sig_atomic_t *stop)
{
    char why[ERROR_LENGTH];
    const bool made = make_frames(run, stop);
    memcpy(why, run->error, sizeof why);
    const bool told = tell(run);
    if (!made)
        memcpy(run->error, why, sizeof why);
    return made && told;
}

static void close_run(run_t *run)
{
    char error[FILE_ERROR_LENGTH];
    (void)run_pictures_finish(run->pictures, &run->record, error);
    if (run->files_open)
        (void)run_files_close(&run->files, &run->record, &run->room, error);
    socketcand_server_close(run->server);
    sim_world_destroy(run->world);
    can_auth_close(run->key);
    run_record_free(&run->record);
    free(run->original.data);
    pose_list_free(&run->poses);
    video_close(run->video);
    free(run);
}

int sim_run(const sim_run_options_t *options, const volatile sig_atomic_t *stop)
{
    static const char name[] = "wallwarp-sim run";
    run_t *run = calloc(1, sizeof *run);
    if (run == NULL) {
        fprintf(stderr, "%s: out of memory\n", name);
        return PROGRAM_FAILED;
    }
    run->options = options;
    const bool ok = open_inputs(run) && plan(run) && open_key(run) && open_world(run) && open_outputs(run) &&
                    make_and_tell(run, stop);
    if (!ok)
        fprintf(stderr, "%s: %s\n", name, run->error);
    if (run->interrupted)
        fprintf(stderr, "%s: interrupted after %" PRId32 " of %" PRId64 " frames\n", name, run->record.frames,
                run->loop.frames);
    const bool done = ok && !run->interrupted;
    close_run(run);
    return program_finish(name) == PROGRAM_DONE && done ? PROGRAM_DONE : PROGRAM_FAILED;
}
