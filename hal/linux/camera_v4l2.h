// SPDX-License-Identifier: Apache-2.0
// Video from a V4L2 device: HDMI receivers on CSI or PCIe, USB capture devices and cameras, and the kernel's vivid.
#ifndef HAL_LINUX_CAMERA_V4L2_H
#define HAL_LINUX_CAMERA_V4L2_H

#include "hal/linux/camera_source.h"

/**
 * v4l2:DEVICE or v4l2:DEVICE+RECEIVER.
 *
 * DEVICE    /dev/video0, /dev/v4l/by-path/..., a name that `v4l2-ctl --list-devices` shows (of the card or its bus
 *           place), or "auto": the first that captures. A name finds the device again when it got another number.
 * RECEIVER  the sub-device of the HDMI receiver where the video device does not pass timings on (Raspberry Pi 5,
 *           i.MX8M Plus): /dev/v4l-subdev2, or its name as "tc358743 10-000f". The links and formats between both are
 *           set before, with media-ctl: see the board's page.
 *
 * Formats: the first of camera_v4l2_formats that the device gives in the room's size and that fits picture.h, or the
 * one that the camera's name asks for.
 *
 * Of a receiver the EDID is set (edid.h), and the pictures begin when the source sends the room's size. On a change of
 * the source they stop, and begin anew when it is right again; while it is not, that is said once.
 *
 * A device without a picture for 5 s, or that fails, is closed and opened anew.
 */
extern const camera_source_t camera_v4l2;

#endif
