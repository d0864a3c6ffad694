// SPDX-License-Identifier: Apache-2.0
// Requests to a board as an operator writes them, and what came of them as the operator reads it.
#ifndef SIM_POSE_REQUEST_TEXT_H
#define SIM_POSE_REQUEST_TEXT_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/command.h"

enum { REQUEST_TEXT_MESSAGE_LENGTH = 640, REQUEST_ARGUMENT_LENGTH = 32 };

/**
 * Words -> request.
 *
 * @param[out] request  Written only when true is returned.
 * @param      name     hello, method, freeze, pattern, latency, reboot or log.
 * @param      value    method: a method's name, or "room"; freeze: on or off; pattern: none, grid, white or black;
 *                      latency: milliseconds; the others: NULL.
 * @param[out] error    On failure: one line without newline, what was expected.
 */
bool request_from_text(command_t *request, const char *name, const char *value,
                       char error[REQUEST_TEXT_MESSAGE_LENGTH]);

/** @return "freeze"; "unknown" when there is no such request. */
const char *request_name(uint8_t kind);

/** " area", " on", " grid", " 40 ms", " install": what was asked for, by its command_argument(); "" when nothing can
 * be. */
void request_argument_text(char text[REQUEST_ARGUMENT_LENGTH], uint8_t kind, uint8_t argument);

/** @return A short word: "done", "unknown", "bad value", "refused", "impossible". */
const char *request_result_name(uint8_t result);

/** @return Why a board did not do it, and what to do. @param result  Not COMMAND_OK. */
const char *request_refusal(command_kind_t kind, uint8_t result);

#endif
