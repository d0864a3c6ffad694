// SPDX-License-Identifier: Apache-2.0
// BUS.md says what is true: its frames decode to the values beside them, byte by byte.
#include <math.h>
#include <stdlib.h>

#include "firmware/bus_time.h"
#include "firmware/pose_from_can.h"
#include "sim/bus/candump_text.h"
#include "tests/firmware/bus_page.h"
#include "tests/support/auth_frames.h"

enum { FRAMES = 6, ROWS = 33, CELLS = 5 };

static const int64_t captured_us = 4394967300;

/* The page's example: its frames, and what the firmware makes of them. */
typedef struct {
    hal_can_frame_t frame[FRAMES]; /* Sync, FollowUp, Pose, the set */
    can_sync_t sync;
    can_follow_up_t follow_up;
    can_pose_t fd, set;
} example_t;

static example_t read_example(void)
{
    example_t example = {.sync.number = 0};
    char line[LINE_LENGTH], interface[CANDUMP_INTERFACE_LENGTH];
    FILE *page = open_page();
    int frames = 0;
    while (fgets(line, sizeof line, page) != NULL) {
        if (strstr(line, ") can0 ") == NULL)
            continue;
        assert_true(frames < FRAMES);
        const char *wrong = candump_frame_from_text(&example.frame[frames++], interface, line);
        if (wrong != NULL)
            fail_msg("%s: expected %s", line, wrong);
    }
    fclose(page);
    assert_int_equal(frames, FRAMES);
    assert_int_equal(can_sync_decode(&example.sync, &example.frame[0]), CAN_CHECK_OK);
    assert_int_equal(can_follow_up_decode(&example.follow_up, &example.frame[1]), CAN_CHECK_OK);
    assert_int_equal(can_pose_fd_decode(&example.fd, &example.frame[2], 0), CAN_CHECK_OK);
    assert_int_equal(can_pose_set_decode(&example.set, example.frame + 3, 0), CAN_CHECK_OK);
    return example;
}

/* @return What the decoders found for a signal of wallwarp.dbc, in its units. */
static double decoded(const example_t *example, const char *signal)
{
    static const double mm = 1e-6, one = 1.0 / (1 << 30);
    const can_pose_t *fd = &example->fd, *set = &example->set;
    const uint32_t set_time_us = (uint32_t)set->capture_time_us;
    const struct {
        const char *signal;
        double value;
    } known[] = {
        {"PoseCrc", example->frame[2].data[0] | example->frame[2].data[1] << 8},
        {"PoseCounter", fd->counter},
        {"PoseQuality", fd->quality},
        {"PoseTracker", fd->tracker},
        {"PoseX", (double)fd->pose.eye_nm[0] * mm},
        {"PoseY", (double)fd->pose.eye_nm[1] * mm},
        {"PoseZ", (double)fd->pose.eye_nm[2] * mm},
        {"PoseQw", fd->pose.quaternion_q30[0] * one},
        {"PoseQx", fd->pose.quaternion_q30[1] * one},
        {"PoseQy", fd->pose.quaternion_q30[2] * one},
        {"PoseQz", fd->pose.quaternion_q30[3] * one},
        {"PoseCaptureTime", (double)fd->capture_time_us},
        {"PoseSetACrc", example->frame[3].data[0]},
        {"PoseSetACounter", set->counter},
        {"PoseSetQuality", set->quality},
        {"PoseSetX", (double)set->pose.eye_nm[0] * mm},
        {"PoseSetY", (double)set->pose.eye_nm[1] * mm},
        {"PoseSetBCrc", example->frame[4].data[0]},
        {"PoseSetBCounter", set->counter},
        {"PoseSetCaptureTimeLow", set_time_us % 409600},
        {"PoseSetZ", (double)set->pose.eye_nm[2] * mm},
        {"PoseSetQw", set->pose.quaternion_q30[0] * one},
        {"PoseSetCCrc", example->frame[5].data[0]},
        {"PoseSetCCounter", set->counter},
        {"PoseSetCaptureTimeHigh", set_time_us - set_time_us % 409600},
        {"PoseSetQx", set->pose.quaternion_q30[1] * one},
        {"PoseSetQy", set->pose.quaternion_q30[2] * one},
        {"PoseSetQz", set->pose.quaternion_q30[3] * one},
        {"SyncCrc", example->frame[0].data[0]},
        {"SyncCounter", example->sync.counter},
        {"FollowUpCrc", example->frame[1].data[0]},
        {"FollowUpCounter", example->follow_up.counter},
        {"FollowUpTime", (double)example->follow_up.time_us},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(known[i].signal, signal) == 0)
            return known[i].value;
    fail_msg("the page has a signal that this test does not know: %s", signal);
    return 0;
}

/* "| 100 | 4 to 7 | PoseX, 0.001 mm | `80 D6 12 00` | 1234.56 |" @return Is it such a row? */
static bool split(char *line, char *cell[CELLS])
{
    unsigned id = 0;
    int length = 0;
    if (sscanf(line, "| %3x |%n", &id, &length) != 1 || length != 7)
        return false;
    char *rest = NULL;
    for (int i = 0; i < CELLS; i++) {
        cell[i] = strtok_r(i == 0 ? line : NULL, "|", &rest);
        if (cell[i] == NULL)
            return false;
    }
    return true;
}

