// SPDX-License-Identifier: Apache-2.0
// Prints frames of poses, of bus time and of the numbers of refreshes, as print_frame.h says.
#include "firmware/can_frame_clock.h"
#include "firmware/can_protocol.h"
#include "tests/firmware/print_frame.h"

enum { POSE_CYCLE_MS = 4 };

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

int main(void)
{
    key = can_auth_open(&AUTH_KEY);
    check(key != NULL);
    print_fd();
    print_set();
    print_sync();
    print_frame_clock();
    can_auth_close(key);
    return 0;
}
