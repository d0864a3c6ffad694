// SPDX-License-Identifier: Apache-2.0
// CBOR -> the values that jansson makes of JSON, so that one reader serves both.
//
// Source: RFC 8949. libcbor's streaming decoder does the bytes: it takes no memory, whatever length an item claims.
#ifndef SIM_TRACKERS_CBOR_JSON_H
#define SIM_TRACKERS_CBOR_JSON_H

#include <stddef.h>
#include <stdint.h>

#include <jansson.h>

enum { CBOR_JSON_MAX_DEPTH = 16 };

/**
 * Read one whole value. Uses the heap, by what the bytes hold and not by what they claim.
 *
 * Taken are maps with texts as keys, arrays, texts, integers up to 2^63 - 1, finite numbers, true, false, null. Refused
 * is what JSON cannot say: byte strings, other keys, undefined, NaN; and texts in pieces, a key twice, values more than
 * CBOR_JSON_MAX_DEPTH deep. Tags are passed over.
 *
 * @return The value, for json_decref(); NULL when the bytes are not exactly one such value.
 */
json_t *cbor_json_read(const uint8_t *bytes, size_t size);

#endif
