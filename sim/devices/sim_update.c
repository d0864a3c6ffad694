// SPDX-License-Identifier: Apache-2.0
// The update agent in the simulator, and the board's way through a switch.
#include "sim/devices/sim_update.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum { NOTHING, INSTALL, SWITCH, GOOD } request_t;

struct hal_update {
    sim_update_settings_t settings;
    sim_update_faults_t faults;
    hal_update_state_t state;
    int64_t now_us, due_us; /* end of the install, or of the time that the board is down for */
    request_t request;
    int64_t taken_us; /* when it will be */
    char source[HAL_UPDATE_SOURCE_LENGTH];
    char installing[HAL_UPDATE_VERSION_LENGTH];
    bool down, back; /* back: after starts that failed, in its own slot again */
    int64_t switched_us;
};

static void set_text(char *text, size_t size, const char *from)
{
    (void)snprintf(text, size, "%s", from);
}

hal_update_t *sim_update_create(const sim_update_settings_t *settings, int64_t now_us, char error[FILE_ERROR_LENGTH])
{
    if (!hal_update_is_version(settings->running) || settings->install_us < 1 || settings->reboot_us < 1) {
        file_error(error, "update",
                   "version \"%.40s\", install %lld us, reboot %lld us: expected a version, 1 us or more",
                   settings->running, (long long)settings->install_us, (long long)settings->reboot_us);
        return NULL;
    }
    hal_update_t *u = calloc(1, sizeof *u);
    if (u == NULL) {
        file_error(error, "update", "out of memory");
        return NULL;
    }
    u->settings = *settings;
    u->state.slot = 'A';
    set_text(u->state.running, sizeof u->state.running, settings->running);
    u->now_us = now_us;
    u->switched_us = INT64_MIN;
    return u;
}

void sim_update_destroy(hal_update_t *update)
{
    free(update);
}

sim_update_faults_t *sim_update_faults(hal_update_t *update)
{
    return &update->faults;
}

int64_t sim_update_switched_us(const hal_update_t *update)
{
    return update->switched_us;
}

const hal_update_state_t *sim_update_said(const hal_update_t *update)
{
    return &update->state;
}

/* ".../wallwarp-host-0.6.raucb" -> "0.6". @return false when it is no bundle. */
static bool read_source(char version[HAL_UPDATE_VERSION_LENGTH], const char *source)
{
    static const char ending[] = ".raucb";
    const char *from = strrchr(source, '-'), *to = strrchr(source, '.');
    if (from == NULL || to == NULL || to < from + 2 || to - from > HAL_UPDATE_VERSION_LENGTH || strcmp(to, ending) != 0)
        return false;
    (void)snprintf(version, HAL_UPDATE_VERSION_LENGTH, "%.*s", (int)(to - from - 1), from + 1);
    return true;
}

static void fail(hal_update_t *u, const char *what, const char *which)
{
    u->state.doing = HAL_UPDATE_FAILED;
    (void)snprintf(u->state.message, sizeof u->state.message, "%.90s: %s", which, what);
}

static void begin_install(hal_update_t *u)
{
    u->state.waiting[0] = u->state.other[0] = u->state.message[0] = '\0'; /* the slot is written from its beginning */
    u->state.progress = 0;
    if (!read_source(u->installing, u->source)) {
        fail(u, "not a bundle", u->source);
        return;
    }
    u->state.doing = HAL_UPDATE_INSTALLING;
    u->due_us = u->taken_us + u->settings.install_us;
}

static void begin_switch(hal_update_t *u)
{
    if (u->state.other[0] == '\0') {
        fail(u, "there is nothing to start from", "other slot");
        return;
    }
    u->state.doing = HAL_UPDATE_SWITCHING;
    u->down = true;
    u->due_us = u->taken_us + u->settings.reboot_us;
}

static void take_request(hal_update_t *u)
{
    const request_t request = u->request;
    u->request = NOTHING;
    if (request == INSTALL)
        begin_install(u);
    else if (request == SWITCH)
        begin_switch(u);
    else
        u->state.trial = u->state.trial && u->faults.good;
}

static void go_on_installing(hal_update_t *u)
{
    const int64_t left_us = u->due_us - u->now_us;
    u->state.progress = left_us <= 0 ? 100 : (int32_t)(100 - 100 * left_us / u->settings.install_us);
    if (left_us > 0)
        return;
    if (u->faults.install) {
        fail(u, "signature verification failed", u->source);
        return;
    }
    u->state.doing = HAL_UPDATE_READY;
    set_text(u->state.waiting, sizeof u->state.waiting, u->installing);
    set_text(u->state.other, sizeof u->state.other, u->installing);
}

static void change_slots(hal_update_t *u)
{
    char before[HAL_UPDATE_VERSION_LENGTH];
    memcpy(before, u->state.running, sizeof before);
    memcpy(u->state.running, u->state.other, sizeof before);
    memcpy(u->state.other, before, sizeof before);
    u->state.waiting[0] = u->state.message[0] = '\0';
    u->state.slot = u->state.slot == 'A' ? 'B' : 'A';
    u->state.doing = HAL_UPDATE_IDLE;
    u->state.progress = 0;
    u->state.trial = true;
}

/* The board comes up: in the other slot; or after starts that failed in its own, which is good. */
static void come_up(hal_update_t *u)
{
    if (u->faults.start && !u->back) {
        u->back = true;
        u->due_us += SIM_UPDATE_STARTS_TRIED * u->settings.reboot_us;
        return;
    }
    u->down = false;
    if (!u->back) {
        change_slots(u);
        return;
    }
    u->back = false;
    fail(u, "did not start, the board is back in its former slot", u->state.other);
    u->state.waiting[0] = u->state.other[0] = '\0';
}

sim_update_board_t sim_update_advance(hal_update_t *u, int64_t now_us)
{
    if (u == NULL)
        return SIM_UPDATE_RUNS;
    u->now_us = now_us;
    if (u->request != NOTHING && now_us >= u->taken_us)
        take_request(u);
    if (u->state.doing == HAL_UPDATE_INSTALLING)
        go_on_installing(u);
    if (!u->down)
        return SIM_UPDATE_RUNS;
    if (now_us >= u->due_us)
        come_up(u);
    return u->down ? SIM_UPDATE_DOWN : SIM_UPDATE_STARTS;
}

hal_status_t hal_update_state(hal_update_t *u, hal_update_state_t *state)
{
    if (u == NULL || u->request != NOTHING)
        return u == NULL ? HAL_EMPTY : HAL_FULL;
    *state = u->state;
    return HAL_OK;
}

static hal_status_t ask(hal_update_t *u, request_t request)
{
    if (u == NULL || u->request != NOTHING)
        return u == NULL ? HAL_EMPTY : HAL_FULL;
    u->request = request;
    u->taken_us = u->now_us + SIM_UPDATE_TAKE_US;
    return HAL_OK;
}

hal_status_t hal_update_install(hal_update_t *update, const char *source)
{
    if (!hal_update_is_source(source))
        return HAL_BAD_CALL;
    const hal_status_t status = ask(update, INSTALL);
    if (status == HAL_OK)
        set_text(update->source, sizeof update->source, source);
    return status;
}

hal_status_t hal_update_switch(hal_update_t *update)
{
    const hal_status_t status = ask(update, SWITCH);
    if (status == HAL_OK)
        update->switched_us = update->now_us;
    return status;
}

hal_status_t hal_update_good(hal_update_t *update)
{
    return ask(update, GOOD);
}
