// SPDX-License-Identifier: Apache-2.0
// Faults that need no source: a flood, and bus-off on a virtual interface.
#ifndef SIM_POSE_BUS_FLOOD_H
#define SIM_POSE_BUS_FLOOD_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "sim/pose/pose_link.h"

typedef struct {
    uint32_t id; /**< 11 bits; the lower, the more it keeps from the bus */
    int64_t length_us;
    const volatile sig_atomic_t *stop; /**< ends it early when it becomes non-zero */
} bus_flood_t;

/**
 * Send frames of 8 bytes, more than a bus of 1 Mbit/s takes.
 *
 * @param[out] sent   Frames, also on failure.
 * @param[out] error  On failure: one line without newline.
 */
bool bus_flood(const char *bus, const bus_flood_t *flood, int64_t *sent, char error[POSE_LINK_MESSAGE_LENGTH]);

/**
 * Tell every listener of a virtual CAN interface that its controller is bus-off, by the error frame that a driver
 * would give it (linux/can/error.h, CAN_ERR_BUSOFF).
 *
 * @param[out] error  On failure: one line without newline. A real interface and a simulator are refused.
 */
bool bus_flood_bus_off(const char *bus, char error[POSE_LINK_MESSAGE_LENGTH]);

#endif
