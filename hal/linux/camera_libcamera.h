// SPDX-License-Identifier: Apache-2.0
// libcamera as C functions. Nothing that is thrown leaves them; what they mean is in camera_libcamera_source.h.
#ifndef HAL_LINUX_CAMERA_LIBCAMERA_H
#define HAL_LINUX_CAMERA_LIBCAMERA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hal/linux/camera_dmabuf.h"
#include "hal/linux/camera_name.h"

/** The library, started; and the camera of it that is used, from libcamera_acquire() on. */
typedef struct libcamera_session libcamera_session_t;

typedef struct {
    char id[CAMERA_WHICH_LENGTH];    /**< unique and lasting, as "/base/soc/i2c0mux/i2c@1/imx219@10" */
    char model[CAMERA_WHICH_LENGTH]; /**< as "imx219"; may be empty */
} libcamera_name_t;

typedef enum { LIBCAMERA_UNTOLD, LIBCAMERA_BT601, LIBCAMERA_BT709, LIBCAMERA_OTHER_COLOURS } libcamera_colours_t;

typedef struct {
    uint32_t fourcc; /**< of DRM: DRM_FORMAT_... */
    uint32_t width, height;
    uint32_t stride;             /**< bytes; known once it is configured */
    libcamera_colours_t colours; /**< of YUV; those with a name are of limited range */
    char colours_text[CAMERA_WHICH_LENGTH];
} libcamera_format_t;

/** One buffer of the camera. */
typedef struct {
    camera_dmabuf_t piece[PICTURE_MAX_PLANES];
    size_t count; /**< of pieces; 0: more than a picture has */
} libcamera_buffer_t;

/** How a buffer was filled. */
typedef struct {
    bool good;        /**< there is a picture in it */
    int64_t stamp_us; /**< of the sensor's first line: camera_stamp_us() */
    uint32_t sequence;
} libcamera_result_t;

/** Called by threads of the library: they must be short, and not call it. */
typedef struct {
    void (*filled)(void *context, int buffer);
    void (*gone)(void *context); /**< unplugged, as far as the pipeline notices; USB's does */
    void *context;
} libcamera_events_t;

/* Functions of type int return 0 or more, or the library's negative errno. */
#ifdef __cplusplus
extern "C" {
#endif

/** Start the library. One session a process. @param[out] session  Written only when 0 is returned. */
int libcamera_open(libcamera_session_t **session);

/** Stop and free everything: no event comes from then on. The library may end the process: see libcamera_abandon(). */
void libcamera_close(libcamera_session_t *session);

/** Leave everything as it is for ever: to stop a camera that is no longer there ends the process (libcamera 0.0.3). */
void libcamera_abandon(libcamera_session_t *session);

/** @return The number of cameras; each has a number below that. */
int libcamera_count(const libcamera_session_t *session);

void libcamera_name(const libcamera_session_t *session, int camera, libcamera_name_t *name);

/**
 * Ask what a camera makes of a wish for video: it changes what it can't give. Nothing is set.
 *
 * @param wish     Without stride; colours are a wish only where they are LIBCAMERA_BT709.
 * @param buffers  To be made.
 * @return -EINVAL when it makes nothing of it, -ENODEV when it has no video.
 */
int libcamera_try(libcamera_session_t *session, int camera, const libcamera_format_t *wish, unsigned buffers,
                  libcamera_format_t *given);

/** Take a camera for this process. */
int libcamera_acquire(libcamera_session_t *session, int camera);

/** Set what the last libcamera_try() gave, of the acquired camera. @param[out] stride  Of its rows, in bytes. */
int libcamera_configure(libcamera_session_t *session, uint32_t *stride);

/** Make the buffers. @param[out] buffers  Room for most of them. @return How many there are, which may be more. */
int libcamera_make_buffers(libcamera_session_t *session, libcamera_buffer_t *buffers, int most);

/** @param interval_us  From picture to picture, where the camera knows it. */
int libcamera_start(libcamera_session_t *session, const libcamera_events_t *events, int64_t interval_us);

/** Give the camera a buffer to be filled: each after libcamera_start(), then each that was filled. */
int libcamera_queue(libcamera_session_t *session, int buffer);

/** @param buffer  As events.filled had it, and not queued since. */
void libcamera_result(const libcamera_session_t *session, int buffer, libcamera_result_t *result);

#ifdef __cplusplus
}
#endif

#endif
