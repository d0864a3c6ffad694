// SPDX-License-Identifier: Apache-2.0
// What every tracker protocol's decoder makes of a packet: poses, or the reason why not.
#ifndef SIM_TRACKERS_TRACKER_H
#define SIM_TRACKERS_TRACKER_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_protocol.h"

enum { TRACKER_MAX_POSES = 64, TRACKER_MAX_PACKET = 65536 };

/** What became of a packet, or of one body in it. Every one but TRACKER_OK means: no pose. */
typedef enum {
    TRACKER_OK = 0,
    TRACKER_OTHER,      /**< sound, but a message that carries no poses, or not of this protocol at all */
    TRACKER_UNFINISHED, /**< one segment of several; the pose comes with the last one */
    TRACKER_LENGTH,     /**< shorter or longer than it must be, or than it says */
    TRACKER_CHECKSUM,   /**< damaged */
    TRACKER_VERSION,    /**< another version of the protocol, or another encoding */
    TRACKER_SYNTAX,     /**< not built as the protocol says */
    TRACKER_SEGMENT,    /**< a segment is missing before this one */
    TRACKER_REPEATED,   /**< the same again, or older than what has come */
    TRACKER_VALUE,      /**< a number is not finite or out of range, or the orientation is not one */
    TRACKER_INCOMPLETE, /**< a body without position or without orientation */
    TRACKER_CROWDED,    /**< a sound body, but one more than TRACKER_MAX_POSES */
    TRACKER_CHECKS
} tracker_check_t;

/** In a few words, such as "wrong checksum". */
extern const char *const tracker_check_text[TRACKER_CHECKS];

/** One body, in the tracker's own axes and unit. */
typedef struct {
    uint32_t id; /**< as the protocol numbers bodies or cameras */
    double position[3];
    double quaternion[4]; /**< w, x, y, z: turns the body's vectors into the tracker's; of unit length */
    can_pose_quality_t quality;
    bool timed;      /**< has a capture time */
    int64_t time_us; /**< of capture, on the tracker's own clock; 0 to 2^60 */
} tracker_pose_t;

/** The poses of one packet. */
typedef struct {
    tracker_pose_t pose[TRACKER_MAX_POSES];
    int count;
    uint32_t left_out[TRACKER_CHECKS]; /**< bodies that gave no pose, by reason */
} tracker_packet_t;

/**
 * Add a body, if it is sound: numbers finite, position within +-10^9, quaternion within 1 % of unit length (it is then
 * made exactly that), time within its range. Of a lost body only the id and the time count: position and quaternion are
 * set to zero and identity.
 *
 * What is not sound is counted in left_out[TRACKER_VALUE], what is beyond TRACKER_MAX_POSES in [TRACKER_CROWDED].
 */
void tracker_packet_add(tracker_packet_t *packet, const tracker_pose_t *pose);

#endif
