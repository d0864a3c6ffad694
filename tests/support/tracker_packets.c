// SPDX-License-Identifier: Apache-2.0
// Packets as trackers send them, for tests: written from the protocols' specifications, apart from the decoders.
#include "tests/support/tracker_packets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void tracker_bytes_add(tracker_bytes_t *packet, const void *bytes, size_t size)
{
    if (size > sizeof packet->bytes - packet->size)
        abort();
    if (size > 0)
        memcpy(packet->bytes + packet->size, bytes, size);
    packet->size += size;
}

void tracker_bytes_little(tracker_bytes_t *packet, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        tracker_bytes_add(packet, &(uint8_t){(uint8_t)(value >> 8 * i)}, 1);
}

void tracker_bytes_big(tracker_bytes_t *packet, uint64_t value, int bytes)
{
    for (int i = bytes - 1; i >= 0; i--)
        tracker_bytes_add(packet, &(uint8_t){(uint8_t)(value >> 8 * i)}, 1);
}

void tracker_bytes_mend_freed(uint8_t *bytes, size_t size)
{
    uint8_t rest = 0x40;
    for (size_t i = 0; i + 1 < size; i++)
        rest = (uint8_t)(rest - bytes[i]);
    bytes[size - 1] = rest;
}

tracker_bytes_t tracker_bytes_freed(uint8_t id, const double degrees[3], const double mm[3])
{
    tracker_bytes_t packet = {.bytes = {0xD1, id}, .size = 2};
    for (int i = 0; i < 3; i++)
        tracker_bytes_big(&packet, (uint64_t)llround(degrees[i] * 32768.0), 3);
    for (int i = 0; i < 3; i++)
        tracker_bytes_big(&packet, (uint64_t)llround(mm[i] * 64.0), 3);
    tracker_bytes_big(&packet, 0, 8); /* zoom, focus, user defined */
    tracker_bytes_big(&packet, 0, 1);
    tracker_bytes_mend_freed(packet.bytes, packet.size);
    return packet;
}

void tracker_bytes_chunk(tracker_bytes_t *packet, size_t place, uint16_t id, bool nested)
{
    tracker_bytes_t head = {.size = 0};
    tracker_bytes_little(&head, id | (packet->size - place) << 16 | (nested ? UINT64_C(1) << 31 : 0), 4);
    tracker_bytes_add(packet, head.bytes, head.size); /* makes the room */
    memmove(packet->bytes + place + head.size, packet->bytes + place, packet->size - place - head.size);
    memcpy(packet->bytes + place, head.bytes, head.size);
}

static void add_floats(tracker_bytes_t *packet, uint16_t id, const float *value, int count)
{
    const size_t place = packet->size;
    for (int i = 0; i < count; i++) {
        uint32_t bits = 0;
        memcpy(&bits, &value[i], sizeof bits);
        tracker_bytes_little(packet, bits, 4);
    }
    tracker_bytes_chunk(packet, place, id, false);
}

tracker_bytes_t tracker_bytes_psn(uint64_t time_us, uint16_t id, const float metres[3], const float radians[3],
                                  float status)
{
    tracker_bytes_t packet = {.size = 0};
    tracker_bytes_little(&packet, time_us, 8);
    tracker_bytes_add(&packet, (const uint8_t[]){2, 0, 9, 1}, 4);
    tracker_bytes_chunk(&packet, 0, 0x0000, false);
    const size_t list = packet.size;
    add_floats(&packet, 0x0000, metres, 3);
    add_floats(&packet, 0x0001, (const float[]){9.0F, 9.0F, 9.0F}, 3);
    add_floats(&packet, 0x0002, radians, 3);
    add_floats(&packet, 0x0003, &status, 1);
    tracker_bytes_chunk(&packet, list, id, true);
    tracker_bytes_chunk(&packet, list, 0x0001, true);
    tracker_bytes_chunk(&packet, 0, 0x6755, true);
    return packet;
}

void tracker_bytes_mend_opentrackio(uint8_t *bytes, size_t size)
{
    const size_t length = size - 16;
    bytes[12] = (uint8_t)((bytes[12] & 0x80) | (length >> 8 & 0x7F));
    bytes[13] = (uint8_t)length;
    uint8_t sum1 = 0, sum2 = 0;
    for (size_t i = 0; i < size; i++) {
        if (i == 14 || i == 15)
            continue;
        sum1 = (uint8_t)(sum1 + bytes[i]);
        sum2 = (uint8_t)(sum2 + sum1);
    }
    bytes[14] = sum2;
    bytes[15] = sum1;
}

tracker_bytes_t tracker_bytes_opentrackio(const tracker_bytes_segment_t *segment, const void *payload, size_t size)
{
    tracker_bytes_t packet = {.size = 0};
    tracker_bytes_add(&packet, "OTrk", 5); /* the reserved byte is 0 */
    tracker_bytes_big(&packet, segment->encoding, 1);
    tracker_bytes_big(&packet, segment->sequence, 2);
    tracker_bytes_big(&packet, segment->offset, 4);
    tracker_bytes_big(&packet, segment->last ? 0x8000 : 0, 2);
    tracker_bytes_big(&packet, 0, 2);
    tracker_bytes_add(&packet, payload, size);
    tracker_bytes_mend_opentrackio(packet.bytes, packet.size);
    return packet;
}

/* Texts of OSC end with one to four zeros, so that their length is a multiple of four. */
static void add_text(tracker_bytes_t *packet, const char *text)
{
    tracker_bytes_add(packet, text, strlen(text));
    tracker_bytes_little(packet, 0, 4 - (int)(strlen(text) % 4));
}

tracker_bytes_t tracker_bytes_osc(const char *address, const char *types, const double *value)
{
    tracker_bytes_t packet = {.size = 0};
    char tags[64] = ",";
    strncat(tags, types, sizeof tags - 2);
    add_text(&packet, address);
    add_text(&packet, tags);
    for (; *types != '\0'; types++, value++) {
        const float single = (float)*value;
        uint64_t bits = 0;
        uint32_t single_bits = 0;
        memcpy(&bits, value, sizeof bits);
        memcpy(&single_bits, &single, sizeof single_bits);
        if (*types == 'd')
            tracker_bytes_big(&packet, bits, 8);
        else if (*types == 'f')
            tracker_bytes_big(&packet, single_bits, 4);
        else
            tracker_bytes_big(&packet, (uint32_t)(int32_t)*value, 4);
    }
    return packet;
}

tracker_bytes_t tracker_bytes_bundle(uint64_t time_tag)
{
    tracker_bytes_t bundle = {.size = 0};
    tracker_bytes_add(&bundle, "#bundle", 8);
    tracker_bytes_big(&bundle, time_tag, 8);
    return bundle;
}

void tracker_bytes_bundle_add(tracker_bytes_t *bundle, const tracker_bytes_t *message)
{
    tracker_bytes_big(bundle, message->size, 4);
    tracker_bytes_add(bundle, message->bytes, message->size);
}
