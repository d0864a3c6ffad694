// SPDX-License-Identifier: Apache-2.0
// The board that leads the frame clock: when to, what it announces, and when that changes.
#include "firmware/frame_lead.h"

#include "firmware/frame_latency.h"

enum { OFF_MEMORY = 64, PERIOD_MOST_US = 65528 /* a phase is less, and sent in 13 bits */ };

/* As they are sent. */
static int32_t sent_phase_us(int32_t phase_us)
{
    return phase_us / CAN_FRAME_CLOCK_PHASE_UNIT_US * CAN_FRAME_CLOCK_PHASE_UNIT_US;
}

static int32_t sent_lag_us(int32_t lag_us)
{
    const int32_t most_us = lag_us > FRAME_LEAD_LAG_MOST_US ? FRAME_LEAD_LAG_MOST_US : lag_us;
    return most_us / CAN_FRAME_CLOCK_LAG_UNIT_US * CAN_FRAME_CLOCK_LAG_UNIT_US;
}

/* What the room needs now; lag and target, no more. */
static frame_epoch_t wanted(const frame_clock_t *clock, int64_t now_us)
{
    const room_latency_sum_t sum = room_latency_sum(&clock->room, now_us);
    frame_epoch_t wanted = {.lag_us = sent_lag_us(sum.lag_us), .target_ms = frame_latency_target_ms(clock, &sum)};
    if (sum.lag_us == 0)
        wanted.lag_us = clock->now.lag_us;
    return wanted;
}

/* Lead from now on; with the epoch that is known, or the first one. */
static void begin_to_lead(frame_clock_t *clock, const frame_blank_t *blank)
{
    frame_clock_follow(clock, clock->node);
    clock->led_since_us = blank->now_us;
    clock->own_us = blank->now_us - FRAME_LEAD_OWN_LATE_US - 1;
    clock->off_q8 = clock->off_count = clock->wrong = 0;
    if (clock->now.any)
        return;
    const int64_t before = frame_rate_before(clock->rate, blank->blank_us);
    clock->now = wanted(clock, blank->now_us);
    clock->now.any = true;
    clock->now.from = before;
    clock->now.phase_us = sent_phase_us((int32_t)(blank->blank_us - frame_rate_length_us(clock->rate, before)));
}

static void propose(frame_clock_t *clock, const frame_step_t *step, int32_t phase_us, const frame_epoch_t *wanted)
{
    const int32_t period_us = frame_rate_period_us(clock->rate);
    frame_epoch_t next = {
        .any = true,
        .number = (uint8_t)((clock->now.number + 1) % CAN_EPOCHS),
        .from = step->number + FRAME_CLOCK_AHEAD_US / period_us + 1,
        .phase_us = phase_us,
        .lag_us = wanted->lag_us,
        .target_ms = wanted->target_ms,
    };
    /* What is a whole period off is the neighbour's number. */
    if (next.phase_us < 0)
        next.phase_us += period_us;
    if (next.phase_us >= period_us)
        next.phase_us -= period_us;
    next.phase_us = sent_phase_us(next.phase_us);
    clock->next = next;
}

/* How late the house's frame is, or without a house signal the leader's panel. */
static int32_t house_off_us(const frame_clock_t *clock, const frame_step_t *step, const frame_blank_t *blank)
{
    return blank->genlocked ? frame_clock_off_us(clock, blank->house_us) : step->off_us;
}

