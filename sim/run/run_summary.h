// SPDX-License-Identifier: Apache-2.0
// A finished run, for those who tell about it: the table, the plots, the page.
#ifndef SIM_RUN_RUN_SUMMARY_H
#define SIM_RUN_RUN_SUMMARY_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "sim/bus/sim_bus.h"
#include "sim/run/run_record.h"

typedef struct {
    const room_t *room;
    const run_record_t *record;
    const char *folder; /**< where its files are */
    const char *room_name, *video_name;
    const char *poses_name;    /**< NULL when the poses came over a port */
    const char *original_name; /**< NULL for none */
    const char *method_name;   /**< of all boards; NULL for each its own */
    double rate_hz;            /**< refresh */
    bool real;                 /**< real time */
    int64_t skipped;           /**< refreshes that real time did not allow */
    int64_t poses_sent;        /**< by the simulated tracker */
    bool genlock;              /**< there was a house signal */
    sim_bus_stats_t bus;
} run_summary_t;

/** Print the short table: each board, the bus, and where the page is. */
void run_summary_print(const run_summary_t *summary, FILE *file);

/** @return The name of the method that a board used. */
const char *run_summary_method(const run_summary_t *summary, int32_t board);

/** @return The largest load of the bus from one frame to the next, parts per million. */
int32_t run_summary_peak_load_ppm(const run_summary_t *summary);

#endif
