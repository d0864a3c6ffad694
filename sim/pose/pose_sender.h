// SPDX-License-Identifier: Apache-2.0
// A tracker on the simulated bus: sends a pose list, each pose at its own time, and gives bus time.
#ifndef SIM_POSE_POSE_SENDER_H
#define SIM_POSE_POSE_SENDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "firmware/bus_master.h"
#include "sim/bus/sim_bus.h"
#include "sim/pose/pose_auth.h"
#include "sim/pose/pose_list.h"

typedef struct {
    sim_bus_t *bus;
    const pose_list_t *list; /**< must outlive the sender */
    bool fd;                 /**< one CAN FD frame a pose, else a set of three classic frames */
    int64_t start_us;        /**< the simulation's time at which the list's first pose is sent */
    bool sync;               /**< give bus time: the simulation's */
    can_auth_t *key;         /**< of the room, must outlive the sender, which then gives bus time; NULL: it has none */
    uint64_t session;        /**< with a key: random */
} pose_sender_config_t;

/** Its fields are the sender's own, but for the counts. */
typedef struct {
    pose_sender_config_t config;
    hal_can_t *can;
    bus_master_t time;
    int64_t tick_us; /**< when it looks at the bus next, to give bus time */
    size_t next;     /**< entry of the list */
    uint8_t counter;
    pose_auth_t auth; /**< with a key */
    int64_t sent;     /**< poses queued on the controller */
    int64_t unsent;   /**< poses that could not be encoded, or that the controller refused */
} pose_sender_t;

/**
 * Plug the tracker in.
 *
 * @param[out] sender  Written only on success. Nothing to free: the controller lives as long as the bus.
 * @return false when the bus takes no more controllers.
 */
bool pose_sender_open(pose_sender_t *sender, const pose_sender_config_t *config);

/** Run the bus up to a moment, as sim_bus_advance() does, and send every pose whose time has come. Its capture time is
 *  that moment. */
void pose_sender_advance(pose_sender_t *sender, int64_t until_us);

#endif
