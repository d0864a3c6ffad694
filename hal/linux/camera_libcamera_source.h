// SPDX-License-Identifier: Apache-2.0
// Video through libcamera: camera sensors with the board's image processor, and USB cameras.
#ifndef HAL_LINUX_CAMERA_LIBCAMERA_SOURCE_H
#define HAL_LINUX_CAMERA_LIBCAMERA_SOURCE_H

#include "hal/linux/camera_source.h"

/**
 * libcamera:CAMERA, with its number in the list of `cam -l` counted from 0, its whole name there, or the model of its
 * sensor (imx219). HDMI receivers are not in that list: they are V4L2's (camera_v4l2.h).
 *
 * Built for libcamera 0.0.3 (Debian 12) and 0.4 (Debian 13); the compiler's headers decide. One such camera a process.
 *
 * The buffers are the library's DMABUFs, mapped once, and made to agree with the CPU's caches for each picture. The
 * library has threads of its own: two named as ours, which it makes when it is started, and those of its tracer
 * (PROGRAM-ust). It uses the heap for each request.
 *
 * Some pipelines have four buffers and no more (USB's, vimc's): while the loop holds three of them, as it does in a
 * room that waits for its slowest board, pictures are lost. USB cameras do better as v4l2:DEVICE.
 *
 * Times are of the sensor's first line (SensorTimestamp), on CLOCK_MONOTONIC (camera_stamp_us()).
 *
 * After a loss the whole library is started anew with each attempt to open. A USB camera comes back when it is plugged
 * in again; that needs udev, whose messages the library waits for. A sensor's devices that vanish while it runs are
 * lost to the program: libcamera (0.0.3) would end it when it closes them, or when it hears from udev that they are
 * back, which it is kept from. When they are, the program sends itself SIGTERM, so that it ends in order and its
 * service starts it anew. Both are said.
 */
extern const camera_source_t camera_libcamera;

#endif
