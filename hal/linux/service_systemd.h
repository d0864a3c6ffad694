// SPDX-License-Identifier: Apache-2.0
// The service manager (hal/hal_service.h): systemd, or any other that reads the same messages (sd_notify(3)).
//
// The protocol is a datagram of NAME=VALUE lines to the socket that $NOTIFY_SOCKET names; systemd promises to keep it,
// and its manual shows how to speak it without libsystemd. Here that is done for the frame path: libsystemd's call
// makes a new socket each time, and waits when systemd is busy.
#ifndef HAL_LINUX_SERVICE_SYSTEMD_H
#define HAL_LINUX_SERVICE_SYSTEMD_H

#include "hal/hal_board.h"

/**
 * Find out who started this process: from $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID.
 *
 * @param[out] service  Written only when HAL_OK is returned; NULL when no manager wants to be told.
 * @param[out] error    On failure: one line.
 * @return HAL_OK; HAL_IO when there is a manager, but its socket can't be used.
 */
MUST_CHECK hal_status_t service_systemd_open(hal_service_t **service, char error[HAL_BOARD_ERROR_LENGTH]);

/** Tell it that the firmware ends. NULL is allowed. */
void service_systemd_close(hal_service_t *service);

#endif
