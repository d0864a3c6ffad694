// SPDX-License-Identifier: Apache-2.0
// What a board says of itself, onto the bus.
#include "firmware/telemetry.h"

#include "firmware/can_counts.h"
#include "firmware/can_e2e.h"
#include "firmware/can_update.h"
#include "firmware/projector.h"

void telemetry_init(telemetry_t *telemetry, int64_t now_us)
{
    *telemetry = (telemetry_t){
        .start_us = now_us,
        .heartbeat_due_us = now_us,
        .status_due_us = now_us,
        .quality_due_us = now_us,
        .time_due_us = now_us,
        .latency_due_us = now_us,
        .counts_due_us = now_us,
        .update_due_us = now_us,
        .stage_due_us = now_us + STAGES * CAN_STAGE_PERIOD_MS * 1000,
    };
}

/* Has the count moved since the last heartbeat? */
static uint32_t flag_if_new(uint32_t *seen, uint32_t count, can_fault_flag_t flag)
{
    const bool moved = *seen != count;
    *seen = count;
    return moved ? (uint32_t)flag : 0;
}

static uint32_t fault_flags(projector_t *p, int64_t now_us)
{
    telemetry_t *t = &p->telemetry;
    uint32_t flags = now_us - p->picture_us > PROJECTOR_CAMERA_LOST_US ? (uint32_t)CAN_FAULT_CAMERA : 0;
    flags |= flag_if_new(&t->seen_bus, can_faults_total(&p->can_faults) + p->faults.can_send + p->time.unsent,
                         CAN_FAULT_BUS);
    flags |= flag_if_new(&t->seen_bus_off, p->can_faults.bus_off, CAN_FAULT_BUS_OFF);
    flags |= flag_if_new(&t->seen_display, p->faults.display, CAN_FAULT_DISPLAY);
    flags |= flag_if_new(&t->seen_gpio, p->faults.gpio, CAN_FAULT_GPIO);
    flags |= flag_if_new(&t->seen_watchdog, p->faults.watchdog, CAN_FAULT_WATCHDOG);
    flags |= flag_if_new(&t->seen_deadline, p->faults.deadline, CAN_FAULT_DEADLINE);
    flags |= flag_if_new(&t->seen_refused, can_faults_refused(&p->can_faults), CAN_FAULT_REFUSED);
    flags |= bus_auth_wants_session(&p->auth, now_us) ? (uint32_t)CAN_FAULT_SESSION : 0;
    flags |= p->unusable ? (uint32_t)CAN_FAULT_CONFIG : 0;
    return flags;
}

static void send(projector_t *p, bool encoded, const hal_can_frame_t *frame)
{
    if (!encoded || hal_can_send(p->board.can, frame) != HAL_OK)
        p->faults.can_send++;
}

static void send_heartbeat(projector_t *p, int64_t now_us)
{
    telemetry_t *t = &p->telemetry;
    t->fault_flags = fault_flags(p, now_us);
    const can_heartbeat_t heartbeat = {
        .node = (uint8_t)p->node,
        .counter = t->heartbeat_counter,
        .state = p->report.state,
        .fault_flags = t->fault_flags,
        .frame_number = p->report.frame_number,
        .uptime_s = (uint32_t)((now_us - t->start_us) / 1000000),
    };
    t->heartbeat_counter = (uint8_t)((t->heartbeat_counter + 1) % CAN_E2E_P01_COUNTERS);
    hal_can_frame_t frame;
    send(p, can_heartbeat_encode(&frame, &heartbeat), &frame);
}

/* A pose that came while the step was at work is not of negative age; long silence does not wrap. */
static uint32_t pose_age_ms(const projector_t *p, int64_t now_us)
{
    const int64_t age_ms = (now_us - p->poses.received_us) / 1000;
    if (!p->poses.any || age_ms > UINT16_MAX)
        return UINT16_MAX;
    return age_ms > 0 ? (uint32_t)age_ms : 0;
}

static void send_status(projector_t *p, int64_t now_us)
{
    telemetry_t *t = &p->telemetry;
    warp_report_step(&p->warp, &p->report.warp);
    const int32_t step_q16 = p->warp.step_all ? p->report.warp.k_all_q16 : p->report.warp.k_in_q16;
    const can_status_t status = {
        .node = (uint8_t)p->node,
        .counter = t->status_counter,
        .pose_counter = p->report.pose_counter,
        .pose_age_ms = pose_age_ms(p, now_us),
        .step_q8 = (uint32_t)step_q16 >> 8,
        .warp_time_us = (uint32_t)p->report.times.us[STAGE_WARP],
        .can_faults = can_faults_total(&p->can_faults),
    };
    t->status_counter = (uint8_t)((t->status_counter + 1) % CAN_E2E_P01_COUNTERS);
    hal_can_frame_t frame;
    send(p, can_status_encode(&frame, &status), &frame);
}

