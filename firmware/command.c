// SPDX-License-Identifier: Apache-2.0
// Requests of an operator, as bytes.
#include "firmware/command.h"

#include <string.h>

#include "firmware/byte_order.h"

static const char reboot_text[] = "reboot";
enum {
    REBOOT_LENGTH = sizeof reboot_text - 1,
    NUMBER_LENGTH = 4,
    TIME_LENGTH = 8,
    SESSION_LENGTH = 16,
    TIME_BITS = 48
};

_Static_assert((int)HAL_UPDATE_SOURCE_LENGTH + TIME_LENGTH + 2 <= (int)COMMAND_MAX_BYTES, "a source and a code fit");

static int put_text(uint8_t *bytes, const char *text)
{
    const size_t length = strlen(text);
    memcpy(bytes, text, length);
    return (int)length;
}

static int put_number(uint8_t *bytes, uint32_t number)
{
    put_u32(bytes, number);
    return NUMBER_LENGTH;
}

static int put_update(uint8_t *values, const command_t *command)
{
    values[0] = (uint8_t)command->update;
    if (command->update == COMMAND_UPDATE_INSTALL)
        return 1 + put_text(values + 1, command->text);
    if (command->update != COMMAND_UPDATE_SWITCH && command->update != COMMAND_UPDATE_CONFIRM)
        return 1;
    put_u64(values + 1, command->bus_time_us);
    return 1 + TIME_LENGTH +
           (command->update == COMMAND_UPDATE_SWITCH ? put_text(values + 1 + TIME_LENGTH, command->text) : 0);
}

int command_encode(uint8_t bytes[COMMAND_MAX_BYTES], const command_t *command)
{
    uint8_t *values = bytes + 1;
    bytes[0] = (uint8_t)command->kind;
    switch (command->kind) {
    case COMMAND_METHOD:
        return 1 + put_text(values, command->method == NULL ? "" : command->method->name);
    case COMMAND_FREEZE:
        values[0] = command->freeze;
        return 2;
    case COMMAND_PATTERN:
        values[0] = (uint8_t)command->pattern;
        return 2;
    case COMMAND_LATENCY:
        return 1 + put_number(values, command->latency_us);
    case COMMAND_REBOOT:
        return 1 + put_text(values, reboot_text);
    case COMMAND_LOG:
        return 1 + put_number(values, command->first_event);
    case COMMAND_SESSION:
        put_u64(values, command->session);
        put_u64(values + 8, command->bus_time_us);
        return 1 + SESSION_LENGTH;
    case COMMAND_UPDATE:
        return 1 + put_update(values, command);
    case COMMAND_HELLO:
    case COMMAND_NONCE:
        break;
    }
    return 1;
}

static command_result_t read_method(const warp_method_t **method, const uint8_t *bytes, int length)
{
    char name[COMMAND_MAX_BYTES] = "";
    memcpy(name, bytes, (size_t)length);
    *method = warp_method_from_name(name);
    const bool whole = strlen(name) == (size_t)length; /* no zero in it */
    return whole && (*method != NULL || length == 0) ? COMMAND_OK : COMMAND_BAD_VALUE;
}

static command_result_t read_small(uint8_t *value, const uint8_t *bytes, int length, int limit)
{
    if (length != 1 || bytes[0] >= limit)
        return COMMAND_BAD_VALUE;
    *value = bytes[0];
    return COMMAND_OK;
}

static command_result_t read_number(uint32_t *value, const uint8_t *bytes, int length, uint32_t most)
{
    if (length != NUMBER_LENGTH || get_u32(bytes) > most)
        return COMMAND_BAD_VALUE;
    *value = get_u32(bytes);
    return COMMAND_OK;
}

static command_result_t read_time(uint64_t *bus_time_us, const uint8_t *bytes, int length)
{
    if (length != TIME_LENGTH || get_u64(bytes) >> TIME_BITS != 0)
        return COMMAND_BAD_VALUE;
    *bus_time_us = get_u64(bytes);
    return COMMAND_OK;
}

static command_result_t read_session(command_t *command, const uint8_t *bytes, int length)
{
    if (length != SESSION_LENGTH)
        return COMMAND_BAD_VALUE;
    command->session = get_u64(bytes);
    return read_time(&command->bus_time_us, bytes + 8, TIME_LENGTH);
}

