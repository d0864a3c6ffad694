// SPDX-License-Identifier: Apache-2.0
// Prints encoded frames beside the values that went into them, for dbc_decodes_traffic.py to compare.
//
// Lines: "frame MESSAGE ID FD CYCLE_MS HEX", then "signal NAME VALUE" for what that frame must say, and "named NAME
// TEXT" for what the DBC file calls that value. The values are in the DBC file's units, written down by hand here.
#include <stdio.h>
#include <stdlib.h>

#include "firmware/can_counts.h"
#include "firmware/can_frame_clock.h"
#include "firmware/can_latency.h"
#include "firmware/can_protocol.h"
#include "tests/support/auth_frames.h"
#include "tests/support/auth_frames.h"

enum { POSE_CYCLE_MS = 4 };

static void print_frame(const char *message, const hal_can_frame_t *frame, int cycle_ms)
{
    printf("frame %s %u %d %d ", message, (unsigned)frame->id, frame->fd ? 1 : 0, cycle_ms);
    for (int i = 0; i < frame->length; i++)
        printf("%02x", frame->data[i]);
    printf("\n");
}

static void check(bool encoded)
{
    if (!encoded) {
        fprintf(stderr, "print_frames: a frame was not encoded\n");
        exit(1);
    }
}

static can_auth_t *key;

/* The frame behind a message, with the key of auth_frames.h. Codes are from `openssl mac -cipher AES-128-CBC -macopt
 * hexkey:000102030405060708090A0B0C0D0E0F CMAC`. */
static void print_code(const char *message, const can_auth_message_t *frames, int cycle_ms, const char *mac)
{
    hal_can_frame_t tag;
    check(can_auth_sign(key, AUTH_FRESH, frames, &tag));
    print_frame(message, &tag, cycle_ms);
    printf("signal %sTime 13952502\nsignal %sMac %s\n", message, message, mac); /* 0xD4E5F6 */
}

static void print_signed_fd(hal_can_frame_t frame)
{
    check(can_auth_sign_fd(key, AUTH_FRESH, &frame));
    frame.id = CAN_AUTH_ID_POSE_FD;
    print_frame("PoseSigned", &frame, POSE_CYCLE_MS);
    printf("signal PoseSignedCounter 254\nsignal PoseSignedQuality 2\nsignal PoseSignedTracker 13\n"
           "signal PoseSignedX 1234.567\nsignal PoseSignedY -999999.999\nsignal PoseSignedZ 0.001\n"
           "signal PoseSignedQw 1\nsignal PoseSignedQx -0.5\nsignal PoseSignedQy 2.384185791015625E-7\n"
           "signal PoseSignedQz -0.75\nsignal PoseSignedCaptureTime 4000000001\n"
           "signal PoseSignedTime 177789161760246\n" /* 0xA1B2C3D4E5F6 */
           "signal PoseSignedMacLow 655171782671\nsignal PoseSignedMacHigh 816104734545\n");
}

static void print_fd(void)
{
    hal_can_frame_t frame;
    const can_pose_t pose = {
        .pose = {.eye_nm = {1234567000, -INT64_C(999999999000), 1000},
                 .quaternion_q30 = {1 << 30, -(1 << 29), 1 << 8, -(3 << 28)}},
        .capture_time_us = 4000000001,
        .quality = CAN_POSE_PREDICTED,
        .tracker = 13,
        .counter = 254,
    };
    check(can_pose_fd_encode(&frame, &pose));
    print_frame("Pose", &frame, POSE_CYCLE_MS);
    printf("signal PoseCounter 254\nsignal PoseQuality 2\nsignal PoseTracker 13\n"
           "signal PoseX 1234.567\nsignal PoseY -999999.999\nsignal PoseZ 0.001\n"
           "signal PoseQw 1\nsignal PoseQx -0.5\nsignal PoseQy 2.384185791015625E-7\nsignal PoseQz -0.75\n"
           "signal PoseCaptureTime 4000000001\n");
    print_signed_fd(frame);
}

