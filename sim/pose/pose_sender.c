// SPDX-License-Identifier: Apache-2.0
// A tracker on the simulated bus: sends a pose list, each pose at its own time.
#include "sim/pose/pose_sender.h"

#include "firmware/can_protocol.h"

bool pose_sender_open(pose_sender_t *sender, const pose_sender_config_t *config)
{
    hal_can_t *can = sim_bus_attach(config->bus);
    if (can == NULL)
        return false;
    *sender = (pose_sender_t){.config = *config, .can = can};
    return true;
}

static bool send_pose(pose_sender_t *sender, const pose_list_entry_t *entry)
{
    const uint64_t wrap_us = sender->config.fd ? CAN_POSE_FD_WRAP_US : CAN_POSE_SET_WRAP_US;
    const can_pose_t pose = {
        .pose = entry->pose,
        .capture_time_us = (uint64_t)entry->time_us % wrap_us,
        .quality = CAN_POSE_TRACKED,
        .counter = sender->counter,
    };
    hal_can_frame_t frame[CAN_POSE_PARTS];
    const int frames = sender->config.fd ? 1 : CAN_POSE_PARTS;
    if (!(sender->config.fd ? can_pose_fd_encode(frame, &pose) : can_pose_set_encode(frame, &pose)))
        return false;
    bool ok = true;
    for (int i = 0; i < frames; i++)
        ok &= hal_can_send(sender->can, &frame[i]) == HAL_OK;
    return ok;
}

void pose_sender_advance(pose_sender_t *sender, int64_t until_us)
{
    const pose_list_t *list = sender->config.list;
    const int counters = sender->config.fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS;
    while (sender->next < list->count) {
        const pose_list_entry_t *entry = &list->entry[sender->next];
        const int64_t due_us = sender->config.start_us + entry->time_us - list->entry[0].time_us;
        if (due_us > until_us)
            break;
        sim_bus_advance(sender->config.bus, due_us);
        const bool sent = send_pose(sender, entry);
        sender->sent += sent;
        sender->unsent += !sent;
        sender->counter = (uint8_t)((sender->counter + 1) % counters);
        sender->next++;
    }
    sim_bus_advance(sender->config.bus, until_us);
}
