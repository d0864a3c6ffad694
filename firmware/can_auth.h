// SPDX-License-Identifier: Apache-2.0
// Authentication of messages on the bus: AES-CMAC (NIST SP 800-38B, RFC 4493), truncated, with freshness. A room
// without a key has none of this.
//
// A board's part in it: bus_auth.h.
//
// One 128-bit key for the room (hal_key.h) makes and checks all codes. A code is over one string of bytes; numbers
// here have their lowest byte first:
//
//   2 bytes    identifier of the message's first frame
//   n bytes    data of its frames, in their order, as they are without authentication: with counter and CRC
//   8 bytes    session: a random number that the tracker takes when it starts
//   8 bytes    freshness: bus time when the message was made, in microseconds, less than 2^48; larger than that of
//              every message before it in this session with this identifier
//
// Of the code's 16 bytes the first ones travel:
//
//   FD frame   48 bytes: the message's own 32, then freshness in 6, then 10 bytes of the code. It travels with the
//              identifier 0x104 + viewer in place of 0x100 + viewer, which the code is over: a DBC file gives an
//              identifier one length
//   classic    one more frame of 8 bytes behind the message's: the lowest 3 bytes of the freshness, then 5 bytes of the
//              code. A pose set's has the identifier 0x113 + 4 viewer; that of Sync and FollowUp, which are one
//              message of two frames, 0x0C0 + number of the sender; FrameClock's 0x180 + node: a message of one frame,
//              or of two while a change is announced, that of the epoch to come first; Latency's 0x580 + node
//   command    8 bytes of the code behind the request (command.h); its identifier is that of the board's link, 0x600 +
//              node, its session a random number that the board has just given for this one request, its freshness 0
//
// Key 000102...0F, session 0x0123456789ABCDEF, request of the six letters "freeze" with identifier 0x600: 21 B2 DE 14
// 4A 81 23 C0.
//
// A stranger who fills a 1 Mbit/s bus with classic messages guesses 5 bytes once in 4 years; each attempt is counted
// (can_auth_stream_t).
//
// A board that has just started knows neither session nor bus time, so that old messages would look new. It learns both
// by the command `session` (session, then bus time, 8 bytes each): the number that it gave makes this one new, and
// messages older than it are refused. It is ready for the next session at any time: a tracker that starts anew does
// that with all boards. Bus time must not step back within a session.
//
// Why Mbed TLS: small, made for boards, in Debian for all of them; it takes memory only in can_auth_open(). No globals,
// one thread at a time per can_auth_t.
#ifndef FIRMWARE_CAN_AUTH_H
#define FIRMWARE_CAN_AUTH_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"
#include "hal/hal_key.h"

enum {
    CAN_AUTH_MAC_BYTES = 16,
    CAN_AUTH_COMMAND_BYTES = 8,      /**< of the code behind a command */
    CAN_AUTH_MAX_COMMAND = 504,      /**< bytes of a command without it */
    CAN_AUTH_MAX_FRAMES = 3,         /**< of a classic message */
    CAN_AUTH_FD_PLAIN = 32,          /**< bytes of an FD message without authentication, */
    CAN_AUTH_FD_SIGNED = 48,         /**< and with it */
    CAN_AUTH_ID_POSE_FD = 0x104,     /**< + viewer: an FD pose with its code */
    CAN_AUTH_ID_TIME = 0x0C0,        /**< + number: behind Sync and FollowUp */
    CAN_AUTH_ID_POSE_SET = 0x113,    /**< + 4 * viewer: behind a pose set */
    CAN_AUTH_ID_FRAME_CLOCK = 0x180, /**< + node: behind FrameClock */
    CAN_AUTH_ID_LATENCY = 0x580,     /**< + node: behind Latency */
    CAN_AUTH_RANDOM_ID = 0xFFFF      /**< no message has it */
};

typedef struct can_auth can_auth_t;

/**
 * Prepare for a key. Uses the heap; nothing below does.
 *
 * @param key  Not needed afterwards: wipe it.
 * @return For can_auth_close(); NULL when there is no memory or the library refuses.
 */
can_auth_t *can_auth_open(const hal_key_t *key);

/** Wipe the key and free. NULL is allowed. */
void can_auth_close(can_auth_t *auth);

/** The whole CMAC of any bytes, for tests against published figures. @return false when the library refuses. */
bool can_auth_mac(can_auth_t *auth, const uint8_t *data, int length, uint8_t mac[CAN_AUTH_MAC_BYTES]);

