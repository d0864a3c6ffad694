// SPDX-License-Identifier: Apache-2.0
// Values of options that several commands of wallwarp-pose have; a bad one ends the program with status 2.
#ifndef SIM_POSE_COMMAND_OPTIONS_H
#define SIM_POSE_COMMAND_OPTIONS_H

#include <argp.h>
#include <stdbool.h>
#include <stdint.h>

#include "sim/pose/pose_auth.h"

static const char command_bus_help[] =
    "A SocketCAN interface such as can0, or HOST:PORT of a simulator (wallwarp-sim run --bus PORT)";

/** @return The text, when it can name a bus. */
const char *command_bus(struct argp_state *state, const char *text);

/** Check that a bus is given, and that it carries FD where that is wanted. */
void command_check_fd(struct argp_state *state, const char *bus, bool fd);

/** @return A decimal number from least to most. @param option  For the message: "--speed". */
double command_number(struct argp_state *state, const char *option, const char *text, double least, double most);

/** @return Seconds as us: 0.001 to 10^6 s. */
int64_t command_seconds_us(struct argp_state *state, const char *option, const char *text);

/** Check that who signs also gives bus time. @param key  Of the option --key, or NULL. */
void command_check_key(struct argp_state *state, const char *key, bool no_sync);

/**
 * Open what a sender with a key needs.
 *
 * @param      key   File, or NULL: nothing is done.
 * @param[out] auth  For pose_auth_close(); NULL without a key.
 * @return false when that failed, and is said.
 */
bool command_open_key(const char *program, const char *key, const char *bus, pose_auth_t **auth);

#endif
