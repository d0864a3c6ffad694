// SPDX-License-Identifier: Apache-2.0
// A tracker on the simulated bus: sends a pose list, each pose at its own time, and gives bus time.
#include "sim/pose/pose_sender.h"

#include "firmware/can_protocol.h"

enum { TICK_US = 5000 };

bool pose_sender_open(pose_sender_t *sender, const pose_sender_config_t *config)
{
    hal_can_t *can = sim_bus_attach(config->bus);
    if (can == NULL)
        return false;
    *sender = (pose_sender_t){.config = *config, .can = can, .tick_us = sim_bus_now_us(config->bus)};
    pose_auth_init(&sender->auth, config->key, config->session, (uint64_t)sender->tick_us);
    bus_master_init(&sender->time, BUS_MASTER_TRACKER, sender->tick_us);
    return true;
}

static bool send_pose(pose_sender_t *sender, const pose_list_entry_t *entry, int64_t now_us)
{
    const uint64_t wrap_us = sender->config.fd ? CAN_POSE_FD_WRAP_US : CAN_POSE_SET_WRAP_US;
    const can_pose_t pose = {
        .pose = entry->pose,
        .capture_time_us = (uint64_t)now_us % wrap_us,
        .quality = CAN_POSE_TRACKED,
        .counter = sender->counter,
    };
    hal_can_frame_t frame[POSE_AUTH_FRAMES];
    if (!(sender->config.fd ? can_pose_fd_encode(frame, &pose) : can_pose_set_encode(frame, &pose)))
        return false;
    const int frames = pose_auth_sign_pose(sender->config.key == NULL ? NULL : &sender->auth, frame,
                                           sender->config.fd ? 1 : CAN_POSE_PARTS, pose.viewer, (uint64_t)now_us);
    bool ok = frames > 0;
    for (int i = 0; i < frames; i++)
        ok &= hal_can_send(sender->can, &frame[i]) == HAL_OK;
    return ok;
}

static void send_next(pose_sender_t *sender, int64_t now_us)
{
    const int counters = sender->config.fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS;
    const bool sent = send_pose(sender, &sender->config.list->entry[sender->next], now_us);
    sender->sent += sent;
    sender->unsent += !sent;
    sender->counter = (uint8_t)((sender->counter + 1) % counters);
    sender->next++;
}

static int64_t next_pose_us(const pose_sender_t *sender)
{
    const pose_list_t *list = sender->config.list;
    if (sender->next == list->count)
        return INT64_MAX;
    return sender->config.start_us + list->entry[sender->next].time_us - list->entry[0].time_us;
}

static void sign_and_tell(pose_sender_t *sender)
{
    hal_can_frame_t frame;
    const uint64_t now_us = (uint64_t)sender->tick_us;
    bool ok = true; /* else the queue is full, and boards will ask again */
    if (sender->time.paired && pose_auth_sign_time(&sender->auth, sender->time.pair, now_us, &frame))
        ok = hal_can_send(sender->can, &frame) == HAL_OK;
    while (ok && session_teller_next(&sender->auth.teller, &frame, sender->tick_us))
        ok = hal_can_send(sender->can, &frame) == HAL_OK;
}

static void give_time(pose_sender_t *sender)
{
    hal_can_frame_t frame;
    while (hal_can_receive(sender->can, &frame) == HAL_OK) {
        (void)bus_master_hear(&sender->time, &frame);
        if (sender->config.key != NULL)
            session_teller_hear(&sender->auth.teller, &frame, sender->tick_us, (uint64_t)sender->tick_us);
    }
    bus_master_step(&sender->time, sender->can, sender->tick_us);
    if (sender->config.key != NULL)
        sign_and_tell(sender);
    sender->tick_us += TICK_US;
}

void pose_sender_advance(pose_sender_t *sender, int64_t until_us)
{
    for (;;) {
        const int64_t pose_us = next_pose_us(sender), tick_us = sender->config.sync ? sender->tick_us : INT64_MAX;
        const int64_t next_us = pose_us < tick_us ? pose_us : tick_us;
        if (next_us > until_us)
            break;
        sim_bus_advance(sender->config.bus, next_us);
        if (tick_us == next_us)
            give_time(sender);
        else
            send_next(sender, next_us);
    }
    sim_bus_advance(sender->config.bus, until_us);
}
