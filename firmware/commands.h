// SPDX-License-Identifier: Apache-2.0
// Does what operators ask of a board over the bus, and replies (command.h has the bytes).
//
// What is asked for stays until it is asked otherwise, or the board starts anew; a freeze counts before a pattern. A
// method is to be had when the board made itself ready for it at its start: its room's own, the cheaper ones that stand
// in for that, and as many of the others as there is room for (warp_add_method()).
#ifndef FIRMWARE_COMMANDS_H
#define FIRMWARE_COMMANDS_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/command.h"
#include "firmware/isotp.h"
#include "firmware/update.h"

typedef struct projector projector_t;

enum { COMMANDS_FRAMES = 8 /**< sent per step at most */ };

/** The link to operators, and what they want of the board. No pointers inside. */
typedef struct {
    isotp_t link;              /**< hears the board's identifier, CAN_ID_COMMAND + node */
    bool frozen;               /**< the wall keeps its last picture */
    command_pattern_t pattern; /**< shown in place of the corrected picture, unless it is none */
    int32_t wanted_latency_ms; /**< pose to photon, of all boards alike (frame_latency.h); 0: each as early as it can */
    bool reboot;               /**< asked for */
    update_refusal_t refusal;  /**< why the newest COMMAND_UPDATE was not done */
} commands_t;

/** Begin to listen; nothing is asked for but the room's latency. @param node  1 to CAN_MAX_NODE. */
void commands_init(commands_t *commands, int32_t node, int32_t latency_ms);

/**
 * Execute the request that has come, if any, and send what is due of a reply. A request that comes while a reply is
 * under way waits for its end. Call it once a step, after the bus was read. Never blocks.
 */
void commands_step(projector_t *projector, int64_t now_us);

/** @return A reboot was asked for, and the reply is out: feed the watchdog no more. */
bool commands_reboot(const commands_t *commands);

#endif
