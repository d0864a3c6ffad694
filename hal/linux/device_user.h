// SPDX-License-Identifier: Apache-2.0
// Which other program has a device open: for messages to people.
#ifndef HAL_LINUX_DEVICE_USER_H
#define HAL_LINUX_DEVICE_USER_H

#include <stdbool.h>

enum { DEVICE_USER_LENGTH = 64 };

/**
 * Write the name and number of the first other process that has a device open, as "Xorg (process 512)"; "another
 * program" when /proc tells of none: not root, or a process that may not be looked into. Not for the frame path: looks
 * at every open file of every process.
 *
 * @param path  Of the device: /dev/dri/card0.
 * @return Does /proc tell of one?
 */
bool device_user(char user[DEVICE_USER_LENGTH], const char *path);

#endif
