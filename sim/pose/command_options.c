// SPDX-License-Identifier: Apache-2.0
// Values of options that several commands of wallwarp-pose have.
#include "sim/pose/command_options.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/pose/commands.h"
#include "sim/pose/pose_link.h"

const char *command_bus(struct argp_state *state, const char *text)
{
    char error[POSE_LINK_MESSAGE_LENGTH];
    if (!pose_link_check(text, error))
        argp_error(state, "--bus: %s", error);
    return text;
}

void command_check_fd(struct argp_state *state, const char *bus, bool fd)
{
    if (bus == NULL)
        argp_error(state, "--bus is missing");
    if (fd && strchr(bus, ':') != NULL)
        argp_error(state, "--fd: a simulator's port carries classic frames only");
}

double command_number(struct argp_state *state, const char *option, const char *text, double least, double most)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= least && value <= most))
        argp_error(state, "%s: found \"%s\", expected a number from %g to %g", option, text, least, most);
    return value;
}

int64_t command_seconds_us(struct argp_state *state, const char *option, const char *text)
{
    return llround(command_number(state, option, text, 0.001, 1e6) * 1e6);
}

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

const volatile sig_atomic_t *command_catch_stop(void)
{
    signal(SIGINT, request_stop);
    signal(SIGTERM, request_stop);
    return &stop_requested;
}

void command_check_key(struct argp_state *state, const char *key, bool no_sync)
{
    if (key != NULL && no_sync)
        argp_error(state, "--no-sync: boards with a key believe times of the sender's own clock, which it must give");
}

bool command_open_key(const char *program, const char *key, const char *bus, pose_auth_t **auth)
{
    char error[HAL_KEY_ERROR_LENGTH];
    *auth = NULL;
    if (key == NULL)
        return true;
    *auth = pose_auth_open(key, bus, error);
    if (*auth == NULL)
        fprintf(stderr, "%s: --key: %s\n", program, error);
    return *auth != NULL;
}
