// SPDX-License-Identifier: Apache-2.0
// Fuzzes what a board with a key believes: of strangers nothing that matters, whatever they send, and in between what
// the tracker signs, unless a stranger was in the middle of it.
#include "firmware/bus_auth.h"

#include <stdlib.h>

#include "tests/fuzz/input.h"
#include "tests/fuzz/input_frame.h"

enum { VIEWERS = 4, SESSION = 7, MOST_WAIT_BITS = 34 };

static can_auth_t *key;
static bus_auth_t board;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    static const hal_key_t bytes = {{1, 2, 3}};
    (void)argc;
    (void)argv;
    key = can_auth_open(&bytes);
    if (key == NULL)
        abort();
    return 0;
}

/* May a board believe this without a code? */
static bool is_free(const hal_can_frame_t *frame, uint8_t viewer)
{
    const uint32_t id = frame->id;
    return frame->extended || frame->own ||
           !((id >= 0x040 && id < 0x100) || id == 0x100U + viewer || id == 0x104U + viewer ||
             id / 4 == (0x110U + 4U * viewer) / 4 || (id >= 0x140 && id < 0x1C0) || (id >= 0x540 && id < 0x5C0));
}

static void check_stranger(input_t *input, int64_t now_us)
{
    hal_can_frame_t believed[CAN_AUTH_MAX_FRAMES], frame = input_frame(input);
    can_faults_t faults = {.length = 0};
    frame.time_us = now_us;
    const int frames = bus_auth_take(&board, &frame, believed, &faults);
    fuzz_check(frames == (is_free(&frame, board.viewer) ? 1 : 0), "only what matters not is believed");
    fuzz_check(frames == 0 || can_faults_total(&faults) == 0, "what is believed is no fault");
    fuzz_check(can_faults_total(&faults) <= 1, "a frame is one fault at most");
}

/* Sync, FollowUp and their code, one after the other, with a change in one bit unless it is 0. */
static void check_tracker(input_t *input, can_auth_fresh_t *fresh, int64_t now_us)
{
    hal_can_frame_t frame[3], believed[CAN_AUTH_MAX_FRAMES];
    can_faults_t faults = {.length = 0};
    const can_auth_message_t pair = {frame, 2, CAN_AUTH_ID_TIME};
    const bool made = can_sync_encode(&frame[0], &(can_sync_t){.number = 0}) &&
                      can_follow_up_encode(&frame[1], &(can_follow_up_t){.number = 0, .time_us = 5});
    fuzz_check(made, "a pair can be made");
    can_auth_fresh_step(fresh, auth_clock_least_us(&board.clock, now_us));
    fuzz_check(can_auth_sign(key, *fresh, &pair, &frame[2]), "and signed");
    const int place = input_range(input, 0, 23);
    const uint8_t change = input_byte(input);
    frame[place / 8].data[place % 8] ^= change;
    int frames = 0;
    for (int f = 0; f < 3; f++) {
        frame[f].time_us = now_us;
        frames = bus_auth_take(&board, &frame[f], believed, &faults);
    }
    fuzz_check(frames == (change == 0 && board.has_session ? 2 : 0), "a pair gets what it deserves");
}

static void check_command(input_t *input, int64_t now_us)
{
    uint8_t command[64];
    const int length = input_range(input, 1, sizeof command);
    for (int i = 0; i < length; i++)
        command[i] = input_byte(input);
    (void)bus_auth_give_nonce(&board, now_us);
    fuzz_check(bus_auth_check_command(&board, 0x600, command, length, now_us) == 0, "no stranger commands");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    int64_t now_us = 1000000;
    bus_auth_init(&board, key, (uint8_t)input_range(&input, 0, VIEWERS - 1), 1);
    can_auth_fresh_t fresh = {SESSION, 1000000};
    while (input.left > 0) {
        const uint8_t turn = input_byte(&input);
        now_us += turn % 8 == 0 ? input_number(&input, MOST_WAIT_BITS) & INT64_MAX >> 29 : 100;
        if (turn % 8 == 1)
            check_tracker(&input, &fresh, now_us);
        else if (turn % 8 == 2)
            check_command(&input, now_us);
        else if (turn == 3)
            bus_auth_begin_session(&board, SESSION, fresh.time_us, now_us);
        else
            check_stranger(&input, now_us);
    }
    return 0;
}
