// SPDX-License-Identifier: Apache-2.0
// Plays a room's update in virtual time.
#include "sim/update/update_play.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/devices/sim_update.h"
#include "sim/pose/pose_sender.h"
#include "sim/run/sim_world.h"

enum {
    START_US = 10000,     /* of the first refresh */
    WARM_UP_US = 8000000, /* until all boards know bus time */
    LOST_US = 5000000,
    MOST_US = 1800000000,
    CAMERA_WIDTH = 96,
    CAMERA_HEIGHT = 54,
    PANEL_WIDTH = 32,
    PANEL_HEIGHT = 18,
    TURNS = 8 /* of the operator's program in a refresh */
};

const char update_play_old[] = "0.5", update_play_new[] = "0.6";
static pose_list_entry_t nowhere = {.pose = {.quaternion_q30 = {1 << 30, 0, 0, 0}}};
static const pose_list_t one_pose = {&nowhere, 1}; /* a tracker that has one, and bus time */
static const char source[] = "/wallwarp-sim-0.6.raucb";

struct update_play {
    update_play_settings_t settings;
    room_t room; /* small */
    video_t *video;
    sim_world_t *world;
    hal_can_t *can;        /* the operator's */
    pose_sender_t tracker; /* with a key */
    room_update_t operator_side;
    room_update_result_t installed;
    int64_t step, now_us;
    bool begun;
    bool unplugged[ROOM_MAX_BOARDS];
    char error[FILE_ERROR_LENGTH];
};

const char *update_play_failure_name(update_play_failure_t failure)
{
    static const char *const names[UPDATE_PLAY_FAILURES] = {"well", "install", "crash", "silent", "deaf", "lost"};
    return names[failure];
}

const char *update_play_look_name(update_play_look_t look)
{
    static const char *const names[UPDATE_PLAY_LOOKS] = {"idle", "installing", "ready", "promised",
                                                         "down", "trial",      "new",   "failed"};
    return names[look];
}

static void make_small(room_t *room)
{
    room->camera.width = CAMERA_WIDTH;
    room->camera.height = CAMERA_HEIGHT;
    room->rule = (pose_for_frame_rule_t){.mode = POSE_FOR_FRAME_DELAY};
    for (int i = 0; i < room->board_count; i++) {
        room->board[i].wall.panel_width = PANEL_WIDTH;
        room->board[i].wall.panel_height = PANEL_HEIGHT;
        room->board[i].method = warp_method_from_name("none+nearest");
    }
}

static hal_update_t *agent(const update_play_t *p, int board)
{
    return sim_world_devices(p->world, board)->update;
}

static bool open_world(update_play_t *p, char error[FILE_ERROR_LENGTH])
{
    const update_play_settings_t *s = &p->settings;
    const sim_update_settings_t update = {update_play_old, s->install_us, s->reboot_us};
    const sim_world_config_t config = {
        .room = &p->room,
        .video = p->video,
        .refresh = {START_US, p->room.refresh.frames, p->room.refresh.seconds},
        .seed = s->seed,
        .key = s->key,
        .clocks = {.offset_us = 3600000000, .drift_ppb = 50000, .jitter_us = 200},
        .update = &update,
    };
    p->world = sim_world_create(&config, error);
    if (p->world == NULL)
        return false;
    sim_bus_fail(sim_world_bus(p->world), SIM_BUS_LOSE, (sim_bus_fail_t){.ppm = s->lose_ppm});
    p->can = sim_bus_attach(sim_world_bus(p->world));
    for (int i = 0; i < p->room.board_count; i++) {
        sim_update_faults(agent(p, i))->install = s->failure[i] == UPDATE_PLAY_INSTALL;
        sim_update_faults(agent(p, i))->start = s->failure[i] == UPDATE_PLAY_CRASH;
    }
    const pose_sender_config_t tracker = {.bus = sim_world_bus(p->world),
                                          .list = &one_pose,
                                          .start_us = START_US,
                                          .sync = true,
                                          .key = s->key,
                                          .session = s->seed};
    const bool tracked = s->key == NULL || pose_sender_open(&p->tracker, &tracker);
    return (p->can != NULL && tracked) || file_error(error, "update", "no room on the bus for operator and tracker");
}

update_play_t *update_play_open(const update_play_settings_t *settings, char error[FILE_ERROR_LENGTH])
{
    update_play_t *p = calloc(1, sizeof *p);
    if (p == NULL) {
        file_error(error, "update", "out of memory");
        return NULL;
    }
    p->settings = *settings;
    p->room = *settings->room;
    make_small(&p->room);
    p->video = video_open("pattern", CAMERA_WIDTH, CAMERA_HEIGHT, error);
    if (p->video != NULL && open_world(p, error))
        return p;
    update_play_close(p);
    return NULL;
}

void update_play_close(update_play_t *p)
{
    if (p == NULL)
        return;
    sim_world_destroy(p->world);
    video_close(p->video);
    free(p);
}

static void begin(update_play_t *p, room_update_task_t task)
{
    const room_update_settings_t settings = {
        .task = task, .source = source, .ahead_us = p->settings.ahead_us, .auth = p->settings.key};
    room_update_init(&p->operator_side, &settings, &p->room, p->now_us);
    p->begun = true;
}