/* The house's frame, or else the leader's panel, and what the boards need are what the room goes by. */
static void watch(frame_clock_t *clock, const frame_step_t *step, const frame_blank_t *blank)
{
    const int32_t quarter_us = frame_rate_period_us(clock->rate) / 4;
    if (clock->next.any) {
        clock->off_q8 = clock->off_count = clock->wrong = 0; /* what is measured now is mended already */
        return;
    }
    clock->off_count += clock->off_count < OFF_MEMORY;
    clock->off_q8 += (house_off_us(clock, step, blank) * 256 - clock->off_q8) / clock->off_count;
    const frame_epoch_t needed = wanted(clock, blank->now_us);
    const int32_t wrong_us = needed.lag_us - clock->now.lag_us;
    const bool is_wrong = wrong_us > quarter_us || wrong_us < -quarter_us || needed.target_ms != clock->now.target_ms;
    clock->wrong = is_wrong ? clock->wrong + 1 : 0;
    const int32_t off_us = clock->off_q8 / 256;
    const bool drifted =
        clock->off_count == OFF_MEMORY && (off_us > FRAME_CLOCK_DRIFT_US || off_us < -FRAME_CLOCK_DRIFT_US);
    /* Who is not heard must change nothing: the others may be led by somebody else by now. */
    if (!clock->proven || blank->now_us - clock->proven_us > FRAME_LEAD_OWN_LATE_US ||
        blank->now_us - clock->led_since_us < FRAME_CLOCK_AHEAD_US)
        return;
    if (clock->wrong >= FRAME_CLOCK_LAG_REFRESHES)
        propose(clock, step, clock->now.phase_us + off_us, &needed);
    else if (drifted)
        propose(clock, step, clock->now.phase_us + off_us, &clock->now);
}

/* @return Is it on its way? What does not get out proves nothing. */
static bool send(frame_clock_t *clock, hal_can_t *can, const frame_epoch_t *epoch, int64_t from)
{
    const bool to_come = epoch == &clock->next;
    const can_frame_clock_t message = {
        .node = clock->node,
        .counter = clock->counter,
        .epoch = epoch->number,
        .from = (uint16_t)((uint64_t)from % CAN_FRAME_CLOCK_NUMBERS),
        .phase_us = (uint16_t)epoch->phase_us,
        .lag_us = (uint16_t)epoch->lag_us,
        .target_ms = (uint8_t)epoch->target_ms,
        .sure = clock->proven,
        .to_come = to_come,
        .changes = clock->next.any,
    };
    hal_can_frame_t frame;
    if (!can_frame_clock_encode(&frame, &message))
        return false;
    frame.own = true;
    if (hal_can_send(can, &frame) != HAL_OK)
        return false;
    clock->counter = (uint8_t)((clock->counter + 1) % CAN_E2E_P01_COUNTERS);
    clock->say[clock->said++] = frame; /* at most two a step */
    return true;
}

static void announce(frame_clock_t *clock, hal_can_t *can, int64_t number, int64_t now_us)
{
    if (now_us < clock->due_us)
        return;
    if (clock->next.any && !send(clock, can, &clock->next, clock->next.from))
        return;
    if (!send(clock, can, &clock->now, number - FRAME_LEAD_PAST)) /* whoever hears it is past that */
        return;
    clock->sent_us = now_us;
    clock->due_us = now_us + CAN_FRAME_CLOCK_PERIOD_MS * 1000;
}

/* Does nothing of what this leader says get out? Then somebody else may lead by now. */
static bool is_unheard(const frame_clock_t *clock, int64_t now_us)
{
    const int64_t heard_us = clock->own_us > clock->led_since_us ? clock->own_us : clock->led_since_us;
    return now_us - heard_us >= FRAME_CLOCK_SILENT_US;
}

static void cease_to_lead(frame_clock_t *clock, int64_t now_us)
{
    clock->leading = false;
    clock->leader = 0;
    frame_clock_drop_change(clock);
    clock->quiet_since_us = now_us;
}

void frame_lead_decide(frame_clock_t *clock, const frame_blank_t *blank)
{
    const int64_t patience_us = FRAME_CLOCK_SILENT_US + (int64_t)clock->node * FRAME_CLOCK_TURN_US;
    if (clock->leading && (!blank->bus_time_known || is_unheard(clock, blank->now_us)))
        cease_to_lead(clock, blank->now_us);
    else if (!clock->leading && blank->bus_time_known && frame_rate_period_us(clock->rate) <= PERIOD_MOST_US &&
             blank->now_us - clock->quiet_since_us >= patience_us)
        begin_to_lead(clock, blank);
}

void frame_lead(frame_clock_t *clock, hal_can_t *can, const frame_step_t *step, const frame_blank_t *blank)
{
    watch(clock, step, blank);
    announce(clock, can, step->number, blank->now_us);
}
