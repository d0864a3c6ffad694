// SPDX-License-Identifier: Apache-2.0
// The camera in the simulator (hal/hal_camera.h): plays a video, and fails on demand.
#ifndef SIM_DEVICES_SIM_CAMERA_H
#define SIM_DEVICES_SIM_CAMERA_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_camera.h"
#include "hal/hal_time.h"
#include "sim/devices/sim_rate.h"
#include "sim/files/video_file.h"

/** All times are the simulation's; the HAL tells capture times on the board's clock. */
typedef struct {
    video_t *video;          /**< played; may be shared by cameras of one thread; must outlive the camera */
    int32_t width, height;   /**< as given to video_open() */
    picture_format_t format; /**< that it delivers */
    sim_rate_t rate;         /**< picture n is captured at beat n and shows video frame n; none before beat 0;
                                  frames = 0 stands for the video's own rate */
    int64_t latency_us;      /**< from capture_time_us to when the picture can be taken; 0 or more */
    const hal_time_t *clock; /**< the board's; must outlive the camera; NULL: it shows the simulation's time */
    uint32_t seed;           /**< of all chance in the faults: same seed, same faults */
} sim_camera_settings_t;

/** What goes wrong. Pictures are counted when they would arrive. All 0: nothing. */
typedef struct {
    uint32_t drop_next;         /**< lose this many pictures; counts down */
    uint32_t drop_ppm;          /**< lose each picture with this chance, in millionths */
    uint32_t corrupt_next;      /**< put a band of noise over this many delivered pictures; counts down */
    uint32_t corrupt_ppm;       /**< the same by chance */
    int64_t late_us;            /**< pictures arrive this much later; their capture_time_us stays */
    bool stuck;                 /**< pictures arrive, newly stamped, but picture and sequence stay the last ones */
    int64_t unplugged_until_us; /**< until then hal_camera_take() returns HAL_IO and pictures are lost; 0: never */
} sim_camera_faults_t;

typedef struct {
    uint64_t delivered; /**< made ready to be taken */
    uint64_t lost;      /**< by faults, or because they could not be decoded */
    uint64_t corrupted;
} sim_camera_counts_t;

/** @return A camera, or NULL with the reason in error: a bad setting, or no memory. Uses the heap. */
hal_camera_t *sim_camera_create(const sim_camera_settings_t *settings, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. Lent pictures die with the camera. */
void sim_camera_destroy(hal_camera_t *camera);

/**
 * Let time pass, between two steps of the firmware: decode the newest picture that has arrived, if any. Older ones
 * nobody can take any more are not decoded. Uses the heap; hal_camera_take() and hal_camera_release() do not.
 *
 * @param now_us  On the board's clock; never less than at the last call.
 * @return false with the reason in error when the video could not be read: that picture is lost, nothing else changes.
 */
bool sim_camera_advance(hal_camera_t *camera, int64_t now_us, char error[FILE_ERROR_LENGTH]);

/** @return The faults, to be set and cleared at any time between the firmware's steps. */
sim_camera_faults_t *sim_camera_faults(hal_camera_t *camera);

/** @return What has happened so far. */
sim_camera_counts_t sim_camera_counts(const hal_camera_t *camera);

#endif
