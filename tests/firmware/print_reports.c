// SPDX-License-Identifier: Apache-2.0
// Prints frames of what boards report of themselves, as print_frame.h says.
#include "firmware/can_counts.h"
#include "firmware/can_latency.h"
#include "firmware/can_protocol.h"
#include "firmware/can_update.h"
#include "tests/firmware/print_frame.h"

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

static void print_updates(void)
{
    static const char *const NAME[] = {"NoAgent", "Idle", "Installing", "Ready", "Failed", "Switching"};
    static const char *const SLOT[] = {"Unknown", "A", "B"}, *const PLAN[] = {"None", "Promised", "Confirmed"};
    for (int i = 0; i < CAN_UPDATE_STATES; i++) {
        hal_can_frame_t frame;
        const can_update_t update = {.node = 1,
                                     .counter = (uint8_t)(9 + i),
                                     .state = (can_update_state_t)i,
                                     .progress = (uint8_t)(95 + i),
                                     .slot = (uint8_t)(i % 3),
                                     .trial = i % 2 == 1,
                                     .plan = (update_plan_t)(i / 2),
                                     .running = can_update_fingerprint("123456789"),
                                     .waiting = 54321};
        check(can_update_encode(&frame, &update));
        print_frame("Update", &frame, CAN_UPDATE_PERIOD_MS);
        printf("signal UpdateCounter %d\nsignal UpdateState %d\nsignal UpdateProgress %d\nsignal UpdateSlot %d\n"
               "signal UpdateTrial %d\nsignal UpdatePlan %d\nsignal UpdateReserved 0\n"
               "signal UpdateRunning %u\nsignal UpdateWaiting 54321\n",
               9 + i, i, 95 + i, i % 3, i % 2, i / 2, (unsigned)update.running);
        printf("named UpdateState %s\nnamed UpdateSlot %s\nnamed UpdateTrial %s\nnamed UpdatePlan %s\n", NAME[i],
               SLOT[i % 3], i % 2 == 1 ? "OnTrial" : "Good", PLAN[i / 2]);
    }
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
        {CAN_FAULT_SESSION, "HeartbeatFaultSession"},   {CAN_FAULT_CONFIG, "HeartbeatFaultConfig"},
    };
    enum { FAULTS = sizeof FAULT / sizeof FAULT[0] };
    for (int i = 0; i < FAULTS; i++) {
        hal_can_frame_t frame;
        const can_heartbeat_t heartbeat = {.node = 1,
                                           .counter = (uint8_t)((6 + i) % CAN_E2E_P01_COUNTERS),
                                           .state = (can_board_state_t)(i % CAN_BOARD_STATES),
                                           .fault_flags = FAULT[i].flag,
                                           .frame_number = 43210,
                                           .uptime_s = 54321};
        check(can_heartbeat_encode(&frame, &heartbeat));
        print_frame("Heartbeat", &frame, CAN_HEARTBEAT_PERIOD_MS);
        printf("signal HeartbeatCounter %d\nsignal HeartbeatState %d\nsignal HeartbeatFrameNumber 43210\n"
               "signal HeartbeatUptime 54321\nsignal HeartbeatFaultReserved 0\n",
               (6 + i) % CAN_E2E_P01_COUNTERS, i % CAN_BOARD_STATES);
        for (int k = 0; k < FAULTS; k++)
            printf("signal %s %d\n", FAULT[k].signal, k == i ? 1 : 0);
    }
}

int main(void)
{
    key = can_auth_open(&AUTH_KEY);
    check(key != NULL);
    print_status();
    print_stages();
    print_qualities();
    print_times();
    print_latencies();
    print_counts();
    print_updates();
    print_heartbeats();
    can_auth_close(key);
    return 0;
}
