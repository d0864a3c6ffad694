// SPDX-License-Identifier: Apache-2.0
// OpenTrackIO 1.0.1 over UDP: packets, joined where a sample comes in segments -> poses.
//
// Source: SMPTE RIS-OSVP, OpenTrackIO Documentation v1.0.1: "Packet Header" and "IP Addressing". UDP multicast
// 239.135.1.SOURCE:55555 (before 1.0.1: 235.135.1.SOURCE). Header of 16 bytes, most significant byte first; then the
// payload, a sample or a segment of one:
//   0 "OTrk"   4 reserved   5 encoding: 1 JSON, 2 CBOR   6 uint16 sequence number   8 uint32 segment offset
//   12 uint16: the highest bit marks the last segment, the others are the payload's length   14 uint16 checksum
// The checksum is Fletcher's of 16 bits with sums modulo 256 (before 1.0.1: 255, not accepted), over the header without
// the checksum, and the payload. The published texts differ in which sum is the high byte: both orders are accepted.
#ifndef SIM_TRACKERS_OPENTRACKIO_H
#define SIM_TRACKERS_OPENTRACKIO_H

#include <stddef.h>

#include "sim/trackers/tracker.h"

/** What must be remembered from one packet to the next. Zero before the first one. Its fields are the decoder's own. */
typedef struct {
    bool any;           /**< a packet has come */
    uint8_t newest[16]; /**< its header: a packet is a repetition when its header is the same */
    size_t length;      /**< of the segments that have come; 0 when none is waiting for more */
    uint8_t payload[TRACKER_MAX_PACKET];
} opentrackio_memory_t;

/**
 * Uses the heap (jansson's), and gives it back before it returns.
 *
 * @param[in,out] memory  Of this stream. A segment that does not continue the ones before discards them.
 * @param[in,out] packet  Empty; gets one pose in m when TRACKER_OK is returned. Else it is to be thrown away.
 * @return TRACKER_OK; TRACKER_UNFINISHED; TRACKER_OTHER (not "OTrk"); _LENGTH, _CHECKSUM, _VERSION (another encoding),
 *         _REPEATED, _SEGMENT; or what opentrackio_sample_read() says of the sample.
 */
tracker_check_t opentrackio_decode(opentrackio_memory_t *memory, tracker_packet_t *packet, const uint8_t *bytes,
                                   size_t size);

#endif