static void plug(update_play_t *p, int board, bool out)
{
    if (out == p->unplugged[board])
        return;
    p->unplugged[board] = out;
    if (out)
        sim_bus_fail_unplug(sim_world_devices(p->world, board)->can);
    else
        sim_bus_replug(sim_world_devices(p->world, board)->can);
}

/* Cables that come out at a step of the operator's, and go back. */
static void move_cables(update_play_t *p)
{
    const room_update_t *u = &p->operator_side;
    const bool switching = u->settings.task == ROOM_UPDATE_SWITCH;
    const bool after = p->now_us > u->switch_us + LOST_US;
    for (int i = 0; i < p->room.board_count; i++) {
        if (p->settings.failure[i] == UPDATE_PLAY_SILENT)
            plug(p, i, switching && u->step != ROOM_UPDATE_LOOK);
        if (p->settings.failure[i] == UPDATE_PLAY_DEAF)
            plug(p, i, switching && u->step >= ROOM_UPDATE_CONFIRM && !after);
        if (p->settings.failure[i] == UPDATE_PLAY_LOST)
            plug(p, i, switching && (u->step == ROOM_UPDATE_WATCH || u->step == ROOM_UPDATE_UNDO) && !after);
    }
}

/* The operator's program, several times in a refresh. */
static void operate(update_play_t *p, int64_t until_us)
{
    hal_can_frame_t frame;
    for (int turn = 1; turn <= TURNS; turn++) {
        const int64_t now_us = p->now_us + (until_us - p->now_us) * turn / TURNS;
        if (p->settings.key != NULL)
            pose_sender_advance(&p->tracker, now_us);
        sim_bus_advance(sim_world_bus(p->world), now_us);
        while (hal_can_receive(p->can, &frame) == HAL_OK)
            room_update_hear(&p->operator_side, &frame, now_us);
        if (!p->begun)
            continue;
        room_update_step(&p->operator_side, now_us);
        while (room_update_next(&p->operator_side, &frame, now_us))
            if (hal_can_send(p->can, &frame) != HAL_OK)
                break; /* lost: the board is asked again */
    }
}

/* @return Does it go on? */
static bool judge(update_play_t *p)
{
    const room_update_t *u = &p->operator_side;
    if (!p->begun && p->now_us >= WARM_UP_US)
        begin(p, ROOM_UPDATE_INSTALL);
    else if (p->begun && u->result != ROOM_UPDATE_WORKING) {
        if (u->settings.task == ROOM_UPDATE_SWITCH || u->result != ROOM_UPDATE_DONE)
            return false;
        p->installed = u->result;
        begin(p, ROOM_UPDATE_SWITCH);
    }
    return p->now_us < MOST_US;
}

bool update_play_step(update_play_t *p)
{
    const sim_rate_t refresh = {START_US, p->room.refresh.frames, p->room.refresh.seconds};
    const int64_t next_us = sim_rate_time_us(&refresh, p->step++);
    operate(p, next_us);
    p->now_us = next_us;
    if (!sim_world_step(p->world, next_us, p->error))
        return false;
    move_cables(p);
    return judge(p);
}

const char *update_play_error(const update_play_t *p)
{
    return p->error[0] == '\0' ? NULL : p->error;
}

int64_t update_play_now_us(const update_play_t *p)
{
    return p->now_us;
}

const room_update_t *update_play_operator(const update_play_t *p)
{
    return &p->operator_side;
}

room_update_result_t update_play_installed(const update_play_t *p)
{
    return p->installed;
}

update_play_look_t update_play_look(const update_play_t *p, int board)
{
    const hal_update_state_t *said = sim_update_said(agent(p, board));
    const update_t *board_side = &sim_world_projector(p->world, board)->update;
    const bool new = strcmp(said->running, update_play_new) == 0;
    switch (said->doing) {
    case HAL_UPDATE_SWITCHING:
        return UPDATE_PLAY_DOWN;
    case HAL_UPDATE_INSTALLING:
        return UPDATE_PLAY_INSTALLING;
    case HAL_UPDATE_FAILED:
        return UPDATE_PLAY_FAILED;
    case HAL_UPDATE_READY:
        if (board_side->said.doing == HAL_UPDATE_SWITCHING)
            return UPDATE_PLAY_DOWN; /* its agent has not heard it yet */
        return board_side->plan == UPDATE_NO_PLAN ? UPDATE_PLAY_READY : UPDATE_PLAY_PROMISED;
    case HAL_UPDATE_IDLE:
    case HAL_UPDATE_DOINGS:
        break;
    }
    return !new ? UPDATE_PLAY_IDLE : said->trial ? UPDATE_PLAY_TRIAL : UPDATE_PLAY_NEW;
}

int32_t update_play_progress(const update_play_t *p, int board)
{
    return sim_update_said(agent(p, board))->progress;
}

int64_t update_play_switched_us(const update_play_t *p, int board)
{
    return sim_update_switched_us(agent(p, board));
}

const char *update_play_running(const update_play_t *p, int board)
{
    return sim_update_said(agent(p, board))->running;
}

bool update_play_has_bundle(const update_play_t *p, int board)
{
    return strcmp(sim_update_said(agent(p, board))->other, update_play_new) == 0;
}
