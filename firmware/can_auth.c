// SPDX-License-Identifier: Apache-2.0
// Authentication of messages: the bytes that a code is over, where it travels, and what is too old. Mbed TLS does
// AES-CMAC.
#include "firmware/can_auth.h"

#include <mbedtls/cipher.h>
#include <mbedtls/cmac.h>
#include <mbedtls/constant_time.h>
#include <stdlib.h>
#include <string.h>

enum {
    TIME_BITS = 48,
    ID_BYTES = 2,
    FRESH_BYTES = 16,
    CLASSIC_BYTES = 8,
    TAG_TIME_BYTES = 3, /* of the freshness in a classic message's last frame */
    TAG_MAC_BYTES = 5,
    FD_TIME_BYTES = 6,
    FD_MAC_BYTES = 10,
    MAX_STRING = ID_BYTES + CAN_AUTH_MAX_COMMAND + FRESH_BYTES
};

_Static_assert(TAG_TIME_BYTES + TAG_MAC_BYTES == CLASSIC_BYTES, "the frame is full");
_Static_assert(CAN_AUTH_FD_PLAIN + FD_TIME_BYTES + FD_MAC_BYTES == CAN_AUTH_FD_SIGNED, "the frame is full");
_Static_assert(CAN_AUTH_MAX_FRAMES *CLASSIC_BYTES <= CAN_AUTH_MAX_COMMAND, "there is room for all frames");

struct can_auth {
    mbedtls_cipher_context_t cipher;
};

can_auth_t *can_auth_open(const hal_key_t *key)
{
    can_auth_t *auth = malloc(sizeof *auth);
    if (auth == NULL)
        return NULL;
    mbedtls_cipher_init(&auth->cipher);
    if (mbedtls_cipher_setup(&auth->cipher, mbedtls_cipher_info_from_type(MBEDTLS_CIPHER_AES_128_ECB)) == 0 &&
        mbedtls_cipher_cmac_starts(&auth->cipher, key->bytes, 8 * HAL_KEY_BYTES) == 0)
        return auth;
    can_auth_close(auth);
    return NULL;
}

void can_auth_close(can_auth_t *auth)
{
    if (auth != NULL)
        mbedtls_cipher_free(&auth->cipher); /* wipes the key */
    free(auth);
}

bool can_auth_mac(can_auth_t *auth, const uint8_t *data, int length, uint8_t mac[CAN_AUTH_MAC_BYTES])
{
    return mbedtls_cipher_cmac_reset(&auth->cipher) == 0 &&
           mbedtls_cipher_cmac_update(&auth->cipher, data, (size_t)length) == 0 &&
           mbedtls_cipher_cmac_finish(&auth->cipher, mac) == 0;
}

/* Lowest byte first. */
static void put_number(uint8_t *to, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (uint8_t)(number >> (8 * i) & 0xFF);
}

static uint64_t get_number(const uint8_t *from, int bytes)
{
    uint64_t number = 0;
    for (int i = 0; i < bytes; i++)
        number |= (uint64_t)from[i] << (8 * i);
    return number;
}

/* The code over identifier, data and freshness. */
static bool make_code(can_auth_t *auth, const can_auth_command_t *data, uint64_t time_us,
                      uint8_t mac[CAN_AUTH_MAC_BYTES])
{
    uint8_t string[MAX_STRING];
    put_number(string, data->id, ID_BYTES);
    if (data->length > 0)
        memcpy(string + ID_BYTES, data->data, (size_t)data->length);
    put_number(string + ID_BYTES + data->length, data->nonce, FRESH_BYTES / 2);
    put_number(string + ID_BYTES + data->length + FRESH_BYTES / 2, time_us, FRESH_BYTES / 2);
    return can_auth_mac(auth, string, ID_BYTES + data->length + FRESH_BYTES, mac);
}

/* The same over frames. @return false also when they are no message. */
static bool make_frames_code(can_auth_t *auth, const can_auth_message_t *message, can_auth_fresh_t fresh,
                             uint8_t mac[CAN_AUTH_MAC_BYTES])
{
    uint8_t data[CAN_AUTH_MAX_FRAMES * CLASSIC_BYTES];
    if (message->frames < 1 || message->frames > CAN_AUTH_MAX_FRAMES)
        return false;
    for (int f = 0; f < message->frames; f++) {
        const hal_can_frame_t *frame = &message->frame[f];
        if (frame->extended || frame->fd || frame->length != CLASSIC_BYTES)
            return false;
        memcpy(data + (ptrdiff_t)f * CLASSIC_BYTES, frame->data, CLASSIC_BYTES);
    }
    const can_auth_command_t whole = {message->frame[0].id, data, message->frames * CLASSIC_BYTES, fresh.session};
    return make_code(auth, &whole, fresh.time_us, mac);
}

static bool make_fd_code(can_auth_t *auth, const hal_can_frame_t *frame, can_auth_fresh_t fresh,
                         uint8_t mac[CAN_AUTH_MAC_BYTES])
{
    const can_auth_command_t whole = {frame->id, frame->data, CAN_AUTH_FD_PLAIN, fresh.session};
    return make_code(auth, &whole, fresh.time_us, mac);
}

void can_auth_fresh_step(can_auth_fresh_t *fresh, uint64_t bus_time_us)
{
    fresh->time_us = bus_time_us > fresh->time_us ? bus_time_us : fresh->time_us + 1;
}

