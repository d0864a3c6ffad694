// SPDX-License-Identifier: Apache-2.0
// Why a board shows its safe picture, in the words that this has for people.
#include "firmware/safe_reason.h"

#include "firmware/projector.h"

const char *safe_reason(const projector_t *p)
{
    const bool running = p->report.state == CAN_BOARD_WAITING || p->report.state == CAN_BOARD_SAFE;
    if (running && hal_can_state(p->board.can) == HAL_CAN_BUS_OFF)
        return "bus off";
    switch (p->report.state) {
    case CAN_BOARD_WAITING:
        return p->poses.any ? "no video yet" : "no pose yet";
    case CAN_BOARD_SAFE:
        return "no pose";
    case CAN_BOARD_FAULT:
        return "no video";
    case CAN_BOARD_RUNNING:
    case CAN_BOARD_HOLDING:
    case CAN_BOARD_FROZEN:
    case CAN_BOARD_PATTERN:
    case CAN_BOARD_STATES:
        break;
    }
    return "this pose can't be shown here"; /* the state is that of the step's begin, and no picture could be made */
}