/* The stages in turn; with the first of them a second ends. */
static void send_stage(projector_t *p)
{
    telemetry_t *t = &p->telemetry;
    if (t->stage == 0)
        t->figures = stage_times_close(&p->stage_times);
    const can_stage_t stage = {
        .node = (uint8_t)p->node,
        .counter = t->stage_counter,
        .stage = t->stage,
        .mean_us = t->figures.mean_us[t->stage],
        .worst_us = t->figures.worst_us[t->stage],
        .shown = t->figures.shown,
        .late = t->figures.late,
    };
    t->stage = (stage_t)((t->stage + 1) % STAGES);
    t->stage_counter = (uint8_t)((t->stage_counter + 1) % CAN_E2E_P01_COUNTERS);
    hal_can_frame_t frame;
    send(p, can_stage_encode(&frame, &stage), &frame);
}

static void send_quality(projector_t *p)
{
    telemetry_t *t = &p->telemetry;
    const can_quality_t quality = {
        .node = (uint8_t)p->node,
        .counter = t->quality_counter,
        .step = (uint8_t)p->degrade.step,
        .filter = p->warp.method.filter,
        .resampler = p->warp.method.resampler,
        .changes = p->degrade.changes,
        .wanted_us = (uint32_t)(p->degrade.wanted_us < UINT32_MAX ? p->degrade.wanted_us : UINT32_MAX),
        .hold_s = (uint32_t)(p->degrade.hold_us / 1000000),
    };
    t->quality_counter = (uint8_t)((t->quality_counter + 1) % CAN_E2E_P01_COUNTERS);
    hal_can_frame_t frame;
    send(p, can_quality_encode(&frame, &quality), &frame);
}

/* |rate| < 2^22: the product fits. */
static int32_t drift_ppb(const bus_time_t *time)
{
    return (int32_t)(-time->rate_q32 * 1000000000 / (INT64_C(1) << 32));
}

static void send_time(projector_t *p, int64_t now_us)
{
    telemetry_t *t = &p->telemetry;
    const bus_master_t *master = &p->time;
    const can_time_t time = {
        .node = (uint8_t)p->node,
        .counter = t->time_counter,
        .state = bus_master_state(master, now_us),
        .master = master->master,
        .drift_ppb = drift_ppb(&master->time),
        .error_us = bus_master_error_us(master, now_us),
        .changes = master->changes,
        .relocks = master->time.relocks,
        .lost = master->lost,
    };
    t->time_counter = (uint8_t)((t->time_counter + 1) % CAN_E2E_P01_COUNTERS);
    hal_can_frame_t frame;
    send(p, can_time_encode(&frame, &time), &frame);
}

/* What was shown at this refresh; all boards report the same ones. */
static void send_step(projector_t *p)
{
    can_step_t step = p->report.agreement;
    step.node = (uint8_t)p->node;
    step.counter = p->telemetry.step_counter;
    p->telemetry.step_counter = (uint8_t)((p->telemetry.step_counter + 1) % CAN_E2E_P01_COUNTERS);
    hal_can_frame_t frame;
    send(p, can_step_encode(&frame, &step), &frame);
}

void telemetry_add_photon(telemetry_t *telemetry, int32_t pose_to_photon_us)
{
    telemetry->photon_sum_us += pose_to_photon_us;
    telemetry->photons++;
}

static void send_latency(projector_t *p, int64_t now_us)
{
    telemetry_t *t = &p->telemetry;
    const frame_choice_t *choice = &p->choice;
    const int64_t photon_us = t->photons > 0 ? t->photon_sum_us / t->photons : 0;
    const can_latency_t latency = {
        .node = (uint8_t)p->node,
        .counter = t->latency_counter,
        .fault = p->report.fault,
        .held = (uint8_t)choice->step.held,
        .genlocked = choice->genlocked,
        .lag_us = (uint32_t)choice->lag.lag_us,
        .display_us = (uint32_t)choice->clock.display_us,
        .wanted_ms = (uint32_t)choice->wanted_ms,
        .photon_us = photon_us > 0 && photon_us < INT32_MAX ? (uint32_t)photon_us : 0,
        .off_us = choice->step.off_us,
    };
    t->latency_counter = (uint8_t)((t->latency_counter + 1) % CAN_E2E_P01_COUNTERS);
    t->photon_sum_us = 0;
    t->photons = 0;
    hal_can_frame_t frame;
    send(p, can_latency_encode(&frame, &latency), &frame);
    p->faults.can_send += !bus_auth_sign_latency(&p->auth, &p->time.time, &frame, p->board.can, now_us);
}

