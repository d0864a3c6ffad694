// SPDX-License-Identifier: Apache-2.0
// What a kind of camera must do: functions that the thread of camera_keeper.h calls, and no other.
#ifndef HAL_LINUX_CAMERA_SOURCE_H
#define HAL_LINUX_CAMERA_SOURCE_H

#include <stdbool.h>
#include <stdint.h>
#include <unistd.h>

#include "hal/linux/camera_exchange.h"
#include "hal/linux/camera_name.h"
#include "hal/linux/camera_text.h"

/** What every source is given. */
typedef struct {
    camera_name_t name;
    int32_t width, height;
    int32_t rate_frames, rate_seconds;
    camera_exchange_t *exchange; /**< where pictures go */
    int wake;                    /**< readable when a picture was given back, or the camera is to be closed */
} camera_wanted_t;

/** Errors are a line without the camera's name. All may block, for seconds. */
typedef struct {
    /** @return What the other calls are given, closed yet; or NULL when there is no memory. */
    void *(*create)(const camera_wanted_t *wanted);

    /** Open the device, so that pictures may come. @return false with the reason; nothing is left open then. */
    bool (*open)(void *source, char error[HAL_BOARD_ERROR_LENGTH]);

    /**
     * Wait, for half a second at most, for a picture, a returned buffer or a change, and do what it asks for.
     *
     * @param[out] news  What the user must know, as that there is no signal; else left as it is.
     * @return false with the reason in news when the device is lost and must be opened anew.
     */
    bool (*serve)(void *source, char news[HAL_BOARD_ERROR_LENGTH]);

    /** Close the device. The exchange is withdrawn already. */
    void (*close)(void *source);

    void (*destroy)(void *source);
} camera_source_t;

/** Make the wake handle wait again, before what it called for is looked at. */
static inline void camera_wake_clear(int wake)
{
    uint64_t pokes;
    if (read(wake, &pokes, sizeof pokes) < 0)
        return; /* nobody poked */
}

#endif
