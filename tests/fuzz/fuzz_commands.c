// SPDX-License-Identifier: Apache-2.0
// Fuzzes a board's commands, from the frames on: whatever comes, it replies as it should, never sends too much, and is
// asked for nothing that is not legal.
#include "firmware/commands.h"

#include <string.h>

#include "firmware/projector.h"
#include "firmware/update_status.h"
#include "sim/devices/sim_update.h"
#include "tests/fuzz/input.h"
#include "tests/fuzz/input_frame.h"

enum { NODE = 5, STEP_US = 16667, MOST_STEPS = 200, QUEUE_FRAMES = 256 };

/* What the board sends. */
struct hal_can {
    hal_can_frame_t frame[QUEUE_FRAMES];
    int count;
    bool full;
};

hal_status_t hal_can_send(hal_can_t *port, const hal_can_frame_t *frame)
{
    if (port->full || port->count == QUEUE_FRAMES)
        return HAL_FULL;
    port->frame[port->count++] = *frame;
    return HAL_OK;
}

/* Of these the loop body alone makes use. */
hal_status_t hal_can_receive(hal_can_t *port, hal_can_frame_t *frame)
{
    (void)port;
    (void)frame;
    return HAL_EMPTY;
}

uint32_t hal_can_lost(const hal_can_t *port)
{
    (void)port;
    return 0;
}

hal_can_state_t hal_can_state(const hal_can_t *port)
{
    (void)port;
    return HAL_CAN_ERROR_ACTIVE;
}

hal_status_t hal_can_restart(hal_can_t *port)
{
    (void)port;
    return HAL_OK;
}

static projector_t projector;
static hal_can_t can;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    const uint8_t border[3] = {0, 0, 0};
    (void)argc;
    (void)argv;
    projector.board.can = &can;
    projector.node = NODE;
    projector.choice.clock.rate = (frame_rate_t){60, 1};
    projector.room_method = warp_method_default();
    warp_init(&projector.warp, *projector.room_method, false, border);
    for (int i = 0; i < WARP_METHODS; i++)
        (void)warp_add_method(&projector.warp, warp_methods[i]);
    return 0;
}

static void check_wishes(void)
{
    commands_t *c = &projector.commands;
    fuzz_check((int)c->pattern >= 0 && c->pattern < COMMAND_PATTERNS, "the pattern is one");
    fuzz_check(c->wanted_latency_ms >= 0 && c->wanted_latency_ms <= COMMAND_MOST_LATENCY_US / 1000,
               "the latency is in its range");
    fuzz_check(warp_has_method(&projector.warp, projector.warp.method), "the board is ready for its method");
    if (c->reboot)
        fuzz_check(c->link.in.length == 7 && memcmp(c->link.in.data, "\x06reboot", 7) == 0, "a reboot has its word");
    c->reboot = false;
}

static int64_t switched_us; /* as it was after the step before */

/* A switch is asked for after a promise and its confirmation only, and its moment is not far. */
static void check_update(update_plan_t plan, int64_t now_us)
{
    const update_t *u = &projector.update;
    fuzz_check((unsigned)u->plan < UPDATE_PLANS, "the plan is one");
    fuzz_check(u->plan == UPDATE_NO_PLAN || u->switch_us - now_us <= 2 * (int64_t)UPDATE_MOST_AHEAD_US,
               "a switch is not far");
    fuzz_check(sim_update_switched_us(projector.board.update) == switched_us || plan == UPDATE_CONFIRMED,
               "only what is confirmed is done");
    switched_us = sim_update_switched_us(projector.board.update);
}

static void step(int64_t *now_us)
{
    const int before = can.count;
    *now_us += STEP_US;
    const sim_update_board_t board = sim_update_advance(projector.board.update, *now_us);
    (void)board; /* this one is never down */
    commands_step(&projector, *now_us);
    const update_plan_t plan = projector.update.plan;
    update_step(&projector, *now_us);
    check_update(plan, *now_us);
    fuzz_check(can.count - before <= COMMANDS_FRAMES, "a step sends few frames");
    for (int i = before; i < can.count; i++)
        fuzz_check(can.frame[i].id == CAN_ID_REPLY + NODE && can.frame[i].length == 8 && !can.frame[i].fd,
                   "replies have the board's identifier");
    check_wishes();
}

