// SPDX-License-Identifier: Apache-2.0
// Builds a frame's bit stream as a controller does, and counts it.
#include "sim/bus/sim_can_bits.h"

enum {
    CRC15_BITS = 15,
    CRC15_POLYNOMIAL = 0x4599,
    CRC_DELIMITER_BITS = 1,
    STUFF_COUNT_BITS = 4, /* three Gray coded, one parity */
    FD_SHORT_CRC_BYTES = 16
};

/* A bit stream in the making: only what is needed to count it. */
typedef struct {
    int32_t bits;      /**< sent so far, stuff bits included */
    int32_t run;       /**< equal bits at the end */
    unsigned last;     /**< the last bit */
    uint32_t crc15;    /**< over the bits before stuffing */
    bool stuff_is_due; /**< five equal bits were sent, their stuff bit not yet */
} stream_t;

static void append_raw(stream_t *stream, unsigned bit)
{
    stream->run = stream->bits > 0 && bit == stream->last ? stream->run + 1 : 1;
    stream->last = bit;
    stream->bits++;
}

static void append_due_stuff_bit(stream_t *stream)
{
    if (stream->stuff_is_due)
        append_raw(stream, stream->last ^ 1U);
    stream->stuff_is_due = false;
}

static void append(stream_t *stream, uint32_t value, int count)
{
    for (int i = count - 1; i >= 0; i--) {
        const unsigned bit = (value >> i) & 1U;
        append_due_stuff_bit(stream);
        append_raw(stream, bit);
        stream->stuff_is_due = stream->run == 5;
        const unsigned out = (stream->crc15 >> (CRC15_BITS - 1)) & 1U;
        stream->crc15 = (stream->crc15 << 1) & 0x7FFFU;
        if (out != bit)
            stream->crc15 ^= CRC15_POLYNOMIAL;
    }
}

/* Start of frame, identifier, and the RTR or RRS and IDE bits around it. */
static void append_arbitration_field(stream_t *stream, const hal_can_frame_t *frame)
{
    append(stream, 0, 1);
    if (frame->extended) {
        append(stream, frame->id >> 18, 11);
        append(stream, 3, 2);
        append(stream, frame->id & 0x3FFFFU, 18);
        append(stream, 0, 1);
    } else {
        append(stream, frame->id, 11);
        append(stream, 0, 2);
    }
}

static uint32_t dlc_from_length(uint8_t length)
{
    if (length <= 8)
        return length;
    if (length <= 24)
        return 9U + ((uint32_t)length - 12U) / 4U;
    return 12U + (uint32_t)length / 16U - 1U;
}

static void append_data(stream_t *stream, const hal_can_frame_t *frame)
{
    for (int i = 0; i < frame->length; i++)
        append(stream, frame->data[i], 8);
}

static sim_can_bits_t classic_bits(const hal_can_frame_t *frame)
{
    stream_t stream = {0};
    append_arbitration_field(&stream, frame);
    append(&stream, 0, frame->extended ? 2 : 1);
    append(&stream, frame->length, 4);
    append_data(&stream, frame);
    append(&stream, stream.crc15, CRC15_BITS);
    append_due_stuff_bit(&stream); /* five equal bits at the end of the CRC are stuffed too */
    return (sim_can_bits_t){.arbitration = stream.bits + CRC_DELIMITER_BITS + SIM_CAN_TAIL_BITS};
}

static sim_can_bits_t fd_bits(const hal_can_frame_t *frame)
{
    stream_t stream = {0};
    append_arbitration_field(&stream, frame);
    append(&stream, 2, 2); /* FDF, then the reserved bit */
    append(&stream, frame->bit_rate_switch ? 1 : 0, 1);
    const int32_t arbitration = stream.bits; /* FDF and the reserved bit differ: no run of five ends at BRS */
    append(&stream, dlc_from_length(frame->length), 5); /* ESI and DLC */
    append_data(&stream, frame);

    /* A stuff bit due here is replaced by the first fixed one: one before the stuff count, then one each four bits. */
    const int32_t crc = frame->length <= FD_SHORT_CRC_BYTES ? 17 : 21;
    const int32_t fixed = (STUFF_COUNT_BITS + crc - 1) / 4 + 1;
    const int32_t data = stream.bits - arbitration + STUFF_COUNT_BITS + crc + fixed + CRC_DELIMITER_BITS;
    if (frame->bit_rate_switch)
        return (sim_can_bits_t){arbitration + SIM_CAN_TAIL_BITS, data};
    return (sim_can_bits_t){.arbitration = arbitration + data + SIM_CAN_TAIL_BITS};
}

sim_can_bits_t sim_can_bits(const hal_can_frame_t *frame)
{
    return frame->fd ? fd_bits(frame) : classic_bits(frame);
}
