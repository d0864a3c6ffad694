// SPDX-License-Identifier: Apache-2.0
// The video devices that this process has open, by a library or itself: was one unplugged, and is it back?
#ifndef HAL_LINUX_CAMERA_UNPLUGGED_H
#define HAL_LINUX_CAMERA_UNPLUGGED_H

#include <stdbool.h>
#include <stdint.h>

enum { CAMERA_PLACES = 16, CAMERA_PLACE_LENGTH = 200 };

/** Folders of sysfs, each of which is there while one of these devices is; those that find no room are left out. */
typedef struct {
    int32_t count;
    char folder[CAMERA_PLACES][CAMERA_PLACE_LENGTH];
} camera_places_t;

/* All look through all open files, or at the system's: no frame's work. */

/** @return Is a file open of a V4L2 device that the kernel has no more? */
bool camera_unplugged(void);

/**
 * Close each such file, and leave in its place one in which nothing ever happens: poll() returns at once for what is
 * gone, and a library's thread that waits for it would take a core, of the loop's priority or above.
 */
void camera_unplugged_drop(void);

/** Note where the open V4L2 devices are. */
void camera_places_note(camera_places_t *places);

/** @return Are there devices in each of these places, and is it one at least? They may be others than were noted. */
bool camera_places_are_taken(const camera_places_t *places);

/** @return Is one of them on USB? */
bool camera_places_have_usb(const camera_places_t *places);

/** Let no library of this process hear from udev any more that a device has come or gone. */
void camera_udev_silence(void);

#endif