/* Any bytes; or an update, whose words hardly come by chance. */
static int read_request(input_t *input, uint8_t request[COMMAND_MAX_BYTES + 8])
{
    static const char *const texts[] = {"/wallwarp-host-0.6.raucb", "usb", "/a-.raucb", "0.6", "0.5", ""};
    const int most = COMMAND_MAX_BYTES + 8, length = input_range(input, 1, most);
    if (length > COMMAND_MAX_BYTES) {
        command_t command = {.kind = COMMAND_UPDATE,
                             .update = (command_update_t)input_range(input, 0, COMMAND_UPDATES - 1),
                             .bus_time_us = input_bits(input, 3)};
        const char *text = texts[input_range(input, 0, sizeof texts / sizeof texts[0] - 1)];
        memcpy(command.text, text, strlen(text));
        return command_encode(request, &command);
    }
    for (int i = 0; i < length; i++)
        request[i] = input_byte(input);
    return length;
}

/* Whole requests are answered by what command_decode() says of them. */
static void ask(input_t *input, int64_t *now_us)
{
    uint8_t request[COMMAND_MAX_BYTES + 8];
    isotp_t tool;
    const int length = read_request(input, request);
    *now_us += 2 * ISOTP_TIMEOUT_US; /* what came before is over */
    step(now_us);
    step(now_us);
    isotp_init(&tool, CAN_ID_REPLY + NODE, CAN_ID_COMMAND + NODE);
    fuzz_check(isotp_send(&tool, request, length, *now_us), "a request can be sent");
    const uint8_t *reply = NULL;
    for (int i = 0; i < MOST_STEPS && isotp_received(&tool, &reply) == 0; i++) {
        hal_can_frame_t frame;
        while (isotp_next(&tool, &frame, *now_us))
            (void)isotp_take(&projector.commands.link, &frame, *now_us);
        can.count = 0;
        step(now_us);
        for (int k = 0; k < can.count; k++)
            (void)isotp_take(&tool, &can.frame[k], *now_us);
    }
    command_t command = {.kind = COMMAND_HELLO};
    const bool of_key = request[0] == COMMAND_NONCE || request[0] == COMMAND_SESSION;
    const command_result_t expected = of_key ? COMMAND_UNKNOWN : command_decode(&command, request, length);
    const int bytes = isotp_received(&tool, &reply);
    fuzz_check(bytes >= 2 && reply[0] == (request[0] | COMMAND_REPLY_FLAG), "there is a reply to it");
    const bool may_be_impossible = command.kind == COMMAND_METHOD || command.kind == COMMAND_UPDATE;
    fuzz_check(reply[1] == expected || (may_be_impossible && reply[1] == COMMAND_IMPOSSIBLE), "its result is right");
    if (command.kind == COMMAND_UPDATE) {
        update_status_t status;
        fuzz_check(reply[1] == COMMAND_OK ? update_status_decode(&status, reply + 2, bytes - 2)
                                          : bytes == 3 && reply[2] != UPDATE_DONE,
                   "it says how the update stands, or why not");
        return;
    }
    fuzz_check(bytes == 2 || reply[1] == COMMAND_OK, "what is refused has no answer");
}

static void one_turn(input_t *input, int64_t *now_us)
{
    const uint8_t kind = input_byte(input);
    hal_can_frame_t frame = {.id = CAN_ID_COMMAND + NODE, .length = 8};
    can.count = 0;
    can.full = kind == 0x7F;
    switch (kind % 4) {
    case 0:
        can.full = false;
        ask(input, now_us);
        return;
    case 1:
        frame = input_frame(input);
        break;
    case 2:
        *now_us += input_number(input, 22) & INT64_MAX >> 40;
        return;
    default:
        frame.length = (uint8_t)input_range(input, 0, 8);
        for (int i = 0; i < frame.length; i++)
            frame.data[i] = input_byte(input);
    }
    (void)isotp_take(&projector.commands.link, &frame, *now_us);
    step(now_us);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    static const sim_update_settings_t update = {.running = "0.5", .install_us = 1000000, .reboot_us = 1000000};
    char error[FILE_ERROR_LENGTH];
    int64_t now_us = 1000000;
    projector.board.update = sim_update_create(&update, now_us, error);
    switched_us = INT64_MIN;
    commands_init(&projector.commands, NODE, 0);
    update_init(&projector.update, now_us);
    bus_time_begin(&projector.time.time, now_us, now_us);
    projector.time.own = true;
    event_watch_init(&projector.events, NODE);
    projector.ladder = ladder_of(projector.room_method);
    projector_begin_ladder(&projector);
    while (input.left > 0)
        one_turn(&input, &now_us);
    sim_update_destroy(projector.board.update);
    return 0;
}
