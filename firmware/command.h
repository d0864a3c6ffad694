// SPDX-License-Identifier: Apache-2.0
// What an operator may tell a board over the bus: requests and replies as bytes of an ISO-TP message.
//
// A request is a command_kind_t and what belongs to it; a reply is the same number plus 128, a command_result_t, and,
// when that is COMMAND_OK, what was asked for, or when it is COMMAND_IMPOSSIBLE, why. Numbers have their low byte
// first.
//
// | request                            | reply, after the result                                        |
// |------------------------------------|----------------------------------------------------------------|
// | 1 hello                            | node (1), events since the start (4), version as text          |
// | 2 method: name as text, "" = room's |                                                                |
// | 3 freeze: 1 or 0                   |                                                                |
// | 4 pattern: command_pattern_t       |                                                                |
// | 5 latency: us (4), 0 = least       | us that this board's pose to photon will be (4); impossible:   |
// |                                    | the least (4) and the most (4) that all boards can have alike  |
// | 6 reboot: the text "reboot"        |                                                                |
// | 7 log: first event (4)             | first event (4), then EVENT_BYTES for each, up to 50           |
// | 8 nonce                            | a random number (8), for one request within 2 s                |
// | 9 session (8), bus time in us (8)  |                                                                |
// | 10 update: command_update_t (1)    | how its update stands (update_status.h); impossible:           |
// |                                    | update_refusal_t (1)                                           |
//
// Behind command_update_t: install: the source as text (hal_update.h); switch: the moment in bus time, us (8), and the
// version as text; confirm: that moment (8). What they do: update.h.
//
// A board without a key does not know 8 and 9. A board with one wants 8 bytes more behind every request but `nonce`:
// its code (can_auth.h). The number in it is used up by the request, whatever comes of it; a board keeps one, and gives
// whoever asks next another. So who hears COMMAND_REFUSED, or no reply, begins again with `nonce`: every request may be
// done twice.
#ifndef FIRMWARE_COMMAND_H
#define FIRMWARE_COMMAND_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_update.h"
#include "warp_fixed/method.h"

enum {
    CAN_ID_COMMAND = 0x600,   /**< + node: ISO-TP frames to a board */
    CAN_ID_REPLY = 0x640,     /**< + node: and from it */
    COMMAND_MAX_BYTES = 256,  /**< of a request, with its code */
    COMMAND_REPLY_FLAG = 128, /**< in a reply's number */
    COMMAND_REPLY_BYTES = 512,
    COMMAND_MOST_EVENTS = 50,
    COMMAND_MOST_LATENCY_US = 200000,
    COMMAND_ROOM_METHOD = 255
};

typedef enum {
    COMMAND_HELLO = 1,
    COMMAND_METHOD = 2,
    COMMAND_FREEZE = 3,
    COMMAND_PATTERN = 4,
    COMMAND_LATENCY = 5,
    COMMAND_REBOOT = 6,
    COMMAND_LOG = 7,
    COMMAND_NONCE = 8,
    COMMAND_SESSION = 9,
    COMMAND_UPDATE = 10
} command_kind_t;

typedef enum {
    COMMAND_OK = 0,
    COMMAND_UNKNOWN = 1,   /**< no such command */
    COMMAND_BAD_VALUE = 2, /**< of a wrong length, or a value that is not a legal one */
    COMMAND_REFUSED = 3,   /**< not allowed: its code (can_auth.h) is missing or wrong */
    COMMAND_IMPOSSIBLE = 4 /**< this board cannot do it now */
} command_result_t;

/** Pictures for setting a projector up. */
typedef enum {
    COMMAND_PATTERN_NONE = 0, /**< back to the corrected picture */
    COMMAND_PATTERN_GRID = 1, /**< border, middle lines, squares of an eighth of the height */
    COMMAND_PATTERN_WHITE = 2,
    COMMAND_PATTERN_BLACK = 3,
    COMMAND_PATTERNS
} command_pattern_t;

/** What about the update of a board. */
typedef enum {
    COMMAND_UPDATE_STATUS = 0,
    COMMAND_UPDATE_INSTALL = 1,
    COMMAND_UPDATE_SWITCH = 2, /**< to a version at a moment, once that is confirmed */
    COMMAND_UPDATE_CONFIRM = 3,
    COMMAND_UPDATE_CANCEL = 4, /**< the switch that is to come */
    COMMAND_UPDATES
} command_update_t;

typedef struct {
    command_kind_t kind;
    const warp_method_t *method; /**< COMMAND_METHOD: NULL is the room's own */
    bool freeze;
    command_pattern_t pattern;
    uint32_t latency_us; /**< up to COMMAND_MOST_LATENCY_US; see frame_latency.h */
    uint32_t first_event;
    uint64_t session;     /**< COMMAND_SESSION */
    uint64_t bus_time_us; /**< when it begins; COMMAND_UPDATE: when to switch; less than 2^48 */
    command_update_t update;
    char text[HAL_UPDATE_SOURCE_LENGTH]; /**< COMMAND_UPDATE: source of an install, or version of a switch */
} command_t;

/** @return Bytes of the request. */
int command_encode(uint8_t bytes[COMMAND_MAX_BYTES], const command_t *command);

/**
 * Read a request.
 *
 * @param[out] command  Written only for COMMAND_OK.
 * @return COMMAND_OK, COMMAND_UNKNOWN or COMMAND_BAD_VALUE.
 */
command_result_t command_decode(command_t *command, const uint8_t *bytes, int length);

/**
 * @return What a request asks for as a small number, for the log. Method: 16 times its filter and its resampler, or
 *         COMMAND_ROOM_METHOD; freeze: 1 or 0; pattern: which; latency: whole milliseconds; update: command_update_t;
 * else 0.
 */
uint8_t command_argument(const command_t *command);

#endif
