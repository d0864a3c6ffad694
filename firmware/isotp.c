// SPDX-License-Identifier: Apache-2.0
// Messages of up to 512 bytes over classic CAN frames: ISO 15765-2, one state machine for each direction.
#include "firmware/isotp.h"

#include <string.h>

enum {
    SINGLE = 0x00, /* high half of the first byte, 9.2 */
    FIRST = 0x10,
    CONSECUTIVE = 0x20,
    FLOW = 0x30,
    GO_ON = 0x30, /* flow controls, 9.6.5.1 */
    WAIT = 0x31,
    OVERFLOW = 0x32,
    FRAME_BYTES = 8,
    SINGLE_BYTES = 7,
    FIRST_BYTES = 6,
    PADDING = 0xCC,
    LONGEST_GAP_US = 127000,
    LOWEST_FINE_GAP = 0xF1,
    HIGHEST_FINE_GAP = 0xF9
};

uint32_t isotp_faults_total(const isotp_faults_t *faults)
{
    return faults->sequence + faults->timeout + faults->overflow + faults->busy + faults->invalid;
}

void isotp_init(isotp_t *link, uint32_t receive_id, uint32_t send_id)
{
    memset(link, 0, sizeof *link);
    link->receive_id = receive_id;
    link->send_id = send_id;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* STmin, 9.6.5.4: 0 to 127 ms, 100 to 900 us; reserved values mean the longest. */
static int64_t gap_from_byte(uint8_t byte)
{
    if (byte >= LOWEST_FINE_GAP && byte <= HIGHEST_FINE_GAP)
        return (byte - LOWEST_FINE_GAP + 1) * 100;
    return byte * INT64_C(1000) <= LONGEST_GAP_US ? byte * INT64_C(1000) : LONGEST_GAP_US;
}

/* Room for a new message: one that is under way is given up, one that is whole stays. */
static bool begin_in(isotp_t *link, int length, int64_t now_us)
{
    if (link->whole) {
        link->faults.busy++;
        return false;
    }
    link->faults.sequence += link->in.active;
    link->in.active = false;
    if (length > ISOTP_MAX_LENGTH) {
        link->faults.overflow++;
        link->answer = OVERFLOW;
        return false;
    }
    link->in.active = true;
    link->in.length = length;
    link->in.done = 0;
    link->in.sequence = 1;
    link->in.due_us = now_us + ISOTP_TIMEOUT_US;
    return true;
}

static void append(isotp_t *link, const uint8_t *data, int count)
{
    isotp_message_t *in = &link->in;
    count = least(count, in->length - in->done);
    memcpy(in->data + in->done, data, (size_t)count);
    in->done += count;
    link->whole = in->done == in->length;
    in->active = !link->whole;
}

static void take_single(isotp_t *link, const hal_can_frame_t *frame, int64_t now_us)
{
    const int length = frame->data[0];
    if (length == 0 || length > SINGLE_BYTES || frame->length < 1 + length)
        link->faults.invalid++;
    else if (begin_in(link, length, now_us))
        append(link, frame->data + 1, length);
}

static void take_first(isotp_t *link, const hal_can_frame_t *frame, int64_t now_us)
{
    const int length = (frame->data[0] & 0x0F) << 8 | frame->data[1];
    if (frame->length != FRAME_BYTES || length < FRAME_BYTES) {
        link->faults.invalid++;
    } else if (begin_in(link, length, now_us)) {
        append(link, frame->data + 2, FIRST_BYTES);
        link->answer = GO_ON;
    }
}

static void take_consecutive(isotp_t *link, const hal_can_frame_t *frame, int64_t now_us)
{
    isotp_message_t *in = &link->in;
    const int rest = in->length - in->done;
    if (!in->active || (frame->data[0] & 0x0F) != in->sequence || frame->length < 1 + least(rest, SINGLE_BYTES)) {
        link->faults.sequence++;
        in->active = false;
        return;
    }
    in->sequence = (in->sequence + 1) & 0x0F;
    in->due_us = now_us + ISOTP_TIMEOUT_US;
    append(link, frame->data + 1, SINGLE_BYTES);
}

static void take_flow(isotp_t *link, const hal_can_frame_t *frame, int64_t now_us)
{
    isotp_message_t *out = &link->out;
    if (!out->active || !link->waiting || frame->length < 3) {
        link->faults.invalid++;
    } else if (frame->data[0] == GO_ON) {
        link->waiting = false;
        link->waits = 0;
        link->block = frame->data[1] == 0 ? -1 : frame->data[1];
        link->gap_us = gap_from_byte(frame->data[2]);
        out->due_us = now_us;
    } else if (frame->data[0] == WAIT && ++link->waits <= ISOTP_MOST_WAITS) {
        out->due_us = now_us + ISOTP_TIMEOUT_US;
    } else {
        link->faults.overflow += frame->data[0] == OVERFLOW;
        link->faults.timeout += frame->data[0] == WAIT;
        link->faults.invalid += frame->data[0] > OVERFLOW;
        out->active = false;
    }
}

bool isotp_take(isotp_t *link, const hal_can_frame_t *frame, int64_t now_us)
{
    if (frame->id != link->receive_id || frame->extended)
        return false;
    if (frame->fd || frame->length == 0 || frame->data[0] >= FLOW + 0x10)
        link->faults.invalid++;
    else if (frame->data[0] >= FLOW)
        take_flow(link, frame, now_us);
    else if (frame->data[0] >= CONSECUTIVE)
        take_consecutive(link, frame, now_us);
    else if (frame->data[0] >= FIRST)
        take_first(link, frame, now_us);
    else
        take_single(link, frame, now_us);
    return true;
}

bool isotp_send(isotp_t *link, const uint8_t *data, int length, int64_t now_us)
{
    isotp_message_t *out = &link->out;
    if (out->active || length < 1 || length > ISOTP_MAX_LENGTH)
        return false;
    memcpy(out->data, data, (size_t)length);
    out->length = length;
    out->done = 0;
    out->active = true;
    out->sequence = 1;
    out->due_us = now_us;
    link->waiting = false;
    link->waits = 0;
    link->gap_us = 0;
    return true;
}

bool isotp_sending(const isotp_t *link)
{
    return link->out.active;
}

static void end_what_waits(isotp_t *link, int64_t now_us)
{
    if (link->in.active && now_us > link->in.due_us) {
        link->faults.timeout++;
        link->in.active = false;
    }
    if (link->out.active && link->waiting && now_us > link->out.due_us) {
        link->faults.timeout++;
        link->out.active = false;
    }
}

static hal_can_frame_t empty_frame(const isotp_t *link)
{
    hal_can_frame_t frame = {.id = link->send_id, .length = FRAME_BYTES};
    memset(frame.data, PADDING, FRAME_BYTES);
    return frame;
}

/* Puts the next bytes of the message behind so many bytes of protocol. */
static void put_bytes(hal_can_frame_t *frame, int protocol, isotp_message_t *out)
{
    const int count = least(FRAME_BYTES - protocol, out->length - out->done);
    memcpy(frame->data + protocol, out->data + out->done, (size_t)count);
    out->done += count;
}

static void begin_out(isotp_t *link, hal_can_frame_t *frame, int64_t now_us)
{
    isotp_message_t *out = &link->out;
    if (out->length <= SINGLE_BYTES) {
        frame->data[0] = (uint8_t)(SINGLE | out->length);
        put_bytes(frame, 1, out);
        out->active = false;
        return;
    }
    frame->data[0] = (uint8_t)(FIRST | out->length >> 8);
    frame->data[1] = (uint8_t)out->length;
    put_bytes(frame, 2, out);
    link->waiting = true;
    out->due_us = now_us + ISOTP_TIMEOUT_US;
}

static void go_on(isotp_t *link, hal_can_frame_t *frame, int64_t now_us)
{
    isotp_message_t *out = &link->out;
    frame->data[0] = (uint8_t)(CONSECUTIVE | out->sequence);
    put_bytes(frame, 1, out);
    out->sequence = (out->sequence + 1) & 0x0F;
    out->active = out->done < out->length;
    out->due_us = now_us + link->gap_us;
    if (link->block > 0 && --link->block == 0) {
        link->waiting = true;
        out->due_us = now_us + ISOTP_TIMEOUT_US;
    }
}

bool isotp_next(isotp_t *link, hal_can_frame_t *frame, int64_t now_us)
{
    end_what_waits(link, now_us);
    if (link->answer != 0) {
        *frame = empty_frame(link);
        frame->data[0] = link->answer;
        frame->data[1] = 0; /* no further flow controls */
        frame->data[2] = ISOTP_GAP_MS;
        link->answer = 0;
        return true;
    }
    if (!link->out.active || link->waiting || now_us < link->out.due_us)
        return false;
    *frame = empty_frame(link);
    if (link->out.done == 0)
        begin_out(link, frame, now_us);
    else
        go_on(link, frame, now_us);
    return true;
}

int isotp_received(const isotp_t *link, const uint8_t **data)
{
    if (!link->whole)
        return 0;
    *data = link->in.data;
    return link->in.length;
}

void isotp_taken(isotp_t *link)
{
    link->whole = false;
}
