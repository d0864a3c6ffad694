// SPDX-License-Identifier: Apache-2.0
// The text in which the update agent tells its state.
#include <string.h>

#include "hal/linux/update_folder.h"

typedef struct {
    const char *text; /* not ended by a zero */
    size_t length;
} word_t;

static bool is(word_t word, const char *text)
{
    return word.length == strlen(text) && memcmp(word.text, text, word.length) == 0;
}

static bool read_doing(hal_update_doing_t *doing, word_t value)
{
    static const char *const names[HAL_UPDATE_DOINGS] = {"idle", "installing", "ready", "failed", "switching"};
    for (int i = 0; i < HAL_UPDATE_DOINGS; i++)
        if (is(value, names[i])) {
            *doing = (hal_update_doing_t)i;
            return true;
        }
    return false;
}

static bool read_percent(int32_t *percent, word_t value)
{
    int32_t number = 0;
    if (value.length < 1 || value.length > 3)
        return false;
    for (size_t i = 0; i < value.length; i++) {
        if (value.text[i] < '0' || value.text[i] > '9')
            return false;
        number = 10 * number + (value.text[i] - '0');
    }
    *percent = number;
    return number <= 100;
}

/* None, or a version. */
static bool read_version(char version[HAL_UPDATE_VERSION_LENGTH], word_t value)
{
    if (value.length >= HAL_UPDATE_VERSION_LENGTH)
        return false;
    memset(version, 0, HAL_UPDATE_VERSION_LENGTH);
    memcpy(version, value.text, value.length);
    return value.length == 0 || hal_update_is_version(version);
}

static void read_message(char message[HAL_UPDATE_MESSAGE_LENGTH], word_t value)
{
    size_t length = value.length;
    if (length >= HAL_UPDATE_MESSAGE_LENGTH)
        length = HAL_UPDATE_MESSAGE_LENGTH - 1;
    for (size_t i = 0; i < length; i++)
        message[i] = (char)(value.text[i] >= ' ' && value.text[i] <= '~' ? value.text[i] : '?');
    message[length] = '\0';
}

static bool read_line(hal_update_state_t *state, word_t key, word_t value)
{
    if (is(key, "state"))
        return read_doing(&state->doing, value);
    if (is(key, "progress"))
        return read_percent(&state->progress, value);
    if (is(key, "running"))
        return read_version(state->running, value);
    if (is(key, "waiting"))
        return read_version(state->waiting, value);
    if (is(key, "other"))
        return read_version(state->other, value);
    if (is(key, "slot")) {
        state->slot = value.length == 1 ? value.text[0] : '\0';
        return state->slot == 'A' || state->slot == 'B';
    }
    if (is(key, "trial")) {
        state->trial = is(value, "1");
        return state->trial || is(value, "0");
    }
    if (is(key, "message"))
        read_message(state->message, value);
    return true;
}

bool update_folder_read_state(hal_update_state_t *state, const char *text)
{
    hal_update_state_t read = {.doing = HAL_UPDATE_DOINGS, .slot = '?'};
    for (const char *line = text; *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        const char *equals = memchr(line, '=', length);
        if (equals != NULL) {
            const word_t key = {line, (size_t)(equals - line)}, value = {equals + 1, length - key.length - 1};
            if (!read_line(&read, key, value))
                return false;
        }
        line += length + (line[length] == '\n');
    }
    if (read.doing == HAL_UPDATE_DOINGS)
        return false;
    if (read.other[0] == '\0')
        memcpy(read.other, read.waiting, sizeof read.other);
    *state = read;
    return true;
}
