// SPDX-License-Identifier: Apache-2.0
// Requests to a board as words.
#include "sim/pose/request_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/program.h"

enum { US_PER_MS = 1000, FIRST_KIND = COMMAND_HELLO };

static const char *const names[] = {"hello",  "method", "freeze", "pattern", "latency",
                                    "reboot", "log",    "nonce",  "session", "update"};
static const char *const patterns[COMMAND_PATTERNS] = {"none", "grid", "white", "black"};
static const char *const switches[] = {"off", "on"};
static const char *const updates[COMMAND_UPDATES] = {"status", "install", "switch", "confirm", "cancel"};

enum { KINDS = sizeof names / sizeof names[0], OPERATORS_KINDS = COMMAND_LOG };

/* @return Its place in the list, or count. */
static int find(const char *word, const char *const list[], int count)
{
    int i = 0;
    while (i < count && strcmp(word, list[i]) != 0)
        i++;
    return i;
}

static bool expected(char error[REQUEST_TEXT_MESSAGE_LENGTH], const char *name, const char *value, const char *what)
{
    snprintf(error, REQUEST_TEXT_MESSAGE_LENGTH, "%.20s: found \"%.40s\", expected %.512s", name, value, what);
    return false;
}

static bool read_method(command_t *request, const char *value, char error[REQUEST_TEXT_MESSAGE_LENGTH])
{
    char known[PROGRAM_NAMES_LENGTH];
    request->method = warp_method_from_name(value);
    if (request->method != NULL || strcmp(value, "room") == 0)
        return true;
    program_method_names(known);
    snprintf(error, REQUEST_TEXT_MESSAGE_LENGTH, "method: found \"%.40s\", expected \"room\" or one of %s", value,
             known);
    return false;
}

static bool read_latency(command_t *request, const char *value, char error[REQUEST_TEXT_MESSAGE_LENGTH])
{
    char *end;
    const double ms = strtod(value, &end);
    const double most_ms = (double)COMMAND_MOST_LATENCY_US / US_PER_MS;
    if (end == value || *end != '\0' || !(ms >= 0 && ms <= most_ms))
        return expected(error, "latency", value, "milliseconds, 0 to 200");
    request->latency_us = (uint32_t)lround(ms * US_PER_MS);
    return true;
}

static bool read_value(command_t *request, const char *value, char error[REQUEST_TEXT_MESSAGE_LENGTH])
{
    int place;
    switch (request->kind) {
    case COMMAND_METHOD:
        return read_method(request, value, error);
    case COMMAND_FREEZE:
        place = find(value, switches, 2);
        request->freeze = place == 1;
        return place < 2 || expected(error, "freeze", value, "on or off");
    case COMMAND_PATTERN:
        place = find(value, patterns, COMMAND_PATTERNS);
        request->pattern = (command_pattern_t)place;
        return place < COMMAND_PATTERNS || expected(error, "pattern", value, "none, grid, white or black");
    case COMMAND_LATENCY:
        return read_latency(request, value, error);
    case COMMAND_HELLO:
    case COMMAND_REBOOT:
    case COMMAND_LOG:
    case COMMAND_NONCE:
    case COMMAND_SESSION:
    case COMMAND_UPDATE:
        break;
    }
    return true;
}

bool request_from_text(command_t *request, const char *name, const char *value, char error[REQUEST_TEXT_MESSAGE_LENGTH])
{
    const int place = find(name, names, OPERATORS_KINDS); /* the others are for programs */
    if (place == OPERATORS_KINDS) {
        snprintf(error, REQUEST_TEXT_MESSAGE_LENGTH,
                 "found \"%.40s\", expected hello, method, freeze, pattern, latency, reboot or log", name);
        return false;
    }
    command_t read = {.kind = (command_kind_t)(FIRST_KIND + place)};
    const bool alone = read.kind == COMMAND_HELLO || read.kind == COMMAND_REBOOT || read.kind == COMMAND_LOG;
    if (alone != (value == NULL)) {
        snprintf(error, REQUEST_TEXT_MESSAGE_LENGTH,
                 alone ? "%s takes no value, found \"%.40s\"" : "%s: a value is missing", name, value);
        return false;
    }
    if (!alone && !read_value(&read, value, error))
        return false;
    *request = read;
    return true;
}

const char *request_name(uint8_t kind)
{
    return kind >= FIRST_KIND && kind < FIRST_KIND + KINDS ? names[kind - FIRST_KIND] : "unknown";
}

static const char *method_name(uint8_t argument)
{
    for (int i = 0; i < WARP_METHODS; i++)
        if (command_argument(&(command_t){.kind = COMMAND_METHOD, .method = &warp_methods[i]}) == argument)
            return warp_methods[i].name;
    return argument == COMMAND_ROOM_METHOD ? "room" : "unknown";
}

void request_argument_text(char text[REQUEST_ARGUMENT_LENGTH], uint8_t kind, uint8_t argument)
{
    text[0] = '\0';
    if (kind == COMMAND_METHOD)
        snprintf(text, REQUEST_ARGUMENT_LENGTH, " %s", method_name(argument));
    else if (kind == COMMAND_FREEZE)
        snprintf(text, REQUEST_ARGUMENT_LENGTH, " %s", switches[argument != 0]);
    else if (kind == COMMAND_PATTERN)
        snprintf(text, REQUEST_ARGUMENT_LENGTH, " %s", argument < COMMAND_PATTERNS ? patterns[argument] : "unknown");
    else if (kind == COMMAND_LATENCY)
        snprintf(text, REQUEST_ARGUMENT_LENGTH, " %d ms", argument);
    else if (kind == COMMAND_UPDATE)
        snprintf(text, REQUEST_ARGUMENT_LENGTH, " %s", argument < COMMAND_UPDATES ? updates[argument] : "unknown");
}

const char *request_result_name(uint8_t result)
{
    static const char *const results[] = {"done", "unknown", "bad value", "refused", "impossible"};
    return result < sizeof results / sizeof results[0] ? results[result] : "failed";
}

const char *request_refusal(command_kind_t kind, uint8_t result)
{
    switch (result) {
    case COMMAND_UNKNOWN:
        return "does not know this command; is its firmware older than this program?";
    case COMMAND_BAD_VALUE:
        return "does not take this value; is its firmware older than this program?";
    case COMMAND_REFUSED:
        return "refuses: it has a key, and takes commands only with the same one (--key FILE)";
    case COMMAND_IMPOSSIBLE:
        return kind == COMMAND_METHOD ? "is not ready for this method; put it into the room file and start it anew"
                                      : "cannot do it now";
    default:
        return "gives a reason that this program does not know; is its firmware newer?";
    }
}
