// SPDX-License-Identifier: Apache-2.0
// The one place where the firmware reads the bus.
#include "firmware/bus_receive.h"

#include <stddef.h>

static void leave_bus_off(const bus_receivers_t *to, hal_can_t *can)
{
    if (hal_can_state(can) != HAL_CAN_BUS_OFF)
        return;
    to->faults->bus_off++;
    if (hal_can_restart(can) != HAL_OK)
        to->faults->io++;
}

static void hand_on(const bus_receivers_t *to, const hal_can_frame_t *frame)
{
    can_check_t check = to->time == NULL ? CAN_CHECK_OTHER : bus_master_hear(to->time, frame);
    if (check == CAN_CHECK_OTHER && to->clock != NULL)
        check =
            frame_clock_hear(to->clock, frame, frame->time_us, bus_time_from_local(&to->time->time, frame->time_us));
    can_faults_count(to->faults, check);
    if (check != CAN_CHECK_OTHER || pose_from_frame(to->poses, to->time, frame, to->faults) || to->commands == NULL)
        return;
    (void)isotp_take(to->commands, frame, frame->time_us);
}

static void take(const bus_receivers_t *to, const hal_can_frame_t *frame)
{
    hal_can_frame_t believed[CAN_AUTH_MAX_FRAMES];
    if (to->auth == NULL || to->auth->key == NULL) {
        hand_on(to, frame);
        return;
    }
    const int frames = bus_auth_take(to->auth, frame, believed, to->faults);
    for (int i = 0; i < frames; i++)
        hand_on(to, &believed[i]);
}

static void take_waiting(const bus_receivers_t *to, hal_can_t *can)
{
    for (int i = 0; i < BUS_RECEIVE_FRAMES; i++) {
        hal_can_frame_t frame;
        const hal_status_t status = hal_can_receive(can, &frame);
        if (status == HAL_EMPTY)
            return;
        if (status != HAL_OK) {
            to->faults->io++;
            return;
        }
        take(to, &frame);
    }
    to->faults->overrun++;
}

void bus_receive(const bus_receivers_t *to, hal_can_t *can)
{
    leave_bus_off(to, can);
    take_waiting(to, can);
    to->faults->lost = hal_can_lost(can); /* afterwards: some losses are known only by the frame after them */
}
