// SPDX-License-Identifier: Apache-2.0
// Bits of a CAN frame on the wire, by a frame builder for tests that shares nothing with sim_can_bits.c.
#ifndef TESTS_SUPPORT_CAN_BITS_ORACLE_H
#define TESTS_SUPPORT_CAN_BITS_ORACLE_H

#include <stdint.h>
#include <string.h>

#include "sim/bus/sim_can_bits.h"

enum { CAN_BITS_LONGEST = 1024 };

static const uint8_t can_bits_lengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};

/* Bits as characters, so that the oracle shares nothing with the code under test. */
typedef struct {
    char bit[CAN_BITS_LONGEST];
    int count;
} can_bits_text_t;

static inline void can_bits_put(can_bits_text_t *text, uint32_t value, int count)
{
    for (int i = count - 1; i >= 0; i--)
        text->bit[text->count++] = (value >> i & 1U) != 0 ? '1' : '0';
}

/* CRC-15 by long division of the whole stream. */
static inline void can_bits_put_crc15(can_bits_text_t *text)
{
    static const char divisor[] = "1100010110011001";
    can_bits_text_t rest = *text;
    can_bits_put(&rest, 0, 15);
    for (int i = 0; i < text->count; i++) {
        if (rest.bit[i] == '0')
            continue;
        for (int j = 0; j < 16; j++)
            rest.bit[i + j] = rest.bit[i + j] == divisor[j] ? '0' : '1';
    }
    memcpy(text->bit + text->count, rest.bit + text->count, 15);
    text->count += 15;
}

/* Stuff bits in text[0..count), each told by the index of the bit it follows; returns how many follow [begin, end). */
static inline int can_bits_stuffed(const can_bits_text_t *text, int count, int begin, int end)
{
    int found = 0;
    can_bits_text_t sent = {.count = 0};
    for (int i = 0; i < count; i++) {
        sent.bit[sent.count++] = text->bit[i];
        if (sent.count < 5)
            continue;
        const char *tail = sent.bit + sent.count - 5;
        if (memcmp(tail, "00000", 5) != 0 && memcmp(tail, "11111", 5) != 0)
            continue;
        sent.bit[sent.count++] = text->bit[i] == '0' ? '1' : '0';
        found += i >= begin && i < end;
    }
    return found;
}

static inline sim_can_bits_t can_bits_oracle(const hal_can_frame_t *frame)
{
    uint32_t code = 0;
    while (can_bits_lengths[code] != frame->length)
        code++;
    can_bits_text_t text = {.count = 0};
    can_bits_put(&text, 0, 1);
    can_bits_put(&text, frame->extended ? frame->id >> 18 : frame->id, 11);
    if (frame->extended) {
        can_bits_put(&text, 3, 2);
        can_bits_put(&text, frame->id & 0x3FFFF, 18);
    }
    can_bits_put(&text, 0, frame->extended ? 1 : 2); /* RTR or RRS; IDE of a standard frame */
    if (frame->fd)
        can_bits_put(&text, frame->bit_rate_switch ? 5 : 4, 3);
    else
        can_bits_put(&text, 0, frame->extended ? 2 : 1);
    const int switched_at = text.count;
    can_bits_put(&text, code, frame->fd ? 5 : 4);
    for (int i = 0; i < frame->length; i++)
        can_bits_put(&text, frame->data[i], 8);
    const int end_of_frame = 1 + 1 + 7 + 3;
    if (!frame->fd) {
        can_bits_put_crc15(&text);
        const int stuffed = can_bits_stuffed(&text, text.count, 0, text.count);
        return (sim_can_bits_t){.arbitration = text.count + stuffed + 1 + end_of_frame};
    }
    const int crc_field = frame->length > 16 ? 4 + 21 + 7 : 4 + 17 + 6;
    const int before = switched_at + can_bits_stuffed(&text, text.count, 0, switched_at);
    const int stuffed = can_bits_stuffed(&text, text.count, switched_at, text.count - 1);
    const int after = text.count - switched_at + stuffed + crc_field + 1;
    if (frame->bit_rate_switch)
        return (sim_can_bits_t){before + end_of_frame, after};
    return (sim_can_bits_t){.arbitration = before + after + end_of_frame};
}

#endif
