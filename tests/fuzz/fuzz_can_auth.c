// SPDX-License-Identifier: Apache-2.0
// Fuzzes authentication: no frame from the input is ever accepted, and what was signed is, unless it was changed.
#include "firmware/can_auth.h"

#include <stdlib.h>

#include "tests/fuzz/input.h"
#include "tests/fuzz/input_frame.h"

static can_auth_t *auth;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    static const hal_key_t key = {{1, 2, 3}};
    (void)argc;
    (void)argv;
    auth = can_auth_open(&key);
    if (auth == NULL)
        abort();
    return 0;
}

/* Frames as they come: nobody had the key. */
static void check_strangers(input_t *input, can_auth_stream_t *stream, const can_auth_window_t *window)
{
    hal_can_frame_t frame[CAN_AUTH_MAX_FRAMES + 1], tag;
    for (int f = 0; f <= CAN_AUTH_MAX_FRAMES; f++)
        frame[f] = input_frame(input);
    tag = input_frame(input);
    const can_auth_message_t message = {frame, input_range(input, 0, CAN_AUTH_MAX_FRAMES + 1), tag.id};
    fuzz_check(can_auth_check(auth, stream, window, &message, &tag) != CAN_AUTH_OK, "no stranger is let in");
    fuzz_check(can_auth_check_fd(auth, stream, window, &frame[0]) != CAN_AUTH_OK, "no stranger is let in by FD");
}

/* A signed frame, with a byte changed unless the change is 0. */
static void check_fd(input_t *input, can_auth_stream_t *stream, const can_auth_window_t *window)
{
    hal_can_frame_t frame = input_frame(input);
    frame.fd = true;
    frame.extended = false;
    frame.length = CAN_AUTH_FD_PLAIN;
    const can_auth_fresh_t fresh = {stream->session, window->now_us};
    fuzz_check(can_auth_sign_fd(auth, fresh, &frame), "an FD frame can be signed");
    const uint8_t change = input_byte(input);
    frame.data[input_byte(input) % CAN_AUTH_FD_SIGNED] ^= change;
    const bool is_new = window->now_us > stream->newest_us;
    const can_auth_result_t expected = change != 0 ? CAN_AUTH_FORGED : is_new ? CAN_AUTH_OK : CAN_AUTH_REPLAYED;
    fuzz_check(can_auth_check_fd(auth, stream, window, &frame) == expected, "an FD frame gets what it deserves");
    fuzz_check(frame.length == (expected == CAN_AUTH_OK ? CAN_AUTH_FD_PLAIN : CAN_AUTH_FD_SIGNED),
               "only good ones become plain");
}

/* A signed message, likewise. */
static void check_classic(input_t *input, can_auth_stream_t *stream, const can_auth_window_t *window)
{
    hal_can_frame_t frame[CAN_AUTH_MAX_FRAMES + 1];
    const int frames = input_range(input, 1, CAN_AUTH_MAX_FRAMES);
    for (int f = 0; f < frames; f++) {
        frame[f] = input_frame(input);
        frame[f].fd = frame[f].extended = false;
        frame[f].length = 8;
    }
    const can_auth_message_t message = {frame, frames, CAN_AUTH_ID_TIME};
    const can_auth_fresh_t fresh = {stream->session, window->now_us};
    fuzz_check(can_auth_sign(auth, fresh, &message, &frame[frames]), "a message can be signed");
    const uint8_t change = input_byte(input);
    const int place = input_byte(input) % (8 * (frames + 1));
    frame[place / 8].data[place % 8] ^= change;
    const bool is_new = window->now_us > stream->newest_us;
    const can_auth_result_t expected = change != 0 ? CAN_AUTH_FORGED : is_new ? CAN_AUTH_OK : CAN_AUTH_REPLAYED;
    fuzz_check(can_auth_check(auth, stream, window, &message, &frame[frames]) == expected,
               "a message gets what it deserves");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    can_auth_stream_t stream = {.session = input_bits(&input, 8), .newest_us = input_bits(&input, 6)};
    while (input.left > 0) {
        const can_auth_window_t window = {
            .now_us = input_bits(&input, 6), .past_us = input_bits(&input, 3), .future_us = input_bits(&input, 3)};
        check_strangers(&input, &stream, &window);
        check_fd(&input, &stream, &window);
        check_classic(&input, &stream, &window);
    }
    uint8_t code[CAN_AUTH_COMMAND_BYTES] = {0};
    const can_auth_command_t command = {1, data, size > CAN_AUTH_MAX_COMMAND ? CAN_AUTH_MAX_COMMAND : (int)size, 5};
    fuzz_check(!can_auth_check_command(auth, &command, code), "no code of zeros is right");
    fuzz_check(can_auth_sign_command(auth, &command, code) && can_auth_check_command(auth, &command, code),
               "a signed command is right");
    return 0;
}
