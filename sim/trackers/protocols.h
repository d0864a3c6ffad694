// SPDX-License-Identifier: Apache-2.0
// The tracker protocols by name.
#ifndef SIM_TRACKERS_PROTOCOLS_H
#define SIM_TRACKERS_PROTOCOLS_H

#include <stddef.h>

#include "sim/trackers/opentrackio.h"

/** What a stream's decoder remembers from packet to packet. Zero before the first one. */
typedef struct {
    opentrackio_memory_t opentrackio;
} tracker_memory_t;

/** Decode one packet into an empty struct, which holds poses when TRACKER_OK is returned. See each decoder's header. */
typedef tracker_check_t tracker_decode_fn(tracker_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes,
                                          size_t size);

typedef struct {
    const char *name;   /**< on the command line */
    const char *what;   /**< in a few words */
    const char *listen; /**< ADDR:PORT where its packets usually arrive */
    double unit_mm;     /**< of its positions, unless the transform file says otherwise */
    tracker_decode_fn *decode;
} tracker_protocol_t;

enum { TRACKER_PROTOCOLS = 5 };

extern const tracker_protocol_t tracker_protocols[TRACKER_PROTOCOLS];

/** @return The protocol of that name, or NULL. */
const tracker_protocol_t *tracker_protocol_named(const char *name);

#endif
