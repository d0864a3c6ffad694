// SPDX-License-Identifier: Apache-2.0
// Open Sound Control: messages of one address pattern -> poses. Messages are read by liblo.
#include "sim/trackers/osc.h"

#include <stdlib.h>
#include <string.h>

#include <lo/lo.h>

#include "sim/trackers/packet_bytes.h"

enum { BUNDLE_HEAD = 16, SIZE_LENGTH = 4, ALIGNMENT = 4, NUMBERS = 7, MOST_ID_DIGITS = 9 };

static const char address[] = "/pose";
static const char bundle_name[8] = "#bundle";
static const uint64_t immediately = 1, us_per_s = 1000000;

/* Ours is "/pose" or "/pose/" and digits. */
static bool read_address(const char *path, bool *with_id, uint32_t *id)
{
    const size_t length = sizeof address - 1;
    if (strncmp(path, address, length) != 0)
        return false;
    path += length;
    *with_id = *path == '/';
    *id = 0;
    if (!*with_id)
        return *path == '\0';
    const size_t digits = strspn(path + 1, "0123456789");
    if (digits == 0 || digits > MOST_ID_DIGITS || path[1 + digits] != '\0')
        return false;
    *id = (uint32_t)strtoul(path + 1, NULL, 10);
    return true;
}

/* liblo's arguments lie at multiples of four bytes, where no union of its own may be read; some types have no bytes. */
static bool read_number(char type, const void *argument, double *value)
{
    float single = 0.0F;
    if (type == LO_DOUBLE) {
        memcpy(value, argument, sizeof *value);
        return true;
    }
    if (type != LO_FLOAT)
        return false;
    memcpy(&single, argument, sizeof single);
    *value = (double)single;
    return true;
}

static bool read_whole(char type, const void *argument, int32_t highest, uint32_t *value)
{
    int32_t whole = 0;
    if (type != LO_INT32)
        return false;
    memcpy(&whole, argument, sizeof whole);
    *value = (uint32_t)whole;
    return whole >= 0 && whole <= highest;
}

/* The arguments as the header lists them; an id may lead where the address has none. */
static bool read_arguments(lo_message message, bool id_may_lead, tracker_pose_t *pose)
{
    const char *types = lo_message_get_types(message);
    lo_arg **argument = lo_message_get_argv(message);
    const int count = lo_message_get_argc(message);
    const int leading = id_may_lead && count > 0 && types[0] == LO_INT32;
    const int trailing = count - leading - NUMBERS;
    uint32_t quality = CAN_POSE_TRACKED;
    if (trailing < 0 || trailing > 1 || (leading == 1 && !read_whole(types[0], argument[0], INT32_MAX, &pose->id)) ||
        (trailing == 1 && !read_whole(types[count - 1], argument[count - 1], CAN_POSE_PREDICTED, &quality)))
        return false;
    pose->quality = (can_pose_quality_t)quality;
    double number[NUMBERS];
    for (int i = 0; i < NUMBERS; i++)
        if (!read_number(types[leading + i], argument[leading + i], &number[i]))
            return false;
    memcpy(pose->position, number, sizeof pose->position);
    memcpy(pose->quaternion, number + 3, sizeof pose->quaternion);
    return true;
}

/* liblo wants to write into what it reads: it gets a copy. */
static tracker_check_t take_message(tracker_packet_t *packet, const uint8_t *bytes, size_t size, tracker_pose_t pose)
{
    bool with_id = false;
    if (size == 0 || memchr(bytes, '\0', size) == NULL)
        return TRACKER_SYNTAX;
    if (!read_address((const char *)bytes, &with_id, &pose.id))
        return bytes[0] == '/' ? TRACKER_OTHER : TRACKER_SYNTAX;
    void *copy = malloc(size);
    if (copy == NULL)
        return TRACKER_SYNTAX;
    memcpy(copy, bytes, size);
    int result = 0;
    lo_message message = lo_message_deserialise(copy, size, &result);
    free(copy);
    if (message == NULL)
        return TRACKER_SYNTAX;
    const bool good = read_arguments(message, !with_id, &pose);
    lo_message_free(message);
    if (!good)
        return TRACKER_SYNTAX;
    tracker_packet_add(packet, &pose);
    return TRACKER_OK;
}

/* NTP: seconds since 1900, and their fraction in 2^-32. */
static int64_t us_from_ntp(const uint8_t *bytes)
{
    return (int64_t)(packet_be32(bytes) * us_per_s + (packet_be32(bytes + 4) * us_per_s >> 32));
}

static tracker_check_t take_bundle(tracker_packet_t *packet, const uint8_t *bytes, size_t size)
{
    tracker_pose_t pose = {.timed = packet_be32(bytes + 8) != 0 || packet_be32(bytes + 12) != immediately};
    if (pose.timed)
        pose.time_us = us_from_ntp(bytes + 8);
    tracker_check_t found = TRACKER_OTHER;
    for (size_t at = BUNDLE_HEAD; at < size;) {
        if (size - at < SIZE_LENGTH)
            return TRACKER_LENGTH;
        const size_t length = packet_be32(bytes + at);
        at += SIZE_LENGTH;
        if (length > size - at || length % ALIGNMENT != 0)
            return TRACKER_LENGTH;
        const tracker_check_t check = take_message(packet, bytes + at, length, pose);
        if (check != TRACKER_OK && check != TRACKER_OTHER)
            return check;
        found = check == TRACKER_OK ? TRACKER_OK : found;
        at += length;
    }
    return found;
}

tracker_check_t osc_decode(tracker_packet_t *packet, const uint8_t *bytes, size_t size)
{
    if (size == 0 || size % ALIGNMENT != 0)
        return TRACKER_LENGTH;
    if (size >= BUNDLE_HEAD && memcmp(bytes, bundle_name, sizeof bundle_name) == 0)
        return take_bundle(packet, bytes, size);
    return take_message(packet, bytes, size, (tracker_pose_t){.timed = false});
}
