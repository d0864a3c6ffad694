// SPDX-License-Identifier: Apache-2.0
// The tracker protocols by name.
#include "sim/trackers/protocols.h"

#include <string.h>

#include "sim/trackers/dtrack.h"
#include "sim/trackers/freed.h"
#include "sim/trackers/osc.h"
#include "sim/trackers/posistagenet.h"

static tracker_check_t decode_freed(tracker_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes,
                                    size_t size)
{
    (void)memory;
    return freed_decode(packet, bytes, size);
}

static tracker_check_t decode_dtrack(tracker_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes,
                                     size_t size)
{
    (void)memory;
    return dtrack_decode(packet, bytes, size);
}

static tracker_check_t decode_posistagenet(tracker_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes,
                                           size_t size)
{
    (void)memory;
    return posistagenet_decode(packet, bytes, size);
}

static tracker_check_t decode_opentrackio(tracker_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes,
                                          size_t size)
{
    return opentrackio_decode(&memory->opentrackio, packet, bytes, size);
}

static tracker_check_t decode_osc(tracker_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes, size_t size)
{
    (void)memory;
    return osc_decode(packet, bytes, size);
}

const tracker_protocol_t tracker_protocols[TRACKER_PROTOCOLS] = {
    {"freed", "FreeD, message D1", "0.0.0.0:40000", 1.0, decode_freed},
    {"dtrack", "A.R.T. DTrack, ASCII output", "0.0.0.0:5000", 1.0, decode_dtrack},
    {"psn", "PosiStageNet 2", "236.10.10.10:56565", 1000.0, decode_posistagenet},
    {"opentrackio", "OpenTrackIO 1.0.1, JSON or CBOR", "239.135.1.1:55555", 1000.0, decode_opentrackio},
    {"osc", "Open Sound Control, /pose x y z qw qx qy qz", "0.0.0.0:9000", 1000.0, decode_osc},
};

const tracker_protocol_t *tracker_protocol_named(const char *name)
{
    for (int i = 0; i < TRACKER_PROTOCOLS; i++)
        if (strcmp(tracker_protocols[i].name, name) == 0)
            return &tracker_protocols[i];
    return NULL;
}
