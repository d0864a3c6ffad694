// SPDX-License-Identifier: Apache-2.0
// The tables and the bus log of a run, written while it goes on.
#ifndef SIM_RUN_RUN_FILES_H
#define SIM_RUN_RUN_FILES_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "sim/bus/sim_bus.h"
#include "sim/files/file_io.h"
#include "sim/run/run_record.h"

/**
 * frames.csv, timings.csv and bus.log in one folder; psnr.csv is written at the end. Everything but timings.csv is the
 * same, byte for byte, in two runs in virtual time.
 *
 * frames.csv   frame,time_s,board,state,pose,k_in,k_all,lit_pixels; pose is empty while the safe picture is shown
 * timings.csv  frame,board,step_ms: real time of each step on this machine
 * psnr.csv     frame,board,psnr_db,limit_db,original_psnr_db,original_limit_db,coverage; inf where nothing differs,
 *              empty where there is no original
 * bus.log      every frame on the bus as candump -l writes it, times since the start of the run
 */
typedef struct {
    const char *folder;
    FILE *frames, *timings, *bus;
    int64_t start_us; /**< bus time of the start of the run */
} run_files_t;

/** Make the folder if need be, and the files. @return false with the reason in error; nothing is open then. */
bool run_files_open(run_files_t *files, const char *folder, int64_t start_us, char error[FILE_ERROR_LENGTH]);

/** A listener for sim_bus_set_log(), its context a run_files_t. */
void run_files_log(void *context, int sender, const hal_can_frame_t *frame);

/** Write the newest frame of the record. */
void run_files_add(run_files_t *files, const run_record_t *record, const room_t *room);

/** Write psnr.csv, and close all. @return false with the reason in error when anything could not be written. */
bool run_files_close(run_files_t *files, const run_record_t *record, const room_t *room, char error[FILE_ERROR_LENGTH]);

#endif
