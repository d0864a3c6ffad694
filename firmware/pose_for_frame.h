// SPDX-License-Identifier: Apache-2.0
// Pose history and a picture's times -> the pose and the camera that the picture is mapped with.
//
// POSES.md has the geometry. In short: the orientation is the one that the picture was drawn with, or the world swims
// on the wall whenever the head turns; the eye is where the viewer will be when the picture is shown, as far as the
// content's distance is known.
#ifndef FIRMWARE_POSE_FOR_FRAME_H
#define FIRMWARE_POSE_FOR_FRAME_H

#include "firmware/frame_tag.h"
#include "firmware/pose_history.h"
#include "firmware/pose_predict.h"

/** How the board knows which pose a picture was drawn with. */
typedef enum {
    POSE_FOR_FRAME_LATEST = 0, /**< the newest; right only for an engine without latency, or a picture nailed to the
                                    head */
    POSE_FOR_FRAME_DELAY,      /**< the one of a known time before the picture came */
    POSE_FOR_FRAME_TAG         /**< the picture says when the pose was captured */
} pose_for_frame_mode_t;

/** Where the drawn world is, as far as moving the eye is concerned. */
typedef enum {
    POSE_FOR_FRAME_WALL = 0, /**< on the wall: moving the eye moves nothing */
    POSE_FOR_FRAME_DEPTH,    /**< on a plane before the drawn camera, at a depth */
    POSE_FOR_FRAME_FAR       /**< far away */
} pose_for_frame_content_t;

/** How an installation is set up. */
typedef struct {
    pose_for_frame_mode_t mode;
    pose_for_frame_content_t content;
    int64_t depth_um;  /**< for POSE_FOR_FRAME_DEPTH: > 0, < 2^40 */
    int64_t render_us; /**< from the capture of a pose to the arrival of the picture that was drawn with it, 0 to 10^6.
                            With tags, it stands in for a lost one */
} pose_for_frame_rule_t;

/** One picture. All times on the clock of the pose history. */
typedef struct {
    int64_t picture_us; /**< when it arrived */
    int64_t shown_us;   /**< when it will be shown: half a frame after the vertical blank is the middle of the panel */
    bool tagged;        /**< it has a tag that could be read; */
    frame_tag_t tag;    /**< which has the capture time of the pose that it was drawn with; of this viewer */
    uint64_t wrap_us;   /**< of that time: CAN_POSE_FD_WRAP_US or CAN_POSE_SET_WRAP_US */
} pose_for_frame_picture_t;

/** What to map the picture with. */
typedef struct {
    pose_t pose;      /**< for homography_from_pose(), together with */
    camera_t camera;  /**< this; it is the picture's own but for content at a depth */
    pose_at_t drawn;  /**< what the picture was drawn with; between two poses the older one's counter */
    bool drawn_known; /**< false: the rule could not be followed (no tag, or its pose is not in the history), and the
                           next best one was */
} pose_for_frame_t;

/**
 * Choose. O(poses in the history), no state.
 *
 * A lost or unknown tag falls back to `delay`; a time before the history to its oldest pose; a viewer who has reached
 * the content's plane (camera_for_content.h) to content on the wall.
 *
 * @param[out] chosen  Written only when true is returned.
 * @return false when no pose has come yet.
 */
bool pose_for_frame(pose_for_frame_t *chosen, const pose_history_t *history, const camera_t *camera,
                    const pose_for_frame_rule_t *rule, const pose_for_frame_picture_t *picture);

#endif