static void print_set(void)
{
    hal_can_frame_t part[CAN_POSE_PARTS];
    const can_pose_t pose = {
        .pose = {.eye_nm = {1234560000, -INT64_C(83886080000), -10000},
                 .quaternion_q30 = {1 << 30, -(1 << 30), 1 << 15, -(3 << 28)}},
        .capture_time_us = 5123400, /* 0xC822 units of 100 us: 0x822 and 0xC */
        .quality = CAN_POSE_TRACKED,
        .counter = 11,
    };
    check(can_pose_set_encode(part, &pose));
    print_frame("PoseSetA", &part[0], POSE_CYCLE_MS);
    printf("signal PoseSetACounter 11\nsignal PoseSetQuality 1\nsignal PoseSetX 1234.56\nsignal PoseSetY -83886.08\n");
    print_frame("PoseSetB", &part[1], POSE_CYCLE_MS);
    printf("signal PoseSetBCounter 11\nsignal PoseSetCaptureTimeLow 208200\nsignal PoseSetZ -0.01\n"
           "signal PoseSetQw 0.999969482421875\n");
    print_frame("PoseSetC", &part[2], POSE_CYCLE_MS);
    printf("signal PoseSetCCounter 11\nsignal PoseSetCaptureTimeHigh 4915200\nsignal PoseSetQx -1\n"
           "signal PoseSetQy 0.000030517578125\nsignal PoseSetQz -0.75\n");
    const can_auth_message_t set = {part, CAN_POSE_PARTS, CAN_AUTH_ID_POSE_SET};
    print_code("PoseSetCode", &set, POSE_CYCLE_MS, "699254507930");
}

static void print_status(void)
{
    hal_can_frame_t frame;
    const can_status_t status = {.node = 1,
                                 .counter = 5,
                                 .pose_counter = 201,
                                 .pose_age_ms = 777,
                                 .step_q8 = 640,
                                 .warp_time_us = 8300,
                                 .can_faults = 1000};
    check(can_status_encode(&frame, &status));
    print_frame("Status", &frame, CAN_STATUS_PERIOD_MS);
    printf("signal StatusCounter 5\nsignal StatusWarpTime 8300\nsignal StatusPoseAge 777\nsignal StatusStep 2.5\n"
           "signal StatusCanFaults 1000\nsignal StatusPoseCounter 201\n");
}

static void print_stages(void)
{
    static const char *const NAME[STAGES] = {"Pose", "Warp", "Show", "Wait"};
    for (int i = 0; i < STAGES; i++) {
        hal_can_frame_t frame;
        const can_stage_t stage = {.node = 1,
                                   .counter = (uint8_t)(3 + i),
                                   .stage = (stage_t)i,
                                   .mean_us = 8301,
                                   .worst_us = 54321,
                                   .shown = 60,
                                   .late = 201};
        check(can_stage_encode(&frame, &stage));
        print_frame("Stage", &frame, CAN_STAGE_PERIOD_MS);
        printf("signal StageCounter %d\nsignal StageNumber %d\nsignal StageMean 8301\nsignal StageWorst 54321\n"
               "signal StageShown 60\nsignal StageLate 201\nnamed StageNumber %s\n",
               3 + i, i, NAME[i]);
    }
}

/* One for each method, so that no two can be confused. */
static void print_qualities(void)
{
    for (int i = 0; i < WARP_METHODS; i++) {
        hal_can_frame_t frame;
        const can_quality_t quality = {.node = 1,
                                       .counter = (uint8_t)(i % 15),
                                       .step = (uint8_t)(i % DEGRADE_MAX_STEPS),
                                       .filter = warp_methods[i].filter,
                                       .resampler = warp_methods[i].resampler,
                                       .changes = 51234,
                                       .wanted_us = 23456,
                                       .hold_s = 512};
        check(can_quality_encode(&frame, &quality));
        print_frame("Quality", &frame, CAN_QUALITY_PERIOD_MS);
        printf("signal QualityCounter %d\nsignal QualityStep %d\nsignal QualityMethod %d\n"
               "signal QualityChanges 51234\nsignal QualityWanted 23456\nsignal QualityHold 512\n"
               "named QualityMethod %s\n",
               i % 15, i % DEGRADE_MAX_STEPS, 16 * (int)warp_methods[i].filter + (int)warp_methods[i].resampler,
               warp_methods[i].name);
    }
}

