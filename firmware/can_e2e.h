// SPDX-License-Identifier: Apache-2.0
// End-to-end protection of CAN messages: CRC and counter, as AUTOSAR's E2E profiles 1 and 5 have them.
//
// Every message has a 16-bit data id that is not sent but goes into its CRC, so that a frame that was sent or stored
// under a wrong identifier is refused. In wallwarp the data id of a message is its CAN identifier.
#ifndef FIRMWARE_CAN_E2E_H
#define FIRMWARE_CAN_E2E_H

#include <stdint.h>

enum {
    CAN_E2E_P01_HEADER_BITS = 12, /**< CRC-8 in byte 0, counter in the low half of byte 1 */
    CAN_E2E_P01_COUNTERS = 15,    /**< the counter runs 0 to 14; 15 is not a counter */
    CAN_E2E_P05_HEADER_BITS = 24, /**< CRC-16 in bytes 0 and 1, low byte first; counter in byte 2 */
    CAN_E2E_P05_COUNTERS = 256
};

/**
 * CRC of profile 1, variant 1A: polynomial 0x1D (SAE J1850), start 0x00, xor 0x00, not reflected; over the data id, low
 * byte first, and data[1] to data[length - 1]. Byte 0, its own place, is left out.
 */
uint8_t can_e2e_p01_crc(uint16_t data_id, const uint8_t *data, int length);

/**
 * CRC of profile 5: polynomial 0x1021, start 0xFFFF, xor 0x0000, not reflected (CCITT-FALSE); over data[2] to
 * data[length - 1] and the data id, low byte first.
 */
uint16_t can_e2e_p05_crc(uint16_t data_id, const uint8_t *data, int length);

/** What a counter says when compared with the newest one before it. */
typedef enum {
    CAN_E2E_NEXT,      /**< newer; those in between were lost */
    CAN_E2E_DUPLICATE, /**< the same again */
    CAN_E2E_STALE,     /**< a little older: a late or repeated frame */
    CAN_E2E_RESTART    /**< jumped back too far to be late: the sender has started anew */
} can_e2e_step_t;

/**
 * Compare counters on their circle: up to half a turn forward is newer; up to a fifth (profile 1) or an eighth
 * (profile 5) of a turn back is stale; the rest is a restart.
 *
 * @param      newest    Counter before, 0 to counters - 1.
 * @param      counter   Counter now, 0 to counters - 1.
 * @param      counters  CAN_E2E_P01_COUNTERS or CAN_E2E_P05_COUNTERS.
 * @param[out] lost      How many were skipped; 0 unless CAN_E2E_NEXT is returned.
 */
can_e2e_step_t can_e2e_step(int newest, int counter, int counters, uint32_t *lost);

#endif
