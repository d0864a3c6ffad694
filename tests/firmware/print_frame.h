// SPDX-License-Identifier: Apache-2.0
// Prints an encoded frame beside the values that went into it, for dbc_decodes_traffic.py to compare.
//
// Lines: "frame MESSAGE ID FD CYCLE_MS HEX", then "signal NAME VALUE" for what that frame must say, and "named NAME
// TEXT" for what the DBC file calls that value. The values are in the DBC file's units, written down by hand.
#ifndef TESTS_FIRMWARE_PRINT_FRAME_H
#define TESTS_FIRMWARE_PRINT_FRAME_H

#include <stdio.h>
#include <stdlib.h>

#include "tests/support/auth_frames.h"

static inline void print_frame(const char *message, const hal_can_frame_t *frame, int cycle_ms)
{
    printf("frame %s %u %d %d ", message, (unsigned)frame->id, frame->fd ? 1 : 0, cycle_ms);
    for (int i = 0; i < frame->length; i++)
        printf("%02x", frame->data[i]);
    printf("\n");
}

static inline void check(bool encoded)
{
    if (!encoded) {
        fprintf(stderr, "print_frame: a frame was not encoded\n");
        exit(1);
    }
}

static can_auth_t *key;

/* The frame behind a message, with the key of auth_frames.h. Codes are from `openssl mac -cipher AES-128-CBC -macopt
 * hexkey:000102030405060708090A0B0C0D0E0F CMAC`. */
static inline void print_code(const char *message, const can_auth_message_t *frames, int cycle_ms, const char *mac)
{
    hal_can_frame_t tag;
    check(can_auth_sign(key, AUTH_FRESH, frames, &tag));
    print_frame(message, &tag, cycle_ms);
    printf("signal %sTime 13952502\nsignal %sMac %s\n", message, message, mac); /* 0xD4E5F6 */
}

#endif