static void send_counts(projector_t *p)
{
    telemetry_t *t = &p->telemetry;
    const can_counts_t counts = {
        .node = (uint8_t)p->node,
        .counter = t->counts_counter,
        .tags_lost = p->choice.tags_lost,
        .guessed = p->guessed,
        .leaders = p->choice.clock.changes,
        .epochs_missed = p->choice.clock.missed,
        .command_faults = isotp_faults_total(&p->commands.link.faults),
    };
    t->counts_counter = (uint8_t)((t->counts_counter + 1) % CAN_E2E_P01_COUNTERS);
    hal_can_frame_t frame;
    send(p, can_counts_encode(&frame, &counts), &frame);
}

static void send_update(projector_t *p)
{
    telemetry_t *t = &p->telemetry;
    const hal_update_state_t *said = &p->update.said;
    const can_update_t update = {
        .node = (uint8_t)p->node,
        .counter = t->update_counter,
        .state = can_update_state_of(&p->update),
        .progress = (uint8_t)said->progress,
        .slot = said->slot == 'A'   ? 1
                : said->slot == 'B' ? 2
                                    : 0,
        .trial = said->trial,
        .plan = p->update.plan,
        .running = can_update_fingerprint(said->running),
        .waiting = can_update_fingerprint(said->waiting),
    };
    t->update_counter = (uint8_t)((t->update_counter + 1) % CAN_E2E_P01_COUNTERS);
    t->update_state = (uint8_t)update.state;
    t->update_plan = (uint8_t)update.plan;
    hal_can_frame_t frame;
    send(p, can_update_encode(&frame, &update), &frame);
}

/* A board that switches is gone before the second is over. */
static bool update_changed(const projector_t *p)
{
    return can_update_state_of(&p->update) != (can_update_state_t)p->telemetry.update_state ||
           p->update.plan != (update_plan_t)p->telemetry.update_plan;
}

void telemetry_send(projector_t *projector, int64_t now_us)
{
    telemetry_t *t = &projector->telemetry;
    if (projector->choice.clock.now.any && projector->choice.step.content % CAN_STEP_EVERY == 0)
        send_step(projector);
    if (now_us >= t->status_due_us) {
        t->status_due_us = now_us + CAN_STATUS_PERIOD_MS * 1000;
        send_status(projector, now_us);
    }
    if (now_us >= t->stage_due_us) {
        t->stage_due_us += CAN_STAGE_PERIOD_MS * 1000; /* so that four are a second */
        if (t->stage_due_us <= now_us)
            t->stage_due_us = now_us + CAN_STAGE_PERIOD_MS * 1000;
        send_stage(projector);
    }
    if (now_us >= t->quality_due_us) {
        t->quality_due_us = now_us + CAN_QUALITY_PERIOD_MS * 1000;
        send_quality(projector);
    }
    if (now_us >= t->time_due_us) {
        t->time_due_us = now_us + CAN_TIME_PERIOD_MS * 1000;
        send_time(projector, now_us);
    }
    if (now_us >= t->latency_due_us && bus_auth_may_speak(&projector->auth)) {
        t->latency_due_us = now_us + CAN_LATENCY_PERIOD_MS * 1000;
        send_latency(projector, now_us);
    }
    if (now_us >= t->counts_due_us) {
        t->counts_due_us = now_us + CAN_COUNTS_PERIOD_MS * 1000;
        send_counts(projector);
    }
    if (now_us >= t->update_due_us || update_changed(projector)) {
        t->update_due_us = now_us + CAN_UPDATE_PERIOD_MS * 1000;
        send_update(projector);
    }
    telemetry_send_life(projector, now_us);
}

void telemetry_send_life(projector_t *projector, int64_t now_us)
{
    telemetry_t *t = &projector->telemetry;
    if (now_us < t->heartbeat_due_us)
        return;
    t->heartbeat_due_us = now_us + CAN_HEARTBEAT_PERIOD_MS * 1000;
    send_heartbeat(projector, now_us);
}