static command_result_t read_word(char *text, const uint8_t *bytes, int length, bool (*is_one)(const char *text))
{
    if (length < 0 || length >= HAL_UPDATE_SOURCE_LENGTH)
        return COMMAND_BAD_VALUE;
    memcpy(text, bytes, (size_t)length);
    text[length] = '\0';
    return strlen(text) == (size_t)length && is_one(text) ? COMMAND_OK : COMMAND_BAD_VALUE;
}

static command_result_t read_update(command_t *command, const uint8_t *bytes, int length)
{
    const uint8_t *values = bytes + 1;
    if (length < 1)
        return COMMAND_BAD_VALUE;
    command->update = (command_update_t)bytes[0];
    switch (command->update) {
    case COMMAND_UPDATE_STATUS:
    case COMMAND_UPDATE_CANCEL:
        return length == 1 ? COMMAND_OK : COMMAND_BAD_VALUE;
    case COMMAND_UPDATE_INSTALL:
        return read_word(command->text, values, length - 1, hal_update_is_source);
    case COMMAND_UPDATE_CONFIRM:
        return read_time(&command->bus_time_us, values, length - 1);
    case COMMAND_UPDATE_SWITCH:
        if (length <= 1 + TIME_LENGTH || read_word(command->text, values + TIME_LENGTH, length - 1 - TIME_LENGTH,
                                                   hal_update_is_version) != COMMAND_OK)
            return COMMAND_BAD_VALUE;
        return read_time(&command->bus_time_us, values, TIME_LENGTH);
    case COMMAND_UPDATES:
        break;
    }
    return COMMAND_BAD_VALUE;
}

static command_result_t read_values(command_t *command, const uint8_t *values, int length)
{
    uint8_t small = 0;
    command_result_t result = COMMAND_UNKNOWN;
    switch (command->kind) {
    case COMMAND_SESSION:
        return read_session(command, values, length);
    case COMMAND_UPDATE:
        return read_update(command, values, length);
    case COMMAND_HELLO:
    case COMMAND_NONCE:
        return length == 0 ? COMMAND_OK : COMMAND_BAD_VALUE;
    case COMMAND_METHOD:
        return read_method(&command->method, values, length);
    case COMMAND_FREEZE:
        result = read_small(&small, values, length, 2);
        command->freeze = small == 1;
        return result;
    case COMMAND_PATTERN:
        result = read_small(&small, values, length, COMMAND_PATTERNS);
        command->pattern = (command_pattern_t)small;
        return result;
    case COMMAND_LATENCY:
        return read_number(&command->latency_us, values, length, COMMAND_MOST_LATENCY_US);
    case COMMAND_REBOOT:
        return length == REBOOT_LENGTH && memcmp(values, reboot_text, REBOOT_LENGTH) == 0 ? COMMAND_OK
                                                                                          : COMMAND_BAD_VALUE;
    case COMMAND_LOG:
        return read_number(&command->first_event, values, length, UINT32_MAX);
    }
    return result;
}

command_result_t command_decode(command_t *command, const uint8_t *bytes, int length)
{
    if (length < 1 || length > COMMAND_MAX_BYTES)
        return COMMAND_BAD_VALUE;
    command_t read = {.kind = (command_kind_t)bytes[0]};
    const command_result_t result = read_values(&read, bytes + 1, length - 1);
    if (result == COMMAND_OK)
        *command = read;
    return result;
}

uint8_t command_argument(const command_t *command)
{
    const warp_method_t *method = command->method;
    switch (command->kind) {
    case COMMAND_METHOD:
        return (uint8_t)(method == NULL ? COMMAND_ROOM_METHOD : 16 * (int)method->filter + (int)method->resampler);
    case COMMAND_FREEZE:
        return command->freeze;
    case COMMAND_PATTERN:
        return (uint8_t)command->pattern;
    case COMMAND_LATENCY:
        return (uint8_t)(command->latency_us / 1000);
    case COMMAND_UPDATE:
        return (uint8_t)command->update;
    case COMMAND_HELLO:
    case COMMAND_REBOOT:
    case COMMAND_LOG:
    case COMMAND_NONCE:
    case COMMAND_SESSION:
        break;
    }
    return 0;
}
