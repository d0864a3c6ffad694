// SPDX-License-Identifier: Apache-2.0
// Packets as trackers send them, for tests: written from the protocols' specifications, apart from the decoders.
#ifndef TESTS_SUPPORT_TRACKER_PACKETS_H
#define TESTS_SUPPORT_TRACKER_PACKETS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TRACKER_PACKETS_LENGTH = 2048 };

typedef struct {
    uint8_t bytes[TRACKER_PACKETS_LENGTH];
    size_t size;
} tracker_bytes_t;

/** Add bytes at the end. */
void tracker_bytes_add(tracker_bytes_t *packet, const void *bytes, size_t size);

/** Add a number of so many bytes, lowest or highest first. */
void tracker_bytes_little(tracker_bytes_t *packet, uint64_t value, int bytes);
void tracker_bytes_big(tracker_bytes_t *packet, uint64_t value, int bytes);

/** FreeD D1 with its checksum. @param degrees  Pan, tilt, roll. */
tracker_bytes_t tracker_bytes_freed(uint8_t id, const double degrees[3], const double mm[3]);

/** Make a FreeD packet's checksum right again. */
void tracker_bytes_mend_freed(uint8_t *bytes, size_t size);

/** Of PosiStageNet: a chunk around what follows the place, which is the packet's size before. */
void tracker_bytes_chunk(tracker_bytes_t *packet, size_t place, uint16_t id, bool nested);

/** PosiStageNet 2 with one tracker that has position, orientation (a rotation vector) and status. */
tracker_bytes_t tracker_bytes_psn(uint64_t time_us, uint16_t id, const float metres[3], const float radians[3],
                                  float status);

/** One OpenTrackIO packet. */
typedef struct {
    uint8_t encoding; /**< 1 JSON, 2 CBOR */
    uint16_t sequence;
    uint32_t offset;
    bool last;
} tracker_bytes_segment_t;

tracker_bytes_t tracker_bytes_opentrackio(const tracker_bytes_segment_t *segment, const void *payload, size_t size);

/** Make an OpenTrackIO packet's length and checksum right again. */
void tracker_bytes_mend_opentrackio(uint8_t *bytes, size_t size);

/** An OSC message: the types are letters of i, f, d; each takes one of the values. */
tracker_bytes_t tracker_bytes_osc(const char *address, const char *types, const double *value);

/** Begin an OSC bundle with a time tag (1 is "immediately"), and add a message to it. */
tracker_bytes_t tracker_bytes_bundle(uint64_t time_tag);
void tracker_bytes_bundle_add(tracker_bytes_t *bundle, const tracker_bytes_t *message);

#endif
