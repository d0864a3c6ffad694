// SPDX-License-Identifier: Apache-2.0
// The words of the socketcand protocol: commands read, frames written.
#ifndef SIM_BUS_SOCKETCAND_TEXT_H
#define SIM_BUS_SOCKETCAND_TEXT_H

#include <stddef.h>

#include "hal/hal_can.h"

enum {
    SOCKETCAND_COMMAND_LENGTH = 256, /**< longest command read, with its brackets */
    SOCKETCAND_FRAME_LENGTH = 80     /**< longest text written for a frame, with its final zero */
};

typedef enum {
    SOCKETCAND_OPEN,    /**< < open CHANNEL > */
    SOCKETCAND_RAWMODE, /**< < rawmode > */
    SOCKETCAND_SEND,    /**< < send ID LENGTH B0 B1 ... > */
    SOCKETCAND_ECHO,    /**< < echo > */
    SOCKETCAND_WRONG    /**< anything else */
} socketcand_verb_t;

typedef struct {
    socketcand_verb_t verb;
    hal_can_frame_t frame; /**< of SOCKETCAND_SEND: a classic frame */
    char channel[17];      /**< of SOCKETCAND_OPEN */
    const char *problem;   /**< of SOCKETCAND_WRONG: what was expected */
} socketcand_command_t;

/**
 * Read one command.
 *
 * Words are parted by any white space. An identifier of 8 digits or above 7FF is an extended one. The length is
 * 0 to 8, and as many bytes of one or two hexadecimal digits follow.
 *
 * @param text    From '<' to '>', both included; need not end with a zero.
 * @param length  Characters of text.
 */
socketcand_command_t socketcand_command_from_text(const char *text, size_t length);

/**
 * Write a classic frame as a client hears it: "< frame 123 23.424242 11223344 >". An extended identifier has 8 digits.
 *
 * @param[out] text  The frame with a final zero.
 * @return Characters written, without the zero.
 */
size_t socketcand_text_from_frame(char text[SOCKETCAND_FRAME_LENGTH], const hal_can_frame_t *frame);

/**
 * Read a frame as a client hears it. A line feed anywhere between its words is allowed.
 *
 * @param[out] frame  Written only on success: a classic frame.
 * @param text        From '<' to '>', both included; need not end with a zero.
 * @param length      Characters of text.
 * @return false when it is anything else.
 */
bool socketcand_frame_from_text(hal_can_frame_t *frame, const char *text, size_t length);

#endif
