// SPDX-License-Identifier: Apache-2.0
// Made-up motions of a viewer, as pose lists.
#ifndef SIM_POSE_MOTION_H
#define SIM_POSE_MOTION_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/pose/pose_list.h"

/** All start at one pose, and move along that pose's own axes (right, down, forward): it fits any room. */
typedef enum {
    MOTION_STILL, /**< stays there */
    MOTION_WALK, /**< 1 m to each side at up to 1.4 m/s, bobbing by 30 mm twice a second, the head turning by 20 degrees
                  */
    MOTION_ORBIT, /**< a circle of 1 m around the point 1 m ahead, which stays in the middle of the view; 10 s a turn */
    MOTION_NOISE, /**< still, with normal noise on each sample: 0.5 mm and 0.05 degrees (one deviation) along each axis
                   */
    MOTIONS
} motion_kind_t;

/** As the command line calls them: "still", ... */
extern const char *const motion_names[MOTIONS];

typedef struct {
    motion_kind_t kind;
    pose_t start;
    double rate_hz;    /**< poses a second, 0.1 to 2000 */
    double duration_s; /**< 0 to 3600: there is a pose at its begin, and none at its end */
    uint64_t seed;     /**< of the noise */
} motion_t;

/**
 * Make the list, from time 0 on.
 *
 * @param[out] list  Written only when true is returned; free it with pose_list_free().
 * @return false when there is no memory.
 */
bool motion_make(pose_list_t *list, const motion_t *motion);

#endif
