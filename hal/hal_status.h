// SPDX-License-Identifier: Apache-2.0
// What every HAL call returns.
#ifndef HAL_HAL_STATUS_H
#define HAL_HAL_STATUS_H

#define MUST_CHECK __attribute__((warn_unused_result))

typedef enum {
    HAL_OK = 0,   /**< done; outputs are written */
    HAL_EMPTY,    /**< nothing there yet; no fault; ask again later */
    HAL_FULL,     /**< no room at the moment; nothing was taken; ask again later */
    HAL_BAD_CALL, /**< an argument breaks the contract: a bug of the caller, or a wrong setting */
    HAL_IO        /**< the device failed or is gone; the handle stays good, call again */
} hal_status_t;

#endif
