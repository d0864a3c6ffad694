// SPDX-License-Identifier: Apache-2.0
// What people need to know to wire and set up a board: one constant of this type in board/NAME/info.c. No program of
// the board holds it; `make BOARD=NAME info` prints it, and the board's README.md shows what that prints.
#ifndef BOARD_BOARD_INFO_H
#define BOARD_BOARD_INFO_H

#include <stdint.h>
#include <stdio.h>

#include "hal/hal_board.h"

enum { BOARD_STEPS = 8, BOARD_NO_PIN = 0, BOARD_WIRE_FIXED = -1 };

/** One wire from the board. */
typedef struct {
    int32_t pin;        /**< of the header; BOARD_NO_PIN when it has no number there */
    int32_t line;       /**< hal_gpio_line_t: its offset is in the board's table; else BOARD_WIRE_FIXED */
    const char *signal; /**< name at the board; NULL for a line, which is named by its offset */
    const char *to;     /**< where it goes */
} board_wire_t;

/** A file to write lines into, or a shell to type them into. */
typedef struct {
    const char *where;
    const char *lines; /**< each ended by a newline */
} board_step_t;

typedef struct {
    const char *machine;            /**< what to buy, and with which system on it */
    const char *header;             /**< of the column of pins */
    const char *line_prefix;        /**< name of a line at the board is this and its offset */
    const board_wire_t *wire;       /**< up to one that goes nowhere (to: NULL); NULL: none */
    board_step_t step[BOARD_STEPS]; /**< up to the first with where: NULL */
} board_info_t;

extern const board_info_t board_info;

/** Of a Raspberry Pi 4 or 5 with a CAN FD hat. */
extern const board_wire_t raspberry_pi_wires[];

/** Print table and info as Markdown. @return false when that failed, or when a line of the table has no wire. */
bool board_info_print(FILE *to, const board_table_t *table, const board_info_t *info);

#endif
