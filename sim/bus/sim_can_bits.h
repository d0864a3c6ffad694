// SPDX-License-Identifier: Apache-2.0
// How many bits a CAN frame takes on the wire, stuff bits included.
#ifndef SIM_BUS_SIM_CAN_BITS_H
#define SIM_BUS_SIM_CAN_BITS_H

#include <stdint.h>

#include "hal/hal_can.h"

/** Bits on the wire by the rate they are sent at. The times of both add up to the time the wire is taken. */
typedef struct {
    int32_t arbitration; /**< at the nominal bit rate */
    int32_t data;        /**< at the data bit rate; 0 unless the frame is FD and switches its bit rate */
} sim_can_bits_t;

enum {
    SIM_CAN_INTERMISSION_BITS = 3, /**< between a frame's last bit and the next frame's first */
    SIM_CAN_ERROR_BITS = 20,       /**< error flag 6, the others' echo of it 6, delimiter 8 */
    SIM_CAN_SUSPEND_BITS = 8,      /**< how much longer an error passive sender waits after a frame of its own */
    SIM_CAN_TAIL_BITS = 12         /**< ACK slot and delimiter, end of frame (7) and intermission: never stuffed */
};

/**
 * Count a data frame's bits from start of frame to the end of intermission (ISO 11898-1:2015).
 *
 * Classic: the real bit stream with its CRC-15 is built and stuffed. FD: stuffed to the end of the data, then stuff
 * count and CRC-17 (up to 16 bytes) or CRC-21 with their fixed stuff bits, whose number does not hang on the CRC's
 * value. The bit rate switches inside the BRS bit and back inside the CRC delimiter, at the sample points; with equal
 * sample points in both phases that is one bit each, so BRS counts as arbitration and the delimiter as data.
 * The sender is taken as error active (ESI dominant), the ACK slot as one bit.
 *
 * @param frame  id in range and length legal, as hal_can_send() demands.
 */
sim_can_bits_t sim_can_bits(const hal_can_frame_t *frame);

#endif
