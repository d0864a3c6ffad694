// SPDX-License-Identifier: Apache-2.0
// Encoder and decoder of Counts.
#include "firmware/can_counts.h"

#include "firmware/can_classic.h"

/* The signals of wallwarp.dbc. */
static const can_field_t COUNTS_TAGS = {12, 12}, COUNTS_GUESSED = {24, 12}, COUNTS_LEADERS = {36, 8},
                         COUNTS_EPOCHS = {44, 8}, COUNTS_COMMANDS = {52, 12};

bool can_counts_encode(hal_can_frame_t *frame, const can_counts_t *counts)
{
    if (!can_classic_node_fits(counts->node, counts->counter))
        return false;
    *frame = can_classic_frame(CAN_ID_COUNTS + (uint32_t)counts->node, counts->counter);
    can_field_put(frame, COUNTS_TAGS, counts->tags_lost);
    can_field_put(frame, COUNTS_GUESSED, counts->guessed);
    can_field_put(frame, COUNTS_LEADERS, counts->leaders);
    can_field_put(frame, COUNTS_EPOCHS, counts->epochs_missed);
    can_field_put(frame, COUNTS_COMMANDS, counts->command_faults);
    can_classic_protect(frame);
    return true;
}

can_check_t can_counts_decode(can_counts_t *counts, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_COUNTS);
    if (check != CAN_CHECK_OK)
        return check;
    *counts = (can_counts_t){
        .node = (uint8_t)(frame->id - CAN_ID_COUNTS),
        .counter = can_classic_counter(frame),
        .tags_lost = can_field_get(frame, COUNTS_TAGS),
        .guessed = can_field_get(frame, COUNTS_GUESSED),
        .leaders = can_field_get(frame, COUNTS_LEADERS),
        .epochs_missed = can_field_get(frame, COUNTS_EPOCHS),
        .command_faults = can_field_get(frame, COUNTS_COMMANDS),
    };
    return CAN_CHECK_OK;
}