static void print_sync(void)
{
    hal_can_frame_t pair[2];
    const can_sync_t sync = {.number = 0, .counter = 9, .origin = 37};
    check(can_sync_encode(&pair[0], &sync));
    print_frame("Sync", &pair[0], CAN_SYNC_PERIOD_MS);
    printf("signal SyncCounter 9\nsignal SyncOrigin 37\nsignal SyncReserved 0\n");
    const can_follow_up_t follow_up = {.number = 0, .counter = 9, .time_us = 273849506172839};
    check(can_follow_up_encode(&pair[1], &follow_up));
    print_frame("FollowUp", &pair[1], CAN_SYNC_PERIOD_MS);
    printf("signal FollowUpCounter 9\nsignal FollowUpReserved 0\nsignal FollowUpTime 273849506172839\n");
    const can_auth_message_t message = {pair, 2, CAN_AUTH_ID_TIME};
    print_code("TimeCode", &message, CAN_SYNC_PERIOD_MS, "302467567129");
}

static void print_times(void)
{
    static const char *const NAME[] = {"None", "OwnMaster", "Locked", "Holdover"};
    for (int i = 0; i <= CAN_TIME_HOLDOVER; i++) {
        hal_can_frame_t frame;
        const can_time_t time = {.node = 1,
                                 .counter = (uint8_t)(11 + i),
                                 .state = (can_time_state_t)i,
                                 .master = (uint8_t)(40 + i),
                                 .drift_ppb = i % 2 == 0 ? 51300 : -700,
                                 .error_us = 777,
                                 .changes = 55,
                                 .relocks = 13,
                                 .lost = 201};
        check(can_time_encode(&frame, &time));
        print_frame("Time", &frame, CAN_TIME_PERIOD_MS);
        printf("signal TimeCounter %d\nsignal TimeState %d\nsignal TimeMaster %d\nsignal TimeDrift %s\n"
               "signal TimeError 777\nsignal TimeChanges 55\nsignal TimeRelocks 13\nsignal TimeLost 201\n"
               "named TimeState %s\n",
               11 + i, i, 40 + i, i % 2 == 0 ? "51.3" : "-0.7", NAME[i]);
    }
}

static void print_frame_clock(void)
{
    hal_can_frame_t frame;
    const can_frame_clock_t clock = {.node = 1,
                                     .counter = 6,
                                     .epoch = 11,
                                     .sure = true,
                                     .from = 3210,
                                     .phase_us = 16120,
                                     .lag_us = 34576,
                                     .target_ms = 87};
    check(can_frame_clock_encode(&frame, &clock));
    print_frame("FrameClock", &frame, CAN_FRAME_CLOCK_PERIOD_MS);
    printf("signal FrameClockCounter 6\nsignal FrameClockEpoch 11\nsignal FrameClockFrom 3210\nsignal FrameClockTarget "
           "87\n"
           "signal FrameClockPhase 16120\nsignal FrameClockLag 34576\nsignal FrameClockSure 1\n"
           "signal FrameClockToCome 0\nsignal FrameClockChanges 0\n");
    const can_auth_message_t message = {&frame, 1, CAN_AUTH_ID_FRAME_CLOCK + 1};
    print_code("FrameClockCode", &message, CAN_FRAME_CLOCK_PERIOD_MS, "54077084522");
    const can_step_t step = {.node = 1,
                             .counter = 7,
                             .in_step = true,
                             .refresh = 65536 + 12345,
                             .picture = 54321,
                             .pose_us = 6553600 + 1234599};
    check(can_step_encode(&frame, &step));
    print_frame("Step", &frame, CAN_STEP_PERIOD_MS);
    printf("signal StepCounter 7\nsignal StepInStep 1\nsignal StepTagged 0\nsignal StepReserved 0\n"
           "signal StepRefresh 12345\nsignal StepPicture 54321\nsignal StepPose 1234500\n");
}

