// SPDX-License-Identifier: Apache-2.0
// What a board has answered, in words: answers on stdout, what has failed on stderr behind the program's name.
#ifndef SIM_POSE_BOARD_ANSWER_H
#define SIM_POSE_BOARD_ANSWER_H

#include <stdbool.h>

#include "sim/pose/board_talk.h"

/** Say what was heard of a board that has not replied, and what to look at. @return false */
bool board_answer_silent(const char *program, const board_talk_t *talk);

/** @return Has the board done it, and replied all that it should? Else that is said. */
bool board_answer_done(const char *program, const board_talk_t *talk);

/** Print the answer of a board that has done it. */
void board_answer_print(const board_talk_t *talk);

/** Print the events of one answer to COMMAND_LOG. @return How many. */
int board_answer_print_events(const board_talk_t *talk);

#endif
