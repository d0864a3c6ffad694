// SPDX-License-Identifier: Apache-2.0
// Parses socketcand commands word by word; nothing in a command is trusted.
#include "sim/bus/socketcand_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_WORDS = 12 }; /* send, identifier, length and 8 bytes, and one to see that there are too many */

static const double most_seconds = 1e10;

typedef struct {
    const char *text;
    size_t length;
} word_t;

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static int split(word_t words[MAX_WORDS], const char *text, size_t length)
{
    int count = 0;
    size_t at = 0;
    while (count < MAX_WORDS) {
        while (at < length && is_space(text[at]))
            at++;
        if (at == length)
            break;
        const size_t begin = at;
        while (at < length && !is_space(text[at]))
            at++;
        words[count++] = (word_t){text + begin, at - begin};
    }
    return count;
}

static bool word_is(word_t word, const char *name)
{
    return word.length == strlen(name) && memcmp(word.text, name, word.length) == 0;
}

static bool hex_from_word(uint32_t *value, word_t word, size_t max_digits)
{
    uint32_t sum = 0;
    if (word.length > max_digits)
        return false;
    for (size_t i = 0; i < word.length; i++) {
        const char c = word.text[i];
        uint32_t digit = 0;
        if (c >= '0' && c <= '9')
            digit = (uint32_t)(c - '0');
        else if (c >= 'a' && c <= 'f')
            digit = (uint32_t)(c - 'a') + 10U;
        else if (c >= 'A' && c <= 'F')
            digit = (uint32_t)(c - 'A') + 10U;
        else
            return false;
        sum = sum << 4 | digit;
    }
    *value = sum;
    return true;
}

/* @return NULL when the words make a frame, else what was expected. */
static const char *frame_from_words(hal_can_frame_t *frame, const word_t *words, int count)
{
    uint32_t id = 0, length = 0;
    if (count < 3)
        return "send needs an identifier and a length";
    if (!hex_from_word(&id, words[1], 8) || id > 0x1FFFFFFFU)
        return "identifier is not hexadecimal, 0 to 1FFFFFFF";
    if (!hex_from_word(&length, words[2], 1) || length > 8)
        return "length is not 0 to 8";
    if (count != 3 + (int)length)
        return "number of bytes is not the length";
    *frame = (hal_can_frame_t){.id = id, .extended = words[1].length == 8 || id > 0x7FFU, .length = (uint8_t)length};
    for (uint32_t i = 0; i < length; i++) {
        uint32_t byte = 0;
        if (!hex_from_word(&byte, words[3 + i], 2))
            return "byte is not one or two hexadecimal digits";
        frame->data[i] = (uint8_t)byte;
    }
    return NULL;
}

socketcand_command_t socketcand_command_from_text(const char *text, size_t length)
{
    word_t words[MAX_WORDS];
    socketcand_command_t command = {.verb = SOCKETCAND_WRONG, .problem = "unknown command"};
    if (length < 2)
        return command;
    const int count = split(words, text + 1, length - 2);
    if (count == 0)
        return command;
    if (word_is(words[0], "send")) {
        command.problem = frame_from_words(&command.frame, words, count);
        command.verb = command.problem == NULL ? SOCKETCAND_SEND : SOCKETCAND_WRONG;
    } else if (word_is(words[0], "open")) {
        command.problem = "open needs the name of one channel";
        if (count == 2 && words[1].length < sizeof command.channel) {
            memcpy(command.channel, words[1].text, words[1].length);
            command.verb = SOCKETCAND_OPEN;
        }
    } else if (word_is(words[0], "rawmode") && count == 1) {
        command.verb = SOCKETCAND_RAWMODE;
    } else if (word_is(words[0], "echo") && count == 1) {
        command.verb = SOCKETCAND_ECHO;
    }
    return command;
}

size_t socketcand_text_from_frame(char text[SOCKETCAND_FRAME_LENGTH], const hal_can_frame_t *frame)
{
    int at = snprintf(text, SOCKETCAND_FRAME_LENGTH, "< frame %0*" PRIX32 " %" PRId64 ".%06" PRId64 " ",
                      frame->extended ? 8 : 3, frame->id, frame->time_us / 1000000, frame->time_us % 1000000);
    for (int i = 0; i < frame->length && i < 8; i++)
        at += snprintf(text + at, SOCKETCAND_FRAME_LENGTH - (size_t)at, "%02X", (unsigned)frame->data[i]);
    at += snprintf(text + at, SOCKETCAND_FRAME_LENGTH - (size_t)at, " >");
    return (size_t)at;
}

/* "23.424242", or with fewer decimals as some servers write it. */
static bool time_from_word(int64_t *time_us, word_t word)
{
    char text[32];
    char *end;
    if (word.length >= sizeof text || word.length == 0 || strspn(word.text, "0123456789.") < word.length)
        return false;
    memcpy(text, word.text, word.length);
    text[word.length] = '\0';
    const double seconds = strtod(text, &end);
    if (*end != '\0' || seconds > most_seconds)
        return false;
    *time_us = (int64_t)(seconds * 1e6 + 0.5);
    return true;
}

bool socketcand_frame_from_text(hal_can_frame_t *frame, const char *text, size_t length)
{
    word_t words[MAX_WORDS];
    if (length < 2)
        return false;
    const int count = split(words, text + 1, length - 2);
    hal_can_frame_t read = {.length = 0};
    if ((count != 3 && count != 4) || !word_is(words[0], "frame") || !hex_from_word(&read.id, words[1], 8) ||
        read.id > 0x1FFFFFFFU || !time_from_word(&read.time_us, words[2]))
        return false;
    read.extended = words[1].length == 8 || read.id > 0x7FFU;
    const word_t data = count == 4 ? words[3] : (word_t){"", 0};
    if (data.length > 16 || data.length % 2 != 0)
        return false;
    read.length = (uint8_t)(data.length / 2);
    for (size_t i = 0; i < data.length / 2; i++) {
        uint32_t byte = 0;
        if (!hex_from_word(&byte, (word_t){data.text + 2 * i, 2}, 2))
            return false;
        read.data[i] = (uint8_t)byte;
    }
    *frame = read;
    return true;
}
