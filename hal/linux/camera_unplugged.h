// SPDX-License-Identifier: Apache-2.0
// Was a video device unplugged that this process has open, by a library or itself?
#ifndef HAL_LINUX_CAMERA_UNPLUGGED_H
#define HAL_LINUX_CAMERA_UNPLUGGED_H

#include <stdbool.h>

/** @return Is a file open of a V4L2 device that the kernel has no more? Looks through all open files: no frame's work.
 */
bool camera_unplugged(void);

#endif
