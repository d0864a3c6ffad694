// SPDX-License-Identifier: Apache-2.0
// Signals within a CAN frame, bit by bit.
#include "firmware/can_fields.h"

void can_field_put(hal_can_frame_t *frame, can_field_t field, int64_t value)
{
    for (int i = 0; i < field.length; i++) {
        const int bit = field.start + i;
        const unsigned one = (unsigned)(((uint64_t)value >> i) & 1U);
        frame->data[bit / 8] = (uint8_t)(frame->data[bit / 8] | one << (bit % 8));
    }
}

uint32_t can_field_get(const hal_can_frame_t *frame, can_field_t field)
{
    uint32_t value = 0;
    for (int i = 0; i < field.length; i++) {
        const int bit = field.start + i;
        value |= (uint32_t)((frame->data[bit / 8] >> (bit % 8)) & 1) << i;
    }
    return value;
}

int32_t can_field_get_signed(const hal_can_frame_t *frame, can_field_t field)
{
    const int64_t value = can_field_get(frame, field);
    const int64_t half_range = INT64_C(1) << (field.length - 1);
    return (int32_t)(value >= half_range ? value - 2 * half_range : value);
}

bool can_field_fits_signed(can_field_t field, int64_t value)
{
    const int64_t half_range = INT64_C(1) << (field.length - 1);
    return value >= -half_range && value < half_range;
}

uint32_t can_field_saturated(can_field_t field, uint32_t value)
{
    const uint32_t largest = (uint32_t)((UINT64_C(1) << field.length) - 1);
    return value < largest ? value : largest;
}
