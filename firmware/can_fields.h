// SPDX-License-Identifier: Apache-2.0
// Signals within a CAN frame: numbers of any length at any bit.
#ifndef FIRMWARE_CAN_FIELDS_H
#define FIRMWARE_CAN_FIELDS_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"

/** Start bit and length, as in the DBC file: Intel order, bit n is bit n % 8 of byte n / 8. 1 to 32 bits long. */
typedef struct {
    int start, length;
} can_field_t;

/** Write the field.length lowest bits of value (two's complement). Those bits of the frame must be zero before. */
void can_field_put(hal_can_frame_t *frame, can_field_t field, int64_t value);

uint32_t can_field_get(const hal_can_frame_t *frame, can_field_t field);

int32_t can_field_get_signed(const hal_can_frame_t *frame, can_field_t field);

/** @return Can a signed field of this length hold the value? */
bool can_field_fits_signed(can_field_t field, int64_t value);

/** @return The value, or the largest one that an unsigned field of this length holds. */
uint32_t can_field_saturated(can_field_t field, uint32_t value);

#endif
