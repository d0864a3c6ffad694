// SPDX-License-Identifier: Apache-2.0
// The same frame on all walls: what is heard, and what it says of a refresh.
#include "firmware/frame_clock.h"

#include "firmware/frame_lead.h"

enum { OWN_RUN_US = 150000, STALE_REFRESHES = 12 };

void frame_clock_init(frame_clock_t *clock, uint8_t node, frame_rate_t rate, int32_t pose_delay_us, int64_t now_us)
{
    *clock = (frame_clock_t){
        .node = node, .rate = rate, .pose_delay_us = pose_delay_us, .quiet_since_us = now_us, .due_us = now_us};
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

int64_t frame_clock_picture_number(const frame_clock_t *clock, int64_t capture_bus_us)
{
    const frame_epoch_t *epoch = &clock->now;
    /* start(n) >= capture + lag - period / 4, and start(n - 1) is not */
    const int64_t least_us = capture_bus_us + epoch->lag_us - frame_rate_period_us(clock->rate) / 4 - epoch->phase_us;
    return frame_rate_before(clock->rate, least_us - 1) + 1;
}

/* The number congruent to `from` that is nearest to n. */
static int64_t extend(uint16_t from, int64_t n)
{
    return n + (int16_t)(uint16_t)(from - (uint16_t)n);
}

static bool same_epoch(const frame_epoch_t *a, const frame_epoch_t *b)
{
    return a->any && b->any && a->number == b->number && a->phase_us == b->phase_us && a->lag_us == b->lag_us;
}

/* Is a newer than b? Numbers wrap: half of them are newer. */
static bool is_newer(const frame_epoch_t *a, const frame_epoch_t *b)
{
    const uint8_t ahead = (uint8_t)(a->number - b->number) % CAN_EPOCHS;
    return !b->any || (ahead > 0 && ahead < CAN_EPOCHS / 2);
}

void frame_clock_follow(frame_clock_t *clock, uint8_t leader)
{
    if (clock->leader != leader)
        clock->next.any = false; /* the old leader's change is off */
    clock->changes += clock->leader != 0 && clock->leader != leader;
    clock->leader = leader;
    clock->leading = leader == clock->node;
}

static bool is_proven(const frame_clock_t *clock, int64_t now_us)
{
    return clock->proven && now_us - clock->proven_us < FRAME_CLOCK_PROOF_US;
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
    clock->proven = true;
    clock->proven_us = now_us;
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
    if (!same_epoch(epoch, &clock->now)) {
        clock->missed += clock->proven;
        clock->now = *epoch;
        clock->proven = false;
    }
    clock->next.any &= heard->changes;
    if (!heard->sure || (heard->changes && !clock->next.any))
        return; /* what was proven until now stays so: there is time to hear of the change */
    clock->proven = true;
    clock->proven_us = now_us;
}

can_check_t frame_clock_hear(frame_clock_t *clock, const hal_can_frame_t *frame, int64_t now_us, int64_t now_bus_us)
{
    can_frame_clock_t heard;
    const can_check_t check = can_frame_clock_decode(&heard, frame);
    if (check != CAN_CHECK_OK)
        return check;
    if (frame->own) {
        hear_own(clock, &heard, now_us);
        return CAN_CHECK_OK;
    }
    frame_epoch_t epoch = {.any = true, .number = heard.epoch, .phase_us = heard.phase_us, .lag_us = heard.lag_us};
    const int64_t number = nearest(clock, &epoch, now_bus_us);
    epoch.from = extend(heard.from, number);
    if (epoch.from < number - (heard.to_come ? 1 : STALE_REFRESHES))
        return CAN_CHECK_OK; /* it has waited long in a queue */
    clock->proven = is_proven(clock, now_us);
    if (!heard.to_come && clock->proven && is_newer(&epoch, &clock->now)) {
        clock->now = epoch; /* the others are ahead: a change was missed */
        clock->proven = false;
        clock->missed++;
    }
    if (!is_better(clock, &heard, &epoch, now_us))
        return CAN_CHECK_OK;
    frame_clock_follow(clock, heard.node);
    obey(clock, &epoch, &heard, now_us);
    return CAN_CHECK_OK;
}

/* The refresh of the epoch that holds for it. */
static frame_step_t find_step(frame_clock_t *clock, const frame_blank_t *blank)
{
    const int64_t blank_us = blank->blank_us;
    int64_t number = nearest(clock, &clock->now, blank_us);
    if (clock->next.any && number >= clock->next.from) {
        /* Who has lost the leader, or as leader the others, since cannot know whether they have changed. */
        clock->proven &= blank->now_us - clock->proven_us < FRAME_CLOCK_SILENT_US;
        if (clock->proven)
            clock->now = clock->next;
        clock->next.any = false;
        number = nearest(clock, &clock->now, blank_us);
    }
    const int64_t start_us = frame_clock_start_us(clock, number);
    return (frame_step_t){
        .number = number,
        .start_us = start_us,
        .pose_limit_us = start_us - clock->pose_delay_us,
        .picture_limit_us = start_us - clock->now.lag_us + frame_rate_period_us(clock->rate) / 4,
        .off_us = (int32_t)(blank_us - start_us),
    };
}

frame_step_t frame_clock_step(frame_clock_t *clock, hal_can_t *can, const frame_blank_t *blank)
{
    clock->proven = is_proven(clock, blank->now_us);
    frame_lead_decide(clock, blank);
    frame_step_t step = find_step(clock, blank);
    if (clock->leading)
        frame_lead(clock, can, &step, blank);
    const int32_t quarter_us = frame_rate_period_us(clock->rate) / 4;
    step.in_step = clock->now.any && clock->proven && blank->bus_time_known && step.off_us < quarter_us &&
                   step.off_us > -quarter_us;
    return step;
}