/** What makes a sender's messages new: one for each identifier that it sends. */
typedef struct {
    uint64_t session;
    uint64_t time_us; /**< freshness of the newest message; at first the bus time when the session began */
} can_auth_fresh_t;

/** The next message's: bus time, or where that has not moved one more than the last. */
void can_auth_fresh_step(can_auth_fresh_t *fresh, uint64_t bus_time_us);

/** Frames that make one classic message. */
typedef struct {
    const hal_can_frame_t *frame;
    int frames;      /**< 1 to CAN_AUTH_MAX_FRAMES, each of 8 bytes */
    uint32_t tag_id; /**< identifier of the frame that follows them */
} can_auth_message_t;

/** Sign an FD frame of 32 bytes: it becomes one of 48. @return false, and nothing changed, when it is none, or bus time
 * is 2^48 us or more. */
bool can_auth_sign_fd(can_auth_t *auth, can_auth_fresh_t fresh, hal_can_frame_t *frame);

/** Make the frame that follows a classic message. @return false, and nothing written, when the message is none, or bus
 * time is 2^48 us or more. */
bool can_auth_sign(can_auth_t *auth, can_auth_fresh_t fresh, const can_auth_message_t *message, hal_can_frame_t *tag);

typedef enum {
    CAN_AUTH_OK = 0,
    CAN_AUTH_OTHER,    /**< not an authenticated message: identifier, kind or length */
    CAN_AUTH_FORGED,   /**< the code is not of this key, session, identifier, data and freshness; also a classic message
                            from more than 8 s before or after */
    CAN_AUTH_REPLAYED, /**< right, but not newer than the newest one with this identifier */
    CAN_AUTH_STALE,    /**< right, but made too long ago: held back */
    CAN_AUTH_EARLY,    /**< right, but from the future: bus time and the sender's clock disagree */
    CAN_AUTH_RESULTS
} can_auth_result_t;

/** A receiver's own, one for each identifier. Begin a session with session and newest_us from its command. */
typedef struct {
    uint64_t session;
    uint64_t newest_us;                 /**< freshness of the newest good message */
    uint32_t results[CAN_AUTH_RESULTS]; /**< how often each was returned; each wraps at 2^32 */
} can_auth_stream_t;

/** When a message must have been made. */
typedef struct {
    uint64_t now_us;    /**< bus time when its last bit was seen, as far as it is known; less than 2^48 */
    uint64_t past_us;   /**< before that: at most so long, */
    uint64_t future_us; /**< and after that: at most so long, for what bus time may be off */
} can_auth_window_t;

/**
 * Check an FD frame.
 *
 * @param[in,out] frame  Becomes the plain frame of 32 bytes when CAN_AUTH_OK is returned, else is untouched.
 */
can_auth_result_t can_auth_check_fd(can_auth_t *auth, can_auth_stream_t *stream, const can_auth_window_t *window,
                                    hal_can_frame_t *frame);

/** Check a classic message by the frame that followed it. */
can_auth_result_t can_auth_check(can_auth_t *auth, can_auth_stream_t *stream, const can_auth_window_t *window,
                                 const can_auth_message_t *message, const hal_can_frame_t *tag);

/** A command, and what it was asked for with. */
typedef struct {
    uint32_t id; /**< of the board's ISO-TP link, on which it comes */
    const uint8_t *data;
    int length;     /**< 0 to CAN_AUTH_MAX_COMMAND */
    uint64_t nonce; /**< that the board gave last, for one command only */
} can_auth_command_t;

/** Make a command's code. @return false, and nothing written, when its length is out of range. */
bool can_auth_sign_command(can_auth_t *auth, const can_auth_command_t *command, uint8_t code[CAN_AUTH_COMMAND_BYTES]);

/** @return Is it the command's code? The nonce is used up, whatever the answer. */
bool can_auth_check_command(can_auth_t *auth, const can_auth_command_t *command,
                            const uint8_t code[CAN_AUTH_COMMAND_BYTES]);

/**
 * A number that nobody without the key can guess: the first 8 bytes of the code of no data with CAN_AUTH_RANDOM_ID, the
 * seed as session and the count as freshness.
 *
 * @param[out] number  Written only when true is returned.
 * @return false when the library refuses.
 */
bool can_auth_random(can_auth_t *auth, uint64_t seed, uint64_t count, uint64_t *number);

#endif
