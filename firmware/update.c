// SPDX-License-Identifier: Apache-2.0
// A board's update: what an operator asks for, and the mark that the running version is good.
#include "firmware/update.h"

#include <string.h>

#include "firmware/projector.h"

void update_init(update_t *update, int64_t now_us)
{
    *update = (update_t){.read_due_us = now_us};
}

/* A request is with the agent: what it said before is out of date. */
static void expect(update_t *u, hal_update_doing_t doing, int64_t now_us)
{
    u->said.doing = doing;
    u->said.progress = 0;
    u->said.message[0] = '\0';
    u->read_due_us = now_us + UPDATE_TOLD_US;
}

static bool busy(const update_t *u)
{
    return u->said.doing == HAL_UPDATE_INSTALLING || u->said.doing == HAL_UPDATE_SWITCHING;
}

static update_refusal_t install(projector_t *p, const char *source, int64_t now_us)
{
    update_t *u = &p->update;
    if (u->said.doing == HAL_UPDATE_INSTALLING && strcmp(u->source, source) == 0)
        return UPDATE_DONE;
    if (busy(u) || u->plan != UPDATE_NO_PLAN)
        return UPDATE_BUSY;
    if (u->said.trial)
        return UPDATE_ON_TRIAL;
    if (hal_update_install(p->board.update, source) != HAL_OK)
        return UPDATE_NOT_TOLD;
    memcpy(u->source, source, strlen(source) + 1);
    u->said.waiting[0] = u->said.other[0] = '\0';
    expect(u, HAL_UPDATE_INSTALLING, now_us);
    return UPDATE_DONE;
}

static bool can_switch(const update_t *u, const char *version)
{
    return u->agent && !busy(u) && strcmp(u->said.other, version) == 0;
}

/* The clocks' rates differ by less than 2^-10: a second step leaves less than 60 us of the farthest moment. */
static int64_t local_from_bus(const bus_time_t *time, int64_t bus_us, int64_t now_us)
{
    const int64_t local_us = now_us + bus_us - bus_time_from_local(time, now_us);
    return local_us + bus_us - bus_time_from_local(time, local_us);
}

static update_refusal_t promise(projector_t *p, const command_t *command, int64_t now_us)
{
    update_t *u = &p->update;
    const bool same = u->switch_bus_us == command->bus_time_us && strcmp(u->version, command->text) == 0;
    if (u->plan != UPDATE_NO_PLAN && same)
        return UPDATE_DONE;
    if (busy(u) || u->plan == UPDATE_CONFIRMED)
        return UPDATE_BUSY; /* the others will not wait for this board */
    if (!can_switch(u, command->text))
        return UPDATE_NOT_THERE;
    if (!bus_master_knows(&p->time, now_us))
        return UPDATE_NO_TIME;
    const int64_t ahead_us = (int64_t)command->bus_time_us - bus_time_from_local(&p->time.time, now_us);
    if (ahead_us <= 0 || ahead_us > UPDATE_MOST_AHEAD_US)
        return UPDATE_BAD_TIME;
    u->plan = UPDATE_PROMISED;
    u->switch_bus_us = command->bus_time_us;
    u->switch_us = local_from_bus(&p->time.time, (int64_t)command->bus_time_us, now_us);
    memcpy(u->version, command->text, sizeof u->version);
    return UPDATE_DONE;
}

static update_refusal_t confirm(update_t *u, uint64_t bus_time_us, int64_t now_us)
{
    if (u->plan == UPDATE_NO_PLAN || u->switch_bus_us != bus_time_us)
        return UPDATE_NO_PROMISE;
    if (now_us >= u->switch_us)
        return UPDATE_BAD_TIME;
    u->plan = UPDATE_CONFIRMED;
    return UPDATE_DONE;
}

update_refusal_t update_execute(projector_t *p, const command_t *command, int64_t now_us)
{
    update_t *u = &p->update;
    if (command->update == COMMAND_UPDATE_STATUS)
        return UPDATE_DONE;
    if (!u->agent)
        return UPDATE_NO_AGENT;
    switch (command->update) {
    case COMMAND_UPDATE_INSTALL:
        return install(p, command->text, now_us);
    case COMMAND_UPDATE_SWITCH:
        return promise(p, command, now_us);
    case COMMAND_UPDATE_CONFIRM:
        return confirm(u, command->bus_time_us, now_us);
    case COMMAND_UPDATE_CANCEL:
        u->plan = UPDATE_NO_PLAN;
        return u->said.doing == HAL_UPDATE_SWITCHING ? UPDATE_BUSY : UPDATE_DONE;
    case COMMAND_UPDATE_STATUS:
    case COMMAND_UPDATES:
        break;
    }
    return UPDATE_DONE;
}

static void judge_frame(projector_t *p)
{
    update_t *u = &p->update;
    const projector_faults_t *f = &p->faults;
    const uint32_t faults =
        f->camera + f->picture_size + f->gpio + f->watchdog; /* the display's make the state fault */
    const bool failed = faults != u->seen_faults || p->report.state == CAN_BOARD_FAULT ||
                        hal_can_state(p->board.can) == HAL_CAN_BUS_OFF;
    u->seen_faults = faults;
    if (failed)
        u->healthy = 0;
    else if (p->report.times.shown && !p->report.times.late && u->healthy < UPDATE_GOOD_FRAMES)
        u->healthy++;
}

static void read_state(projector_t *p, int64_t now_us)
{
    update_t *u = &p->update;
    hal_update_state_t said;
    const hal_status_t status = hal_update_state(p->board.update, &said);
    u->read_due_us = now_us + UPDATE_READ_US;
    if (status == HAL_EMPTY)
        *u = (update_t){.read_due_us = u->read_due_us, .healthy = u->healthy, .seen_faults = u->seen_faults};
    if (status != HAL_OK)
        return; /* what cannot be read leaves what is known */
    u->agent = true;
    u->said = said;
    if (u->plan != UPDATE_NO_PLAN && !can_switch(u, u->version))
        u->plan = UPDATE_NO_PLAN; /* somebody has plugged a stick in */
    if (said.trial && !u->told_good && !busy(u) && u->healthy >= UPDATE_GOOD_FRAMES)
        u->told_good = hal_update_good(p->board.update) == HAL_OK;
}

/* One try: what the agent can't be told now it must not be told later than the other boards'. */
static void switch_at_last(projector_t *p, int64_t now_us)
{
    update_t *u = &p->update;
    const bool wanted = u->plan == UPDATE_CONFIRMED && now_us - u->switch_us <= UPDATE_LATE_US;
    u->plan = UPDATE_NO_PLAN;
    if (wanted && hal_update_switch(p->board.update) == HAL_OK)
        expect(u, HAL_UPDATE_SWITCHING, now_us);
}

void update_step(projector_t *p, int64_t now_us)
{
    update_t *u = &p->update;
    judge_frame(p);
    if (u->plan != UPDATE_NO_PLAN && now_us >= u->switch_us)
        switch_at_last(p, now_us);
    if (now_us >= u->read_due_us)
        read_state(p, now_us);
}
