// SPDX-License-Identifier: Apache-2.0
// A simulated camera with its video, for tests: 100 small pictures a second.
#ifndef TESTS_SUPPORT_CAMERA_RIG_H
#define TESTS_SUPPORT_CAMERA_RIG_H

#include "sim/devices/sim_camera.h"

enum { RIG_WIDTH = 64, RIG_HEIGHT = 32, RIG_START_US = 5000, RIG_PERIOD_US = 10000 };

typedef struct {
    video_t *video;
    hal_camera_t *camera;
} camera_rig_t;

/** Picture n is captured at camera_rig_time_us(n), and can be taken at once. */
sim_camera_settings_t camera_rig_settings(video_t *video);

/** Open a video and a camera that plays it, with the usual settings. The test fails when that fails. */
camera_rig_t camera_rig_open(const char *name);

void camera_rig_close(const camera_rig_t *rig);

/** When picture n is captured. */
int64_t camera_rig_time_us(int64_t n);

/** sim_camera_advance() that must succeed. */
void camera_rig_advance(const camera_rig_t *rig, int64_t now_us);

/** Advance, then take and give back. @return The sequence number, or minus the status when nothing was taken. */
int64_t camera_rig_sequence_at(const camera_rig_t *rig, int64_t now_us);

/** @return How many rows of a lent picture differ from frame n of the video; these must be one band. */
int camera_rig_spoilt_rows(const camera_rig_t *rig, const hal_camera_frame_t *frame, int64_t n);

#endif
