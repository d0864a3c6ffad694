// SPDX-License-Identifier: Apache-2.0
// Numbers in the bytes of a packet, of either byte order. The caller has checked that the bytes are there.
#ifndef SIM_TRACKERS_PACKET_BYTES_H
#define SIM_TRACKERS_PACKET_BYTES_H

#include <stdint.h>
#include <string.h>

static inline uint16_t packet_be16(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] << 8 | bytes[1]);
}

static inline uint32_t packet_be32(const uint8_t *bytes)
{
    return (uint32_t)packet_be16(bytes) << 16 | packet_be16(bytes + 2);
}

/** Two's complement of 24 bits. */
static inline int32_t packet_be24_signed(const uint8_t *bytes)
{
    const int32_t value = bytes[0] << 16 | bytes[1] << 8 | bytes[2];
    return value >= 1 << 23 ? value - (1 << 24) : value;
}

static inline uint32_t packet_le32(const uint8_t *bytes)
{
    return (uint32_t)bytes[3] << 24 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[1] << 8 | bytes[0];
}

static inline uint64_t packet_le64(const uint8_t *bytes)
{
    return (uint64_t)packet_le32(bytes + 4) << 32 | packet_le32(bytes);
}

/** IEEE 754 binary32. */
static inline float packet_le_float(const uint8_t *bytes)
{
    const uint32_t bits = packet_le32(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
