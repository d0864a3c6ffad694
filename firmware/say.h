// SPDX-License-Identifier: Apache-2.0
// What the firmware says to people on stderr, a line at a time; into systemd's journal with its priority.
#ifndef FIRMWARE_SAY_H
#define FIRMWARE_SAY_H

/** "wallwarp: LINE", priority 3 (error). Start-up only. */
void say_error(const char *line);

/** "warning: LINE", priority 4 (warning). Start-up only. */
void say_warning(const char *line);

#endif