bool can_auth_sign_fd(can_auth_t *auth, can_auth_fresh_t fresh, hal_can_frame_t *frame)
{
    uint8_t mac[CAN_AUTH_MAC_BYTES];
    if (!frame->fd || frame->extended || frame->length != CAN_AUTH_FD_PLAIN || fresh.time_us >> TIME_BITS != 0 ||
        !make_fd_code(auth, frame, fresh, mac))
        return false;
    put_number(frame->data + CAN_AUTH_FD_PLAIN, fresh.time_us, FD_TIME_BYTES);
    memcpy(frame->data + CAN_AUTH_FD_PLAIN + FD_TIME_BYTES, mac, FD_MAC_BYTES);
    frame->length = CAN_AUTH_FD_SIGNED;
    return true;
}

bool can_auth_sign(can_auth_t *auth, can_auth_fresh_t fresh, const can_auth_message_t *message, hal_can_frame_t *tag)
{
    uint8_t mac[CAN_AUTH_MAC_BYTES];
    if (fresh.time_us >> TIME_BITS != 0 || !make_frames_code(auth, message, fresh, mac))
        return false;
    *tag = (hal_can_frame_t){.id = message->tag_id, .length = CLASSIC_BYTES};
    put_number(tag->data, fresh.time_us, TAG_TIME_BYTES);
    memcpy(tag->data + TAG_TIME_BYTES, mac, TAG_MAC_BYTES);
    return true;
}

/* Of a message whose code is right. */
static can_auth_result_t judge_time(can_auth_stream_t *stream, const can_auth_window_t *window, uint64_t time_us)
{
    if (time_us <= stream->newest_us)
        return CAN_AUTH_REPLAYED;
    if (time_us + window->past_us < window->now_us)
        return CAN_AUTH_STALE;
    if (time_us > window->now_us + window->future_us)
        return CAN_AUTH_EARLY;
    stream->newest_us = time_us;
    return CAN_AUTH_OK;
}

static can_auth_result_t counted(can_auth_stream_t *stream, can_auth_result_t result)
{
    stream->results[result]++;
    return result;
}

can_auth_result_t can_auth_check_fd(can_auth_t *auth, can_auth_stream_t *stream, const can_auth_window_t *window,
                                    hal_can_frame_t *frame)
{
    if (!frame->fd || frame->extended || frame->length != CAN_AUTH_FD_SIGNED)
        return counted(stream, CAN_AUTH_OTHER);
    const can_auth_fresh_t fresh = {stream->session, get_number(frame->data + CAN_AUTH_FD_PLAIN, FD_TIME_BYTES)};
    uint8_t mac[CAN_AUTH_MAC_BYTES];
    if (!make_fd_code(auth, frame, fresh, mac) ||
        mbedtls_ct_memcmp(mac, frame->data + CAN_AUTH_FD_PLAIN + FD_TIME_BYTES, FD_MAC_BYTES) != 0)
        return counted(stream, CAN_AUTH_FORGED);
    const can_auth_result_t result = judge_time(stream, window, fresh.time_us);
    if (result == CAN_AUTH_OK)
        frame->length = CAN_AUTH_FD_PLAIN;
    return counted(stream, result);
}

/* The time nearest to now_us with these lowest bytes; where that would be negative, the next one. */
static uint64_t extended(uint64_t low, uint64_t now_us)
{
    const uint64_t turn = UINT64_C(1) << (8 * TAG_TIME_BYTES), time_us = now_us - now_us % turn + low;
    if (time_us > now_us + turn / 2 && time_us >= turn)
        return time_us - turn;
    return time_us + turn / 2 < now_us ? time_us + turn : time_us;
}

can_auth_result_t can_auth_check(can_auth_t *auth, can_auth_stream_t *stream, const can_auth_window_t *window,
                                 const can_auth_message_t *message, const hal_can_frame_t *tag)
{
    if (tag->fd || tag->extended || tag->id != message->tag_id || tag->length != CLASSIC_BYTES)
        return counted(stream, CAN_AUTH_OTHER);
    const can_auth_fresh_t fresh = {stream->session, extended(get_number(tag->data, TAG_TIME_BYTES), window->now_us)};
    uint8_t mac[CAN_AUTH_MAC_BYTES];
    if (!make_frames_code(auth, message, fresh, mac) ||
        mbedtls_ct_memcmp(mac, tag->data + TAG_TIME_BYTES, TAG_MAC_BYTES) != 0)
        return counted(stream, CAN_AUTH_FORGED);
    return counted(stream, judge_time(stream, window, fresh.time_us));
}

bool can_auth_sign_command(can_auth_t *auth, const can_auth_command_t *command, uint8_t code[CAN_AUTH_COMMAND_BYTES])
{
    uint8_t mac[CAN_AUTH_MAC_BYTES];
    if (command->length < 0 || command->length > CAN_AUTH_MAX_COMMAND || !make_code(auth, command, 0, mac))
        return false;
    memcpy(code, mac, CAN_AUTH_COMMAND_BYTES);
    return true;
}

bool can_auth_check_command(can_auth_t *auth, const can_auth_command_t *command,
                            const uint8_t code[CAN_AUTH_COMMAND_BYTES])
{
    uint8_t right[CAN_AUTH_COMMAND_BYTES];
    return can_auth_sign_command(auth, command, right) && mbedtls_ct_memcmp(right, code, sizeof right) == 0;
}

bool can_auth_random(can_auth_t *auth, uint64_t seed, uint64_t count, uint64_t *number)
{
    const can_auth_command_t nothing = {CAN_AUTH_RANDOM_ID, NULL, 0, seed};
    uint8_t mac[CAN_AUTH_MAC_BYTES];
    if (!make_code(auth, &nothing, count, mac))
        return false;
    *number = get_number(mac, (int)sizeof *number);
    return true;
}
