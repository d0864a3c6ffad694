// SPDX-License-Identifier: Apache-2.0
// PosiStageNet 2: data packets -> poses of their trackers.
#include "sim/trackers/posistagenet.h"

#include "sim/trackers/packet_bytes.h"
#include "sim/trackers/tracker_rotation.h"

enum { DATA_PACKET = 0x6755, HEADER = 0x0000, TRACKER_LIST = 0x0001, VERSION_HIGH = 2 };
enum { POSITION = 0x0000, ORIENTATION = 0x0002, STATUS = 0x0003, TIMESTAMP = 0x0006 };
enum { HEAD_LENGTH = 4, HEADER_LENGTH = 12, VECTOR_LENGTH = 12, STATUS_LENGTH = 4, TIME_LENGTH = 8 };

/* A run of chunks. */
typedef struct {
    const uint8_t *bytes;
    size_t size;
} chunks_t;

typedef struct {
    uint32_t id;
    bool nested;
    chunks_t inside;
} chunk_t;

/* Takes the first chunk off. */
static bool next_chunk(chunks_t *chunks, chunk_t *chunk)
{
    if (chunks->size < HEAD_LENGTH)
        return false;
    const uint32_t head = packet_le32(chunks->bytes);
    const size_t length = head >> 16 & 0x7FFF;
    if (length > chunks->size - HEAD_LENGTH)
        return false;
    *chunk = (chunk_t){head & 0xFFFF, head >> 31 != 0, {chunks->bytes + HEAD_LENGTH, length}};
    chunks->bytes += HEAD_LENGTH + length;
    chunks->size -= HEAD_LENGTH + length;
    return true;
}

static void read_vector(double vector[3], const uint8_t *bytes)
{
    for (int i = 0; i < 3; i++)
        vector[i] = (double)packet_le_float(bytes + 4 * i);
}

/* From 2^63 on it becomes negative, and is refused as a value. */
static int64_t time_from(const uint8_t *bytes)
{
    return (int64_t)packet_le64(bytes);
}

/* What a tracker's chunks have said so far. */
typedef struct {
    tracker_pose_t pose;
    bool position, orientation;
} heard_t;

static bool take_field(heard_t *heard, const chunk_t *field)
{
    const uint8_t *bytes = field->inside.bytes;
    const size_t length = field->inside.size;
    double vector[3];
    switch (field->id) {
    case POSITION:
        if (length != VECTOR_LENGTH)
            return false;
        read_vector(heard->pose.position, bytes);
        heard->position = true;
        return true;
    case ORIENTATION:
        if (length != VECTOR_LENGTH)
            return false;
        read_vector(vector, bytes);
        tracker_rotation_from_vector(heard->pose.quaternion, vector);
        heard->orientation = true;
        return true;
    case STATUS:
        if (length != STATUS_LENGTH)
            return false;
        heard->pose.quality = packet_le_float(bytes) > 0.0F ? CAN_POSE_TRACKED : CAN_POSE_LOST;
        return true;
    case TIMESTAMP:
        if (length != TIME_LENGTH)
            return false;
        heard->pose.time_us = time_from(bytes);
        return true;
    default:
        return true;
    }
}

static tracker_check_t take_tracker(tracker_packet_t *packet, const chunk_t *tracker, int64_t time_us)
{
    heard_t heard = {.pose = {.id = tracker->id, .quality = CAN_POSE_TRACKED, .timed = true, .time_us = time_us}};
    chunks_t fields = tracker->inside;
    if (!tracker->nested && fields.size > 0)
        return TRACKER_SYNTAX;
    while (fields.size > 0) {
        chunk_t field;
        if (!next_chunk(&fields, &field) || !take_field(&heard, &field))
            return TRACKER_LENGTH;
    }
    if (heard.pose.quality == CAN_POSE_LOST || (heard.position && heard.orientation))
        tracker_packet_add(packet, &heard.pose);
    else
        packet->left_out[TRACKER_INCOMPLETE]++;
    return TRACKER_OK;
}

static tracker_check_t take_list(tracker_packet_t *packet, const chunk_t *list, int64_t time_us)
{
    chunks_t trackers = list->inside;
    if (!list->nested && trackers.size > 0)
        return TRACKER_SYNTAX;
    while (trackers.size > 0) {
        chunk_t tracker;
        if (!next_chunk(&trackers, &tracker))
            return TRACKER_LENGTH;
        const tracker_check_t check = take_tracker(packet, &tracker, time_us);
        if (check != TRACKER_OK)
            return check;
    }
    return TRACKER_OK;
}

tracker_check_t posistagenet_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size)
{
    chunks_t all = {bytes, size};
    if (size < HEAD_LENGTH)
        return TRACKER_LENGTH;
    if ((packet_le32(bytes) & 0xFFFF) != DATA_PACKET)
        return TRACKER_OTHER;
    chunk_t data, header;
    if (!next_chunk(&all, &data) || all.size != 0)
        return TRACKER_LENGTH;
    if (!data.nested || !next_chunk(&data.inside, &header) || header.id != HEADER)
        return TRACKER_SYNTAX;
    if (header.inside.size != HEADER_LENGTH)
        return TRACKER_LENGTH;
    if (header.inside.bytes[8] != VERSION_HIGH)
        return TRACKER_VERSION;
    const int64_t time_us = time_from(header.inside.bytes);
    while (data.inside.size > 0) {
        chunk_t chunk;
        if (!next_chunk(&data.inside, &chunk))
            return TRACKER_LENGTH;
        if (chunk.id != TRACKER_LIST)
            continue;
        const tracker_check_t check = take_list(packet, &chunk, time_us);
        if (check != TRACKER_OK)
            return check;
    }
    return TRACKER_OK;
}
