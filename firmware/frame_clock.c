// SPDX-License-Identifier: Apache-2.0
// The same frame on all walls: what is heard, and what it says of a refresh.
#include "firmware/frame_clock.h"

#include "firmware/frame_latency.h"
#include "firmware/frame_lead.h"

enum { OWN_RUN_US = 150000, STALE_REFRESHES = 12 };

void frame_clock_init(frame_clock_t *clock, const frame_clock_settings_t *settings, int64_t now_us)
{
    const int32_t unit_us = CAN_LATENCY_DISPLAY_UNIT_US;
    *clock = (frame_clock_t){
        .node = settings->node,
        .rate = settings->rate,
        .pose_delay_us = settings->pose_delay_us,
        .display_us = (settings->display_us + unit_us / 2) / unit_us * unit_us,
        .quiet_since_us = now_us,
        .due_us = now_us,
    };
}

/* The refresh whose start is nearest. */
static int64_t nearest(const frame_clock_t *clock, const frame_epoch_t *epoch, int64_t bus_us)
{
    return frame_rate_before(clock->rate, bus_us - epoch->phase_us + frame_rate_period_us(clock->rate) / 2);
}

int64_t frame_clock_start_us(const frame_clock_t *clock, int64_t number)
{
    return frame_rate_length_us(clock->rate, number) + clock->now.phase_us;
}

int32_t frame_clock_off_us(const frame_clock_t *clock, int64_t bus_us)
{
    return (int32_t)(bus_us - frame_clock_start_us(clock, nearest(clock, &clock->now, bus_us)));
}

int64_t frame_clock_picture_number(const frame_clock_t *clock, const frame_epoch_t *epoch, int64_t capture_bus_us)
{
    /* start(n) >= capture + lag - period / 4, and start(n - 1) is not */
    const int64_t least_us = capture_bus_us + epoch->lag_us - frame_rate_period_us(clock->rate) / 4 - epoch->phase_us;
    return frame_rate_before(clock->rate, least_us - 1) + 1;
}

/* The number congruent to `from` that is nearest to n. */
static int64_t extend(uint16_t from, int64_t n)
{
    const int64_t half = CAN_FRAME_CLOCK_NUMBERS / 2, ahead = (from - n) & (CAN_FRAME_CLOCK_NUMBERS - 1);
    return n + (ahead < half ? ahead : ahead - 2 * half);
}

static bool same_epoch(const frame_epoch_t *a, const frame_epoch_t *b)
{
    return a->any && b->any && a->number == b->number && a->phase_us == b->phase_us && a->lag_us == b->lag_us &&
           a->target_ms == b->target_ms;
}

/* An epoch that was noticed only now: it may have begun at the refresh at which it was announced, and what held before
 * is not known. */
static void catch_up(frame_clock_t *clock, const frame_epoch_t *epoch)
{
    clock->missed += clock->proven;
    clock->now = *epoch;
    clock->now.from += FRAME_LEAD_PAST;
    clock->before.any = false;
    clock->proven = false;
}

/* Is a newer than b? Numbers wrap: half of them are newer. */
static bool is_newer(const frame_epoch_t *a, const frame_epoch_t *b)
{
    const uint8_t ahead = (uint8_t)(a->number - b->number) % CAN_EPOCHS;
    return !b->any || (ahead > 0 && ahead < CAN_EPOCHS / 2);
}

void frame_clock_drop_change(frame_clock_t *clock)
{
    if (clock->next.any)
        clock->doubt = clock->next;
    clock->next.any = false;
}

void frame_clock_follow(frame_clock_t *clock, uint8_t leader)
{
    if (clock->leader != leader)
        frame_clock_drop_change(clock); /* the old leader's */
    clock->changes += clock->leader != 0 && clock->leader != leader;
    clock->leader = leader;
    clock->leading = leader == clock->node;
}

static bool is_proven(const frame_clock_t *clock, int64_t now_us)
{
    return clock->proven && now_us - clock->proven_us < FRAME_CLOCK_PROOF_US;
}

/* What holds is known, and what is announced. */
static void prove(frame_clock_t *clock, int64_t now_us)
{
    clock->proven = true;
    clock->proven_us = now_us;
    clock->doubt.any = false;
}

static bool is_silent(const frame_clock_t *clock, int64_t now_us)
{
    return !clock->leading && now_us - clock->quiet_since_us >= FRAME_CLOCK_SILENT_US;
}

/*
 * An announcement of its own got out; one that had waited long in the queue says nothing of now. Only a run of them
 * proves something: a leader that comes back to the bus must hear the others before it speaks for them.
 */
static void hear_own(frame_clock_t *clock, const can_frame_clock_t *heard, int64_t now_us)
{
    const uint8_t newest = (uint8_t)((clock->counter + CAN_E2E_P01_COUNTERS - 1) % CAN_E2E_P01_COUNTERS);
    if (!clock->leading || heard->counter != newest || now_us - clock->sent_us > FRAME_LEAD_OWN_LATE_US)
        return;
    if (now_us - clock->own_us > FRAME_LEAD_OWN_LATE_US)
        clock->own_since_us = now_us;
    clock->own_us = now_us;
    if (now_us - clock->own_since_us < OWN_RUN_US)
        return;
    prove(clock, now_us);
}

/*
 * Is this whom to follow? Of two that know the same, the one with a change under way, for the others wait for it; then
 * the lower number. Who comes back with what no longer holds must listen first.
 */
static bool is_better(const frame_clock_t *clock, const can_frame_clock_t *heard, const frame_epoch_t *epoch,
                      int64_t now_us)
{
    if (!clock->proven || heard->node == clock->leader)
        return true;
    if (heard->to_come || !heard->sure || epoch->number != clock->now.number)
        return false;
    if (!same_epoch(epoch, &clock->now))
        return heard->node < clock->leader; /* two have begun at once */
    if (clock->leader == 0 || is_silent(clock, now_us))
        return true;
    return heard->changes == clock->next.any ? heard->node < clock->leader : heard->changes;
}

