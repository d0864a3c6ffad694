// SPDX-License-Identifier: Apache-2.0
// Sends what a log or another bus says, in its own time, with faults when asked: `wallwarp-pose replay` and `fault`.
#ifndef SIM_POSE_BUS_PUMP_H
#define SIM_POSE_BUS_PUMP_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"
#include "sim/pose/pose_link.h"
#include "sim/rng.h"

enum { BUS_PUMP_MESSAGE_LENGTH = 512, BUS_PUMP_PENDING = 256, BUS_PUMP_MOST_DELAY_MS = 60000 };

/** What happens to frames on their way, each by chance and by itself. All zero: nothing. */
typedef struct {
    int32_t drop_ppm, duplicate_ppm, corrupt_ppm, delay_ppm; /**< chances in a million */
    int32_t delay_ms;                                        /**< of frames that are delayed */
} bus_faults_t;

/** What the pump did. */
typedef struct {
    int64_t taken; /**< frames from the source that were to be sent */
    int64_t sent, dropped, duplicated, corrupted, delayed;
} bus_pump_counts_t;

/**
 * Let faults strike a frame.
 *
 * A dropped frame meets nothing else. A corrupted one has one to three bits of its data turned, if it has data; its
 * copy has the same ones.
 *
 * @param         faults  What may strike.
 * @param[in,out] rng     The chance.
 * @param[in,out] frame   As it came; as it goes on.
 * @param[in,out] counts  Counted up, but for taken and sent.
 * @param[out]    late    Is it to be sent delay_ms later? Written only when it is not dropped.
 * @return How often to send it: 0, 1 or 2.
 */
int bus_pump_strike(const bus_faults_t *faults, rng_t *rng, hal_can_frame_t *frame, bus_pump_counts_t *counts,
                    bool *late);

typedef struct {
    const char *bus;  /**< where to */
    const char *log;  /**< where from: a file of candump -l lines; NULL: from_bus */
    const char *from; /**< another bus; NULL: log */
    double speed;     /**< of a log: 2 sends it in half of its time; above 0 */
    bool fd;          /**< CAN FD frames are sent too; else they are left out */
    bool reports;     /**< what boards say and bus time are sent too; else they are left out */
    bus_faults_t faults;
    uint64_t seed;                     /**< of the faults */
    const volatile sig_atomic_t *stop; /**< ends it when it becomes non-zero; looked at every 100 ms */
} bus_pump_t;

/**
 * Send until the log is at its end or the pump is stopped; of another bus, until that bus is gone.
 *
 * @param[out] counts  Also on failure.
 * @param[out] error   On failure: one line without newline; of a log "FILE:LINE: what was expected".
 * @return false when a bus or the log could not be opened or read, or the link failed.
 */
bool bus_pump(const bus_pump_t *pump, bus_pump_counts_t *counts, char error[BUS_PUMP_MESSAGE_LENGTH]);

#endif
