// SPDX-License-Identifier: Apache-2.0
// The service manager in the simulator (hal/hal_service.h): notes what it was told.
#ifndef SIM_DEVICES_SIM_SERVICE_H
#define SIM_DEVICES_SIM_SERVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_service.h"
#include "sim/files/file_io.h"

/** What it knows. */
typedef struct {
    uint64_t reports;          /**< calls so far */
    uint64_t healthy;          /**< of them */
    uint64_t states;           /**< times that the state was another one, the first one included */
    int64_t ready_us;          /**< time of the first report that was showing; INT64_MIN before it */
    hal_service_report_t last; /**< the newest; of no meaning before the first */
} sim_service_heard_t;

/** @return NULL with the reason in error when there is no memory. Uses the heap. */
hal_service_t *sim_service_create(char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void sim_service_destroy(hal_service_t *service);

const sim_service_heard_t *sim_service_heard(const hal_service_t *service);

#endif
