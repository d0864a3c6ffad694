// SPDX-License-Identifier: Apache-2.0
// The key `frames` of a room file: refresh rate, and which pose and picture belong together.
#include "firmware/room/room_frames.h"

#include <math.h>
#include <stdio.h>

#include "firmware/frame_tag.h"

enum { LEAST_HZ = 24, MOST_HZ = 240, MOST_LATENCY_MS = 200 };

static const double rate_tolerance_hz = 0.005;

static bool refuse_number(const room_checker_t *checker, const char *key, double found, const char *expected)
{
    return room_refuse(checker->report, room_places_line(checker->places, key), key, "found %.12g, expected %s", found,
                       expected);
}

/* Whole, or a whole number less a thousandth part: 59.94 is 60000 / 1001. */
static bool check_rate(const room_checker_t *checker, const double *yaml_hz, frame_rate_t *rate)
{
    const double hz = yaml_hz == NULL ? 60 : *yaml_hz;
    for (int32_t whole = LEAST_HZ; whole <= MOST_HZ; whole++) {
        if (fabs(hz - whole) < rate_tolerance_hz) {
            *rate = (frame_rate_t){whole, 1};
            return true;
        }
        if (fabs(hz - whole / 1.001) < rate_tolerance_hz) {
            *rate = (frame_rate_t){whole * 1000, 1001};
            return true;
        }
    }
    return refuse_number(checker, "frames.refresh_hz", hz, "24 to 240, whole or like 59.94");
}

/* A number that may be left out, in thousandths. */
static bool check_thousandths(const room_checker_t *checker, const char *key, const double *yaml, double most,
                              int64_t *stored)
{
    if (yaml == NULL)
        return true;
    if (!(*yaml >= 0.0 && *yaml <= most)) {
        char expected[64];
        snprintf(expected, sizeof expected, "0 to %.0f", most);
        return refuse_number(checker, key, *yaml, expected);
    }
    *stored = llround(*yaml * 1000.0);
    return true;
}

static bool check_rule(const room_checker_t *checker, const room_yaml_frames_t *yaml, room_t *room)
{
    pose_for_frame_rule_t *rule = &room->rule;
    frame_tag_layout_t layout;
    *rule = (pose_for_frame_rule_t){.mode = (pose_for_frame_mode_t)yaml->pose,
                                    .content = (pose_for_frame_content_t)yaml->content};
    if (!check_thousandths(checker, "frames.render_ms", yaml->render_ms, 1000.0, &rule->render_us) ||
        !check_thousandths(checker, "frames.depth_mm", yaml->depth_mm, 1e6, &rule->depth_um))
        return false;
    if (rule->content == POSE_FOR_FRAME_DEPTH && rule->depth_um == 0)
        return room_refuse(checker->report, room_places_line(checker->places, "frames.content"), "frames.content",
                           "found depth without a depth_mm above 0, expected how far off the content is");
    if (rule->mode == POSE_FOR_FRAME_TAG && !frame_tag_layout(&layout, room->camera.width, room->camera.height))
        return room_refuse(checker->report, room_places_line(checker->places, "frames.pose"), "frames.pose",
                           "found tag, expected a camera whose pictures have room for it: see frame_tag.h");
    return true;
}

bool room_frames_check(const room_checker_t *checker, const room_yaml_frames_t *yaml, room_t *room)
{
    _Static_assert((int)ROOM_YAML_POSE_TAG == (int)POSE_FOR_FRAME_TAG, "the same order");
    _Static_assert((int)ROOM_YAML_CONTENT_FAR == (int)POSE_FOR_FRAME_FAR, "the same order");
    int64_t pose_delay_us = 2000, latency_us = 0;
    if (!check_rate(checker, yaml->refresh_hz, &room->refresh) ||
        !check_thousandths(checker, "frames.pose_delay_ms", yaml->pose_delay_ms, 50.0, &pose_delay_us) ||
        !check_thousandths(checker, "frames.latency_ms", yaml->latency_ms, MOST_LATENCY_MS, &latency_us))
        return false;
    room->refresh_stated = yaml->refresh_hz != NULL;
    room->pose_delay_us = (int32_t)pose_delay_us;
    room->latency_ms = (int32_t)((latency_us + 999) / 1000);
    return check_rule(checker, yaml, room);
}
