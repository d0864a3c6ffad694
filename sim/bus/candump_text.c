// SPDX-License-Identifier: Apache-2.0
// Writes and reads lines of can-utils' log format; nothing in a line is trusted.
#include "sim/bus/candump_text.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { US_PER_S = 1000000, TIME_DECIMALS = 6, MOST_TIME_DIGITS = 10, FLAG_BIT_RATE_SWITCH = 1, FLAGS_KNOWN = 7 };

static const uint32_t extended_ids = UINT32_C(1) << 29, standard_ids = UINT32_C(1) << 11;

size_t candump_text_from_frame(char text[CANDUMP_TEXT_LENGTH], const hal_can_frame_t *frame, const char *interface)
{
    int at = snprintf(text, CANDUMP_TEXT_LENGTH, "(%" PRId64 ".%06" PRId64 ") %.*s %0*" PRIX32 "#",
                      frame->time_us / US_PER_S, frame->time_us % US_PER_S, CANDUMP_INTERFACE_LENGTH - 1, interface,
                      frame->extended ? 8 : 3, frame->id);
    if (frame->fd)
        at += snprintf(text + at, CANDUMP_TEXT_LENGTH - (size_t)at, "#%d",
                       frame->bit_rate_switch ? FLAG_BIT_RATE_SWITCH : 0);
    for (int i = 0; i < frame->length; i++)
        at += snprintf(text + at, CANDUMP_TEXT_LENGTH - (size_t)at, "%02X", (unsigned)frame->data[i]);
    return (size_t)at;
}

/* @return The value of a hexadecimal digit, or -1. */
static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Decimal digits from *at on. @return Their count; 0 when there are none or more than MOST_TIME_DIGITS. */
static int take_digits(const char **at, int64_t *value)
{
    int count = 0;
    for (*value = 0; **at >= '0' && **at <= '9'; ++*at)
        if (++count <= MOST_TIME_DIGITS)
            *value = *value * 10 + (**at - '0');
    return count <= MOST_TIME_DIGITS ? count : 0;
}

static bool take(const char **at, char c)
{
    if (**at != c)
        return false;
    ++*at;
    return true;
}

static bool take_time(const char **at, int64_t *time_us)
{
    int64_t seconds = 0, micros = 0;
    if (!take(at, '(') || take_digits(at, &seconds) == 0 || !take(at, '.') ||
        take_digits(at, &micros) != TIME_DECIMALS || !take(at, ')') || !take(at, ' '))
        return false;
    *time_us = seconds * US_PER_S + micros;
    return true;
}

static bool take_interface(const char **at, char interface[CANDUMP_INTERFACE_LENGTH])
{
    const size_t length = strcspn(*at, " ");
    if (length == 0 || length >= CANDUMP_INTERFACE_LENGTH || (*at)[length] != ' ')
        return false;
    memcpy(interface, *at, length);
    interface[length] = '\0';
    *at += length + 1;
    return true;
}

static bool take_identifier(const char **at, hal_can_frame_t *frame)
{
    int digits = 0;
    uint32_t id = 0;
    for (; digits < 9 && hex_digit(**at) >= 0; digits++, ++*at)
        id = id << 4 | (uint32_t)hex_digit(**at);
    frame->extended = digits == 8;
    frame->id = id;
    return (digits == 3 && id < standard_ids) || (digits == 8 && id < extended_ids);
}

static bool is_length(const hal_can_frame_t *frame)
{
    static const uint8_t fd_lengths[] = {12, 16, 20, 24, 32, 48, 64};
    return frame->length <= 8 || (frame->fd && memchr(fd_lengths, frame->length, sizeof fd_lengths) != NULL);
}

/* @return NULL, or what was expected. */
static const char *take_data(const char **at, hal_can_frame_t *frame)
{
    if (**at == 'R')
        return "a data frame; this is a remote frame";
    if (take(at, '#')) {
        const int flags = hex_digit(**at);
        if (flags < 0 || flags > FLAGS_KNOWN)
            return "flags 0 to 7 after ##";
        frame->fd = true;
        frame->bit_rate_switch = (flags & FLAG_BIT_RATE_SWITCH) != 0;
        ++*at;
    }
    int length = 0;
    for (; hex_digit((*at)[0]) >= 0 && hex_digit((*at)[1]) >= 0 && length < HAL_CAN_MAX_LENGTH; *at += 2)
        frame->data[length++] = (uint8_t)(hex_digit((*at)[0]) << 4 | hex_digit((*at)[1]));
    frame->length = (uint8_t)length;
    return is_length(frame) ? NULL : "0 to 8 bytes, or with ## a length of CAN FD";
}

static bool is_end(const char *at)
{
    at += strspn(at, " \t\r\n");
    if (*at == 'R' || *at == 'T')
        at += 1 + strspn(at + 1, " \t\r\n");
    return *at == '\0';
}

const char *candump_frame_from_text(hal_can_frame_t *frame, char interface[CANDUMP_INTERFACE_LENGTH], const char *line)
{
    hal_can_frame_t read = {.length = 0};
    char name[CANDUMP_INTERFACE_LENGTH];
    const char *at = line;
    if (!take_time(&at, &read.time_us))
        return "a time such as (1700000000.123456)";
    if (!take_interface(&at, name))
        return "the name of an interface, up to 15 characters";
    if (!take_identifier(&at, &read) || !take(&at, '#'))
        return "an identifier of 3 or 8 hexadecimal digits, and #";
    const char *problem = take_data(&at, &read);
    if (problem != NULL)
        return problem;
    if (!is_end(at))
        return "pairs of hexadecimal digits up to the end of the line";
    *frame = read;
    memcpy(interface, name, sizeof name);
    return NULL;
}
