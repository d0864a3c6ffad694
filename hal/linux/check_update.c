// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): the update agent and what it says. A board works without it.
#include <stdio.h>
#include <unistd.h>

#include "hal/linux/check.h"
#include "hal/linux/update_folder.h"

static bool has(const check_t *check, const char *path)
{
    char full[CHECK_LINE_LENGTH];
    (void)snprintf(full, sizeof full, "%s%s", check->root, path);
    return access(full, F_OK) == 0;
}

static void check_unit(check_t *check, const char *unit)
{
    char path[CHECK_LINE_LENGTH], mend[CHECK_LINE_LENGTH];
    (void)snprintf(path, sizeof path, "/etc/systemd/system/multi-user.target.wants/%s", unit);
    (void)snprintf(mend, sizeof mend, "sudo systemctl enable --now %s", unit);
    if (!has(check, path))
        check_advise(check, mend, "updates: %s is not enabled, expected it at each start", unit);
}

static void say_versions(check_t *check, const hal_update_state_t *state)
{
    check_found(check, "updates: slot %c, version %s, %s", state->slot,
                state->running[0] == '\0' ? "unknown" : state->running,
                state->trial ? "on trial until it has shown good pictures" : "marked good");
    if (state->doing == HAL_UPDATE_INSTALLING)
        check_found(check, "updates: installing, %d %%: %s", (int)state->progress, state->message);
    else if (state->waiting[0] != '\0')
        check_found(check, "updates: version %s waits for the switch", state->waiting);
    else if (state->other[0] != '\0')
        check_found(check, "updates: version %s is in the other slot, to go back to", state->other);
    if (state->doing == HAL_UPDATE_FAILED)
        check_found(check, "updates: the last request failed: %s", state->message);
}

static void check_agent(check_t *check, hal_update_t *agent)
{
    hal_update_state_t state;
    const hal_status_t status = hal_update_state(agent, &state);
    if (status == HAL_OK)
        say_versions(check, &state);
    else if (status == HAL_FULL)
        check_found(check, "updates: the update agent has not answered the last request yet");
    else
        check_advise(check, "sudo systemctl restart wallwarp-update-start; journalctl -u wallwarp-update-start",
                     "updates: %s/state can't be read, expected the update agent's lines", update_folder_path);
}

void check_update(check_t *check)
{
    char folder[CHECK_LINE_LENGTH], error[HAL_BOARD_ERROR_LENGTH];
    hal_update_t *agent = NULL;
    if (!has(check, "/usr/local/lib/wallwarp/update_agent")) {
        check_found(check, "updates: there is no update agent, as on a board that was not installed from an image");
        return;
    }
    check_unit(check, "wallwarp-update-start.service");
    check_unit(check, "wallwarp-update.path");
    (void)snprintf(folder, sizeof folder, "%s%s", check->root, update_folder_path);
    if (update_folder_open(&agent, folder, error) != HAL_OK)
        agent = NULL;
    check_agent(check, agent);
    update_folder_close(agent);
}
