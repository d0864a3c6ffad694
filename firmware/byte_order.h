// SPDX-License-Identifier: Apache-2.0
// Numbers as bytes, low byte first.
#ifndef FIRMWARE_BYTE_ORDER_H
#define FIRMWARE_BYTE_ORDER_H

#include <stdint.h>

static inline void put_u32(uint8_t bytes[4], uint32_t value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (uint8_t)(value >> 8 * i);
}

static inline uint32_t get_u32(const uint8_t bytes[4])
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static inline void put_u64(uint8_t bytes[8], uint64_t value)
{
    put_u32(bytes, (uint32_t)value);
    put_u32(bytes + 4, (uint32_t)(value >> 32));
}

static inline uint64_t get_u64(const uint8_t bytes[8])
{
    return (uint64_t)get_u32(bytes + 4) << 32 | get_u32(bytes);
}

#endif
