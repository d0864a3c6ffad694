// SPDX-License-Identifier: Apache-2.0
// The update agent in the simulator (hal/hal_update.h), and the board's way through a switch: down, and up again in the
// other slot, or back in its own.
//
// A source holds the version that its name ends with: .../wallwarp-BOARD-VERSION.raucb. Any other name is no bundle,
// and its install fails.
#ifndef SIM_DEVICES_SIM_UPDATE_H
#define SIM_DEVICES_SIM_UPDATE_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_update.h"
#include "sim/files/file_io.h"

enum {
    SIM_UPDATE_TAKE_US = 300000, /**< until the agent has taken a request; its state is out of date so long */
    SIM_UPDATE_STARTS_TRIED = 3  /**< of a version that does not start, before the board goes back */
};

/** What every board's agent does. */
typedef struct {
    const char *running; /**< version at first, in slot A; slot B is empty */
    int64_t install_us;  /**< that an install takes */
    int64_t reboot_us;   /**< from a switch until the firmware starts */
} sim_update_settings_t;

/** Faults on demand, to be set and cleared at any time. */
typedef struct {
    bool install; /**< installs fail at their end */
    bool start;   /**< a version that is on trial does not start */
    bool good;    /**< the mark can't be written: the version stays on trial */
} sim_update_faults_t;

/** @return NULL with the reason in error: bad settings, or no memory. Uses the heap. @param now_us  As below. */
hal_update_t *sim_update_create(const sim_update_settings_t *settings, int64_t now_us, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void sim_update_destroy(hal_update_t *update);

sim_update_faults_t *sim_update_faults(hal_update_t *update);

typedef enum {
    SIM_UPDATE_RUNS,
    SIM_UPDATE_DOWN,  /**< the firmware does not run, and the board hears and says nothing */
    SIM_UPDATE_STARTS /**< the firmware is to be started anew now */
} sim_update_board_t;

/** Let the agent work until now_us, of any steady clock. @return What the board does. NULL always runs. */
sim_update_board_t sim_update_advance(hal_update_t *update, int64_t now_us);

/** @return When the newest switch was asked for, as told to the sim_update_advance() before; INT64_MIN: never. */
int64_t sim_update_switched_us(const hal_update_t *update);

/** @return What it would say now, whether or not a request is waiting. */
const hal_update_state_t *sim_update_said(const hal_update_t *update);

#endif
