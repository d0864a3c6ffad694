// SPDX-License-Identifier: Apache-2.0
// A.R.T. DTrack: its ASCII output over UDP -> poses of the standard 6DOF bodies.
#include "sim/trackers/dtrack.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/trackers/tracker_rotation.h"

enum { LONGEST_NUMBER = 31, MATRIX_NUMBERS = 9 };

static const double day_s = 86400.0, most_whole = 4294967295.0;

/* What is left of a line. */
typedef struct {
    const char *at, *end;
} cursor_t;

static void skip_spaces(cursor_t *cursor)
{
    while (cursor->at < cursor->end && *cursor->at == ' ')
        cursor->at++;
}

static bool take(cursor_t *cursor, char expected)
{
    skip_spaces(cursor);
    if (cursor->at == cursor->end || *cursor->at != expected)
        return false;
    cursor->at++;
    return true;
}

static bool take_word(cursor_t *cursor, const char *word)
{
    const size_t length = strlen(word);
    if ((size_t)(cursor->end - cursor->at) <= length || memcmp(cursor->at, word, length) != 0 ||
        cursor->at[length] != ' ')
        return false;
    cursor->at += length;
    return true;
}

/* strtod() alone would also take hexadecimal, nan and inf. */
static bool take_number(cursor_t *cursor, double *value)
{
    char text[LONGEST_NUMBER + 1];
    size_t length = 0;
    skip_spaces(cursor);
    while (cursor->at < cursor->end && *cursor->at != '\0' && strchr("+-.0123456789eE", *cursor->at) != NULL) {
        if (length == LONGEST_NUMBER)
            return false;
        text[length++] = *cursor->at++;
    }
    text[length] = '\0';
    char *end = NULL;
    *value = strtod(text, &end);
    return length > 0 && *end == '\0';
}

static bool take_whole(cursor_t *cursor, uint32_t *value)
{
    double number = 0.0;
    if (!take_number(cursor, &number) || !(number >= 0.0 && number <= most_whole) || number != floor(number))
        return false;
    *value = (uint32_t)number;
    return true;
}

/* "[" and so many numbers and "]" */
static bool take_block(cursor_t *cursor, double *number, int count)
{
    if (!take(cursor, '['))
        return false;
    for (int i = 0; i < count; i++)
        if (!take_number(cursor, &number[i]))
            return false;
    return take(cursor, ']');
}

static bool at_end(cursor_t *cursor)
{
    skip_spaces(cursor);
    return cursor->at == cursor->end;
}

/* Lost bodies have a matrix of zeros. */
static void add_body(tracker_packet_t *packet, tracker_pose_t *pose, const double place[3],
                     const double b[MATRIX_NUMBERS])
{
    const double matrix[3][3] = {{b[0], b[3], b[6]}, {b[1], b[4], b[7]}, {b[2], b[5], b[8]}};
    memcpy(pose->position, place, sizeof pose->position);
    if (pose->quality == CAN_POSE_LOST || tracker_rotation_from_matrix(pose->quaternion, matrix))
        tracker_packet_add(packet, pose);
    else
        packet->left_out[TRACKER_VALUE]++;
}

/* The bodies of a line, after its identifier: extended is 6di. */
static bool take_bodies(cursor_t *cursor, tracker_packet_t *packet, bool extended)
{
    static const can_pose_quality_t quality[4] = {CAN_POSE_LOST, CAN_POSE_PREDICTED, CAN_POSE_TRACKED,
                                                  CAN_POSE_TRACKED};
    uint32_t count = 0;
    if (!take_whole(cursor, &count))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        double head[3] = {0.0}, place[6], matrix[MATRIX_NUMBERS];
        if (!take_block(cursor, head, extended ? 3 : 2) || !take_block(cursor, place, extended ? 3 : 6) ||
            !take_block(cursor, matrix, MATRIX_NUMBERS))
            return false;
        const double id = head[0], state = extended ? head[1] : 2.0;
        if (!(id >= 0.0 && id <= most_whole) || !(state >= 0.0 && state <= 3.0))
            return false;
        tracker_pose_t pose = {.id = (uint32_t)id, .quality = quality[(int)state]};
        add_body(packet, &pose, place, matrix);
    }
    return at_end(cursor);
}

/* What a packet has said so far. */
typedef struct {
    double seconds;
    bool timed, bodies, extended;
} heard_t;

static bool take_line(cursor_t line, tracker_packet_t *packet, heard_t *heard)
{
    if (take_word(&line, "ts")) {
        heard->timed = true;
        return take_number(&line, &heard->seconds) && at_end(&line) && heard->seconds >= 0.0 && heard->seconds <= day_s;
    }
    const bool extended = take_word(&line, "6di");
    if (!extended && (heard->extended || !take_word(&line, "6d")))
        return true;
    if (extended)
        memset(packet, 0, sizeof *packet);
    heard->bodies = true;
    heard->extended |= extended;
    return take_bodies(&line, packet, extended);
}

static cursor_t next_line(cursor_t *rest)
{
    const char *feed = memchr(rest->at, '\n', (size_t)(rest->end - rest->at));
    cursor_t line = {rest->at, feed == NULL ? rest->end : feed};
    rest->at = feed == NULL ? rest->end : feed + 1;
    if (line.end > line.at && line.end[-1] == '\r')
        line.end--;
    return line;
}

tracker_check_t dtrack_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size)
{
    cursor_t rest = {(const char *)bytes, (const char *)bytes + size};
    cursor_t first = next_line(&rest);
    uint32_t frame = 0;
    if (!take_word(&first, "fr") || !take_whole(&first, &frame) || !at_end(&first))
        return TRACKER_SYNTAX;
    heard_t heard = {.timed = false};
    while (rest.at < rest.end)
        if (!take_line(next_line(&rest), packet, &heard))
            return TRACKER_SYNTAX;
    for (int i = 0; heard.timed && i < packet->count; i++) {
        packet->pose[i].timed = true;
        packet->pose[i].time_us = llround(heard.seconds * 1e6);
    }
    return heard.bodies ? TRACKER_OK : TRACKER_OTHER;
}