/* Take what the leader says. In step is who knows the epoch that holds, and the next one when there is one. */
static void obey(frame_clock_t *clock, const frame_epoch_t *epoch, const can_frame_clock_t *heard, int64_t now_us)
{
    clock->quiet_since_us = now_us;
    if (heard->to_come) {
        clock->next = *epoch;
        return;
    }
    if (!same_epoch(epoch, &clock->now))
        catch_up(clock, epoch);
    clock->next.any &= heard->changes;
    if (!heard->sure || (heard->changes && !clock->next.any))
        return; /* what was proven until now stays so: there is time to hear of the change */
    prove(clock, now_us);
}

static can_check_t hear_latency(frame_clock_t *clock, const hal_can_frame_t *frame, int64_t now_us)
{
    can_latency_t latency;
    const can_check_t check = can_latency_decode(&latency, frame);
    if (check == CAN_CHECK_OK && !frame->own)
        room_latency_note(&clock->room, &latency, now_us);
    return check;
}

can_check_t frame_clock_hear(frame_clock_t *clock, const hal_can_frame_t *frame, int64_t now_us, int64_t now_bus_us)
{
    can_frame_clock_t heard;
    const can_check_t check = can_frame_clock_decode(&heard, frame);
    if (check == CAN_CHECK_OTHER)
        return hear_latency(clock, frame, now_us);
    if (check != CAN_CHECK_OK)
        return check;
    if (frame->own) {
        hear_own(clock, &heard, now_us);
        return CAN_CHECK_OK;
    }
    frame_epoch_t epoch = {
        .any = true,
        .number = heard.epoch,
        .phase_us = heard.phase_us,
        .lag_us = heard.lag_us,
        .target_ms = heard.target_ms,
    };
    const int64_t number = nearest(clock, &epoch, now_bus_us);
    epoch.from = extend(heard.from, number);
    if (epoch.from < number - (heard.to_come ? 1 : STALE_REFRESHES))
        return CAN_CHECK_OK; /* it has waited long in a queue */
    clock->proven = is_proven(clock, now_us);
    if (!heard.to_come && clock->proven && is_newer(&epoch, &clock->now))
        catch_up(clock, &epoch); /* the others are ahead */
    if (!is_better(clock, &heard, &epoch, now_us))
        return CAN_CHECK_OK;
    frame_clock_follow(clock, heard.node);
    obey(clock, &epoch, &heard, now_us);
    return CAN_CHECK_OK;
}

/* The number of this refresh, of the epoch that holds for it. */
static int64_t find_number(frame_clock_t *clock, const frame_blank_t *blank)
{
    const int64_t number = nearest(clock, &clock->now, blank->blank_us);
    if (clock->doubt.any && number >= clock->doubt.from)
        clock->proven = false;
    if (!clock->next.any || number < clock->next.from)
        return number;
    /* Who has lost the leader, or as leader the others, since cannot know whether they have changed. */
    clock->proven &= blank->now_us - clock->proven_us < FRAME_CLOCK_SILENT_US;
    if (clock->proven) {
        clock->before = clock->now;
        clock->now = clock->next;
    }
    clock->next.any = false;
    return nearest(clock, &clock->now, blank->blank_us);
}

static frame_step_t find_step(frame_clock_t *clock, const frame_blank_t *blank)
{
    const int64_t number = find_number(clock, blank);
    const int32_t held = frame_latency_held(clock, clock->now.target_ms);
    frame_step_t step = {
        .number = number,
        .content = number - held,
        .held = held,
        .epoch = clock->now,
        .off_us = (int32_t)(blank->blank_us - frame_clock_start_us(clock, number)),
    };
    if (step.content < clock->now.from && clock->before.any)
        step.epoch = clock->before;
    step.start_us = frame_rate_length_us(clock->rate, step.content) + step.epoch.phase_us;
    step.pose_limit_us = step.start_us - clock->pose_delay_us;
    step.picture_limit_us = step.start_us - step.epoch.lag_us + frame_rate_period_us(clock->rate) / 4;
    return step;
}

static can_step_fault_t fault_of(const frame_clock_t *clock, const frame_step_t *step, const frame_blank_t *blank)
{
    const int32_t quarter_us = frame_rate_period_us(clock->rate) / 4;
    const bool known = step->content >= clock->now.from || (clock->before.any && step->content >= clock->before.from);
    if (!blank->bus_time_known)
        return CAN_STEP_NO_TIME;
    if (!clock->now.any || !clock->proven || (step->held > 0 && !known))
        return CAN_STEP_NO_CLOCK;
    return step->off_us < quarter_us && step->off_us > -quarter_us ? CAN_STEP_OK : CAN_STEP_PANEL;
}

frame_step_t frame_clock_step(frame_clock_t *clock, hal_can_t *can, const frame_blank_t *blank)
{
    const can_latency_t own = {
        .node = clock->node,
        .lag_us = (uint32_t)blank->lag_us,
        .display_us = (uint32_t)clock->display_us,
        .wanted_ms = (uint32_t)blank->wanted_ms,
    };
    room_latency_note(&clock->room, &own, blank->now_us);
    clock->said = 0;
    clock->proven = is_proven(clock, blank->now_us);
    frame_lead_decide(clock, blank);
    frame_step_t step = find_step(clock, blank);
    if (clock->leading)
        frame_lead(clock, can, &step, blank);
    step.fault = fault_of(clock, &step, blank);
    step.in_step = step.fault == CAN_STEP_OK;
    return step;
}
