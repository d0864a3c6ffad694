// SPDX-License-Identifier: Apache-2.0
// What a board says of itself, onto the bus.
#ifndef FIRMWARE_TELEMETRY_H
#define FIRMWARE_TELEMETRY_H

#include <stdint.h>

#include "firmware/stage_times.h"

typedef struct projector projector_t;

/** When what was last sent, and the fault counts at the last heartbeat. */
typedef struct {
    int64_t start_us;
    int64_t heartbeat_due_us, status_due_us, stage_due_us, quality_due_us, time_due_us, latency_due_us, counts_due_us,
        update_due_us;
    uint8_t heartbeat_counter, status_counter, stage_counter, quality_counter, time_counter, step_counter,
        latency_counter, counts_counter, update_counter;
    uint8_t update_state, update_plan; /**< of the newest Update */
    uint32_t fault_flags;              /**< of the newest heartbeat */
    stage_t stage;                     /**< the next to be sent */
    stage_figures_t figures;           /**< of the second that is being sent */
    int64_t photon_sum_us;             /**< pose to photon of the pictures since the last Latency, */
    int32_t photons;                   /**< so many */
    uint32_t seen_bus, seen_bus_off, seen_display, seen_gpio, seen_watchdog, seen_deadline, seen_refused;
} telemetry_t;

/** Start to count from now on; the first messages are due at once, those of the stages after the first second. */
void telemetry_init(telemetry_t *telemetry, int64_t now_us);

/** A picture was made: how old its pose is when it is seen. */
void telemetry_add_photon(telemetry_t *telemetry, int32_t pose_to_photon_us);

/** Send what is due: Step at the contents that all boards report; status, stages, quality, time, latency, counts,
 *  update and heartbeat, each after its CAN_..._PERIOD_MS, update also when its state or plan is another. Call it once
 * a refresh. Never blocks. */
void telemetry_send(projector_t *projector, int64_t now_us);

/** Send the heartbeat alone, when it is due: for a board that can't do its work. */
void telemetry_send_life(projector_t *projector, int64_t now_us);

#endif
