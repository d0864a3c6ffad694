// SPDX-License-Identifier: Apache-2.0
// OpenTrackIO 1.0.1 over UDP: packets, joined where a sample comes in segments -> poses.
#include "sim/trackers/opentrackio.h"

#include <string.h>

#include "sim/trackers/cbor_json.h"
#include "sim/trackers/opentrackio_sample.h"
#include "sim/trackers/packet_bytes.h"

enum { HEADER_LENGTH = 16, CHECKSUM_AT = 14, ENCODING_JSON = 1, ENCODING_CBOR = 2, LAST_SEGMENT = 0x8000 };

static bool checksum_is_right(const uint8_t *bytes, size_t size)
{
    uint8_t sum1 = 0, sum2 = 0;
    for (size_t i = 0; i < size; i++) {
        if (i >= CHECKSUM_AT && i < HEADER_LENGTH)
            continue;
        sum1 = (uint8_t)(sum1 + bytes[i]);
        sum2 = (uint8_t)(sum2 + sum1);
    }
    const uint8_t *sent = bytes + CHECKSUM_AT;
    return (sent[0] == sum2 && sent[1] == sum1) || (sent[0] == sum1 && sent[1] == sum2);
}

static tracker_check_t check_packet(const uint8_t *bytes, size_t size)
{
    if (size < 4 || memcmp(bytes, "OTrk", 4) != 0)
        return TRACKER_OTHER;
    if (size < HEADER_LENGTH || size - HEADER_LENGTH != (packet_be16(bytes + 12) & (LAST_SEGMENT - 1)))
        return TRACKER_LENGTH;
    if (!checksum_is_right(bytes, size))
        return TRACKER_CHECKSUM;
    return bytes[5] == ENCODING_JSON || bytes[5] == ENCODING_CBOR ? TRACKER_OK : TRACKER_VERSION;
}

/* Does a packet carry on where the newest one has ended? Some number segments on, some give all of them one number. */
static bool continues(const opentrackio_memory_t *memory, const uint8_t *bytes)
{
    const uint16_t step = (uint16_t)(packet_be16(bytes + 6) - packet_be16(memory->newest + 6));
    return memory->length > 0 && packet_be32(bytes + 8) == memory->length && bytes[5] == memory->newest[5] && step <= 1;
}

/* Adds a segment to those before it. */
static tracker_check_t join(opentrackio_memory_t *memory, const uint8_t *bytes, size_t size)
{
    const bool first = packet_be32(bytes + 8) == 0;
    const bool fits = first || continues(memory, bytes);
    const size_t length = size - HEADER_LENGTH;
    if (first || !fits)
        memory->length = 0;
    if (!fits)
        return TRACKER_SEGMENT;
    if (length > sizeof memory->payload - memory->length) {
        memory->length = 0;
        return TRACKER_LENGTH;
    }
    memcpy(memory->payload + memory->length, bytes + HEADER_LENGTH, length);
    memory->length += length;
    return (packet_be16(bytes + 12) & LAST_SEGMENT) != 0 ? TRACKER_OK : TRACKER_UNFINISHED;
}

tracker_check_t opentrackio_decode(opentrackio_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes,
                                   size_t size)
{
    tracker_check_t check = check_packet(bytes, size);
    if (check != TRACKER_OK)
        return check;
    if (memory->any && memcmp(memory->newest, bytes, HEADER_LENGTH) == 0)
        return TRACKER_REPEATED;
    check = join(memory, bytes, size);
    memory->any = true;
    memcpy(memory->newest, bytes, HEADER_LENGTH);
    if (check != TRACKER_OK)
        return check;
    json_t *sample = bytes[5] == ENCODING_CBOR
                         ? cbor_json_read(memory->payload, memory->length)
                         : json_loadb((const char *)memory->payload, memory->length, JSON_REJECT_DUPLICATES, NULL);
    memory->length = 0;
    if (sample == NULL)
        return TRACKER_SYNTAX;
    check = opentrackio_sample_read(packet, sample);
    json_decref(sample);
    return check;
}