static void print_latencies(void)
{
    static const char *const NAME[] = {"InStep",    "NoBusTime", "NoFrameClock", "PanelOff",
                                       "NoPicture", "NoPose",    "NotShown"};
    for (int i = 0; i <= CAN_STEP_NOT_SHOWN; i++) {
        hal_can_frame_t frame;
        const can_latency_t latency = {.node = 1,
                                       .counter = (uint8_t)(2 + i),
                                       .fault = (can_step_fault_t)i,
                                       .held = (uint8_t)i,
                                       .genlocked = i % 2 == 0,
                                       .lag_us = 16705, /* rounded up */
                                       .display_us = 33500,
                                       .wanted_ms = 123,
                                       .photon_us = 61300, /* rounded */
                                       .off_us = i % 2 == 0 ? 1290 : -7940};
        check(can_latency_encode(&frame, &latency));
        print_frame("Latency", &frame, CAN_LATENCY_PERIOD_MS);
        printf("signal LatencyCounter %d\nsignal LatencyFault %d\nsignal LatencyHeld %d\nsignal LatencyGenlocked %d\n"
               "signal LatencyLag 16768\nsignal LatencyDisplay 33.5\nsignal LatencyWanted 123\n"
               "signal LatencyPhoton 61.25\nsignal LatencyOff %d\nnamed LatencyFault %s\n",
               2 + i, i, i, i % 2 == 0, i % 2 == 0 ? 1280 : -7936, NAME[i]);
        const can_auth_message_t message = {&frame, 1, CAN_AUTH_ID_LATENCY + 1};
        if (i == 0)
            print_code("LatencyCode", &message, CAN_LATENCY_PERIOD_MS, "500234171403");
    }
}

static void print_counts(void)
{
    hal_can_frame_t frame;
    const can_counts_t counts = {.node = 1,
                                 .counter = 12,
                                 .tags_lost = 4096 + 3000,
                                 .guessed = 2345,
                                 .leaders = 201,
                                 .epochs_missed = 256 + 99,
                                 .command_faults = 4000};
    check(can_counts_encode(&frame, &counts));
    print_frame("Counts", &frame, CAN_COUNTS_PERIOD_MS);
    printf("signal CountsCounter 12\nsignal CountsTagsLost 3000\nsignal CountsGuessed 2345\nsignal CountsLeaders 201\n"
           "signal CountsEpochsMissed 99\nsignal CountsCommandFaults 4000\n");
}

/* One heartbeat for each fault flag, so that no two flags can be confused. */
static void print_heartbeats(void)
{
    static const struct {
        can_fault_flag_t flag;
        const char *signal;
    } FAULT[] = {
        {CAN_FAULT_BUS, "HeartbeatFaultBus"},           {CAN_FAULT_BUS_OFF, "HeartbeatFaultBusOff"},
        {CAN_FAULT_CAMERA, "HeartbeatFaultCamera"},     {CAN_FAULT_DISPLAY, "HeartbeatFaultDisplay"},
        {CAN_FAULT_GPIO, "HeartbeatFaultGpio"},         {CAN_FAULT_WATCHDOG, "HeartbeatFaultWatchdog"},
        {CAN_FAULT_DEADLINE, "HeartbeatFaultDeadline"}, {CAN_FAULT_REFUSED, "HeartbeatFaultRefused"},
        {CAN_FAULT_SESSION, "HeartbeatFaultSession"},
    };
    enum { FAULTS = sizeof FAULT / sizeof FAULT[0] };
    for (int i = 0; i < FAULTS; i++) {
        hal_can_frame_t frame;
        const can_heartbeat_t heartbeat = {.node = 1,
                                           .counter = (uint8_t)(6 + i),
                                           .state = (can_board_state_t)(i % CAN_BOARD_STATES),
                                           .fault_flags = FAULT[i].flag,
                                           .frame_number = 43210,
                                           .uptime_s = 54321};
        check(can_heartbeat_encode(&frame, &heartbeat));
        print_frame("Heartbeat", &frame, CAN_HEARTBEAT_PERIOD_MS);
        printf("signal HeartbeatCounter %d\nsignal HeartbeatState %d\nsignal HeartbeatFrameNumber 43210\n"
               "signal HeartbeatUptime 54321\nsignal HeartbeatFaultReserved 0\n",
               6 + i, i % CAN_BOARD_STATES);
        for (int k = 0; k < FAULTS; k++)
            printf("signal %s %d\n", FAULT[k].signal, k == i ? 1 : 0);
    }
}

int main(void)
{
    key = can_auth_open(&AUTH_KEY);
    check(key != NULL);
    print_fd();
    print_set();
    print_status();
    print_stages();
    print_qualities();
    print_sync();
    print_times();
    print_frame_clock();
    print_latencies();
    print_counts();
    print_heartbeats();
    can_auth_close(key);
    return 0;
}
