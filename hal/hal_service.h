// SPDX-License-Identifier: Apache-2.0
// Contract of the service manager: who started the firmware, shows people how it does, and starts it again when it
// hangs.
#ifndef HAL_HAL_SERVICE_H
#define HAL_HAL_SERVICE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct hal_service hal_service_t;

/** How the firmware does, once a step. */
typedef struct {
    int64_t now_us;    /**< on hal_time's clock */
    const char *state; /**< in a few words, for people; must stay as it is for as long as the service is open */
    bool showing;      /**< at least one picture has been presented */
    bool healthy;      /**< proof of life, on the terms of hal_watchdog_feed() */
} hal_service_report_t;

/**
 * Tell it. Never blocks, never allocates. What the manager does not take at once is told again at a later call.
 *
 * It hears that the firmware is ready at the first report that is showing; that it lives at healthy ones, no more often
 * than it needs; and the state whenever that is another one.
 *
 * @param service  NULL does nothing.
 */
void hal_service_report(hal_service_t *service, const hal_service_report_t *report);

#endif
