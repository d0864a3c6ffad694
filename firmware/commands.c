// SPDX-License-Identifier: Apache-2.0
// Does what operators ask of a board over the bus, and replies.
#include "firmware/commands.h"

#include <string.h>

#include "firmware/byte_order.h"
#include "firmware/frame_latency.h"
#include "firmware/projector.h"
#include "firmware/update_status.h"
#include "firmware/version.h"

enum { HEADER_BYTES = 2, NUMBER_BYTES = 4, NONCE_BYTES = 8, LOG_BYTES = HEADER_BYTES + NUMBER_BYTES };

_Static_assert(LOG_BYTES + COMMAND_MOST_EVENTS * EVENT_BYTES <= COMMAND_REPLY_BYTES, "a reply holds these events");
_Static_assert(HEADER_BYTES + (int)UPDATE_STATUS_BYTES <= (int)COMMAND_REPLY_BYTES, "and how an update stands");
_Static_assert((int)COMMAND_REPLY_BYTES <= (int)ISOTP_MAX_LENGTH, "a reply is one message");

void commands_init(commands_t *commands, int32_t node, int32_t latency_ms)
{
    *commands = (commands_t){.pattern = COMMAND_PATTERN_NONE, .wanted_latency_ms = latency_ms};
    isotp_init(&commands->link, CAN_ID_COMMAND + (uint32_t)node, CAN_ID_REPLY + (uint32_t)node);
}

/* The pictures to come are made with it, or with what stands in for it. */
static command_result_t use_method(projector_t *p, const warp_method_t *method)
{
    if (method == p->ladder.method[0])
        return COMMAND_OK;
    if (!warp_has_method(&p->warp, *method))
        return COMMAND_IMPOSSIBLE;
    const uint32_t changes = p->degrade.changes;
    p->ladder = ladder_of(method);
    projector_begin_ladder(p);
    p->degrade.changes = changes;
    return COMMAND_OK;
}

/* In whole milliseconds, as Latency says it. */
static int32_t wanted_ms(const command_t *command)
{
    return (int32_t)((command->latency_us + 999) / 1000);
}

static command_result_t want_latency(projector_t *p, const command_t *command, int64_t now_us)
{
    const int32_t wanted = wanted_ms(command);
    if (wanted != 0 && !frame_latency_of_wish(&p->choice.clock, wanted, now_us).possible)
        return COMMAND_IMPOSSIBLE;
    p->commands.wanted_latency_ms = wanted;
    return COMMAND_OK;
}

static command_result_t execute(projector_t *p, const command_t *command, int64_t now_us)
{
    commands_t *c = &p->commands;
    switch (command->kind) {
    case COMMAND_METHOD:
        return use_method(p, command->method == NULL ? p->room_method : command->method);
    case COMMAND_FREEZE:
        c->frozen = command->freeze;
        break;
    case COMMAND_PATTERN:
        c->pattern = command->pattern;
        break;
    case COMMAND_LATENCY:
        return want_latency(p, command, now_us);
    case COMMAND_REBOOT:
        c->reboot = true;
        break;
    case COMMAND_SESSION:
        bus_auth_begin_session(&p->auth, command->session, command->bus_time_us, now_us);
        break;
    case COMMAND_UPDATE:
        c->refusal = update_execute(p, command, now_us);
        return c->refusal == UPDATE_DONE ? COMMAND_OK : COMMAND_IMPOSSIBLE;
    case COMMAND_HELLO:
    case COMMAND_LOG:
    case COMMAND_NONCE:
        break;
    }
    return COMMAND_OK;
}

