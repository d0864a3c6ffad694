// SPDX-License-Identifier: Apache-2.0
// CRC and counter of the end-to-end protection.
#include "firmware/can_e2e.h"

static uint8_t crc8_byte(uint8_t crc, uint8_t byte)
{
    unsigned value = crc ^ byte;
    for (int bit = 0; bit < 8; bit++)
        value = (value & 0x80U) != 0 ? (value << 1) ^ 0x1DU : value << 1;
    return (uint8_t)(value & 0xFFU);
}

static uint16_t crc16_byte(uint16_t crc, uint8_t byte)
{
    unsigned value = crc ^ ((unsigned)byte << 8);
    for (int bit = 0; bit < 8; bit++)
        value = (value & 0x8000U) != 0 ? (value << 1) ^ 0x1021U : value << 1;
    return (uint16_t)(value & 0xFFFFU);
}

uint8_t can_e2e_p01_crc(uint16_t data_id, const uint8_t *data, int length)
{
    uint8_t crc = crc8_byte(0x00, (uint8_t)(data_id & 0xFFU));
    crc = crc8_byte(crc, (uint8_t)(data_id >> 8));
    for (int i = 1; i < length; i++)
        crc = crc8_byte(crc, data[i]);
    return crc;
}

uint16_t can_e2e_p05_crc(uint16_t data_id, const uint8_t *data, int length)
{
    uint16_t crc = 0xFFFF;
    for (int i = 2; i < length; i++)
        crc = crc16_byte(crc, data[i]);
    crc = crc16_byte(crc, (uint8_t)(data_id & 0xFFU));
    return crc16_byte(crc, (uint8_t)(data_id >> 8));
}

can_e2e_step_t can_e2e_step(int newest, int counter, int counters, uint32_t *lost)
{
    const int forward = (counter - newest + counters) % counters;
    const int stale = counters == CAN_E2E_P01_COUNTERS ? 3 : 32;
    *lost = 0;
    if (forward == 0)
        return CAN_E2E_DUPLICATE;
    if (forward <= counters / 2) {
        *lost = (uint32_t)forward - 1;
        return CAN_E2E_NEXT;
    }
    return counters - forward <= stale ? CAN_E2E_STALE : CAN_E2E_RESTART;
}