static void check_row(const example_t *example, char *cell[CELLS], bool told[FRAMES][HAL_CAN_MAX_LENGTH])
{
    char signal[64] = "";
    int f = 0;
    while (f < FRAMES && example->frame[f].id != strtoul(cell[0], NULL, 16))
        f++;
    assert_in_range(f, 0, FRAMES - 1);
    char *after = NULL;
    const long first = strtol(cell[1], &after, 10);
    const char *to = strpbrk(after, "0123456789");
    const long last = to == NULL ? first : strtol(to, NULL, 10);
    assert_true(sscanf(cell[2], " %63[A-Za-z]", signal) == 1);
    char *hex = strchr(cell[3], '`');
    assert_non_null(hex);
    for (long i = first; i <= last; i++) {
        const unsigned long byte = strtoul(i == first ? hex + 1 : hex, &hex, 16);
        if (byte != example->frame[f].data[i])
            fail_msg("%s: byte %ld is %02X, not %02lX", signal, i, (unsigned)example->frame[f].data[i], byte);
        told[f][i] = true;
    }
    assert_int_equal(*hex, '`');
    const double value = strtod(cell[4], NULL), found = decoded(example, signal);
    const double half_a_bit = fabs(value) <= 1 && value != 0 && strstr(signal, "Q") != NULL ? 1.6e-5 : 1e-6;
    if (fabs(value - found) > half_a_bit)
        fail_msg("%s: %.9g is written, %.9g is sent", signal, value, found);
}

static void test_bytes_are_those_of_the_frames(void **state)
{
    (void)state;
    const example_t example = read_example();
    bool told[FRAMES][HAL_CAN_MAX_LENGTH] = {{false}};
    char line[LINE_LENGTH], *cell[CELLS];
    FILE *page = open_page();
    int rows = 0;
    while (fgets(line, sizeof line, page) != NULL) {
        if (!split(line, cell))
            continue;
        check_row(&example, cell, told);
        rows++;
    }
    fclose(page);
    assert_int_equal(rows, ROWS);
    for (int f = 0; f < FRAMES; f++)
        for (int i = 0; i < example.frame[f].length; i++)
            if (!told[f][i] && example.frame[f].data[i] != 0)
                fail_msg("byte %d of %03X is not told", i, (unsigned)example.frame[f].id);
}

static void test_frames_are_what_an_encoder_makes(void **state)
{
    (void)state;
    const example_t example = read_example();
    hal_can_frame_t made[FRAMES];
    assert_true(can_sync_encode(&made[0], &example.sync) && can_follow_up_encode(&made[1], &example.follow_up));
    assert_true(can_pose_fd_encode(&made[2], &example.fd) && can_pose_set_encode(made + 3, &example.set));
    for (int f = 0; f < FRAMES; f++)
        assert_memory_equal(made[f].data, example.frame[f].data, example.frame[f].length);
}

static void test_a_board_takes_them(void **state)
{
    (void)state;
    const example_t example = read_example();
    can_poses_t fd = {.viewer = 0}, set = {.viewer = 0};
    can_faults_t faults = {.length = 0};
    assert_true(pose_from_frame(&fd, NULL, &example.frame[2], &faults));
    for (int i = 0; i < CAN_POSE_PARTS; i++)
        assert_true(pose_from_frame(&set, NULL, &example.frame[3 + i], &faults));
    assert_true(fd.any && set.any && can_faults_total(&faults) == 0);
    assert_int_equal(bus_time_extend(fd.received_us, fd.newest.capture_time_us, CAN_POSE_FD_WRAP_US), captured_us);
    assert_int_equal(bus_time_extend(set.received_us, set.newest.capture_time_us, CAN_POSE_SET_WRAP_US), captured_us);
}

static void assert_page_has_bytes(const char *before, const uint8_t *bytes, int count)
{
    char text[128];
    int length = snprintf(text, sizeof text, "`%s", before);
    for (int i = 0; i < count; i++)
        length += snprintf(text + length, sizeof text - (size_t)length, "%02X", (unsigned)bytes[i]);
    snprintf(text + length, sizeof text - (size_t)length, "`");
    assert_page_has(text);
}

static void test_codes_are_those_of_the_frames(void **state)
{
    (void)state;
    static const can_auth_fresh_t fresh = {0x0123456789ABCDEF, 4394971600};
    example_t example = read_example();
    can_auth_t *auth = can_auth_open(&AUTH_KEY);
    assert_non_null(auth);
    hal_can_frame_t tag;
    const can_auth_message_t set = {&example.frame[3], CAN_POSE_PARTS, CAN_AUTH_ID_POSE_SET};
    assert_true(can_auth_sign(auth, fresh, &set, &tag));
    assert_page_has_bytes("113#", tag.data, 8);
    const can_auth_message_t pair = {example.frame, 2, CAN_AUTH_ID_TIME};
    assert_true(can_auth_sign(auth, fresh, &pair, &tag));
    assert_page_has_bytes("0C0#", tag.data, 8);
    assert_true(can_auth_sign_fd(auth, fresh, &example.frame[2]));
    assert_page_has_bytes("", example.frame[2].data + CAN_AUTH_FD_PLAIN, CAN_AUTH_FD_SIGNED - CAN_AUTH_FD_PLAIN);
    can_auth_close(auth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes_are_those_of_the_frames),
        cmocka_unit_test(test_frames_are_what_an_encoder_makes),
        cmocka_unit_test(test_a_board_takes_them),
        cmocka_unit_test(test_codes_are_those_of_the_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