/* What was asked for. @return Bytes, after the header. */
static int put_answer(projector_t *p, const command_t *command, uint8_t *bytes, int64_t now_us)
{
    frame_latency_t latency;
    update_status_t update;
    uint32_t first = command->first_event;
    int events = 0;
    switch (command->kind) {
    case COMMAND_HELLO:
        bytes[0] = (uint8_t)p->node;
        put_u32(bytes + 1, p->events.log.count);
        memcpy(bytes + 1 + NUMBER_BYTES, firmware_version, sizeof firmware_version - 1);
        return 1 + NUMBER_BYTES + (int)sizeof firmware_version - 1;
    case COMMAND_LATENCY:
        latency = frame_latency_of_wish(&p->choice.clock, p->commands.wanted_latency_ms, now_us);
        put_u32(bytes, (uint32_t)latency.will_us);
        return NUMBER_BYTES;
    case COMMAND_LOG:
        events = event_log_pack(&p->events.log, bytes + NUMBER_BYTES, &first, COMMAND_MOST_EVENTS);
        put_u32(bytes, first);
        return NUMBER_BYTES + EVENT_BYTES * events;
    case COMMAND_NONCE:
        put_u64(bytes, bus_auth_give_nonce(&p->auth, now_us));
        return NONCE_BYTES;
    case COMMAND_UPDATE:
        update = update_status_of(p, now_us);
        return update_status_encode(bytes, &update);
    case COMMAND_METHOD:
    case COMMAND_FREEZE:
    case COMMAND_PATTERN:
    case COMMAND_REBOOT:
    case COMMAND_SESSION:
        break;
    }
    return 0;
}

/* Why it is impossible, for the commands that have more to say than that. @return Bytes, after the header. */
static int put_reason(const projector_t *p, const command_t *command, uint8_t *bytes, int64_t now_us)
{
    if (command->kind == COMMAND_UPDATE)
        bytes[0] = (uint8_t)p->commands.refusal;
    if (command->kind != COMMAND_LATENCY)
        return command->kind == COMMAND_UPDATE;
    const frame_latency_t latency = frame_latency_of_wish(&p->choice.clock, wanted_ms(command), now_us);
    put_u32(bytes, (uint32_t)latency.least_us);
    put_u32(bytes + NUMBER_BYTES, (uint32_t)latency.most_us);
    return 2 * NUMBER_BYTES;
}

/* The request without its code, where there must be one. */
static command_result_t read_request(projector_t *p, command_t *command, const uint8_t *request, int length,
                                     int64_t now_us)
{
    const bool of_key = command->kind == COMMAND_NONCE || command->kind == COMMAND_SESSION;
    if (p->auth.key == NULL && of_key)
        return COMMAND_UNKNOWN;
    if (p->auth.key != NULL && command->kind != COMMAND_NONCE) {
        length = bus_auth_check_command(&p->auth, p->commands.link.receive_id, request, length, now_us);
        if (length == 0) {
            p->can_faults.auth_commands++;
            return COMMAND_REFUSED;
        }
    }
    return command_decode(command, request, length);
}

/* @return Bytes of the reply. */
static int answer(projector_t *p, uint8_t reply[COMMAND_REPLY_BYTES], const uint8_t *request, int length,
                  int64_t now_us)
{
    command_t command = {.kind = (command_kind_t)request[0]};
    command_result_t result = read_request(p, &command, request, length, now_us);
    if (result == COMMAND_OK)
        result = execute(p, &command, now_us);
    event_watch_command(p, &command, result, now_us);
    reply[0] = request[0] | COMMAND_REPLY_FLAG;
    reply[1] = (uint8_t)result;
    if (result == COMMAND_IMPOSSIBLE)
        return HEADER_BYTES + put_reason(p, &command, reply + HEADER_BYTES, now_us);
    return HEADER_BYTES + (result == COMMAND_OK ? put_answer(p, &command, reply + HEADER_BYTES, now_us) : 0);
}

void commands_step(projector_t *p, int64_t now_us)
{
    isotp_t *link = &p->commands.link;
    const uint8_t *request;
    const int length = isotp_received(link, &request);
    if (length > 0 && !isotp_sending(link)) {
        uint8_t reply[COMMAND_REPLY_BYTES];
        const int bytes = answer(p, reply, request, length, now_us);
        isotp_taken(link);
        (void)isotp_send(link, reply, bytes, now_us);
    }
    hal_can_frame_t frame;
    for (int i = 0; i < COMMANDS_FRAMES && isotp_next(link, &frame, now_us); i++)
        if (hal_can_send(p->board.can, &frame) != HAL_OK)
            p->faults.can_send++;
}

bool commands_reboot(const commands_t *commands)
{
    return commands->reboot && !isotp_sending(&commands->link);
}
