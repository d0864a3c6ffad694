// SPDX-License-Identifier: Apache-2.0
// The parts of hal_board_check() on Linux: each looks at one device, and says what it found.
#ifndef HAL_LINUX_CHECK_H
#define HAL_LINUX_CHECK_H

#include <stdbool.h>
#include <stddef.h>

#include "hal/hal_board.h"
#include "hal/linux/camera_name.h"

enum { CHECK_LINE_LENGTH = 512, CHECK_WORD_LENGTH = 96 };

typedef struct {
    const board_table_t *table;
    const hal_board_needs_t *needs; /**< NULL: only what the table names */
    hal_check_print_fn *print;
    void *context;
    const char *root; /**< before /sys, /proc and /dev: "", or a test's folder */
    bool missing;     /**< something was */
} check_t;

/** What is there, printf-like. */
void check_found(check_t *check, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** What could be better; mend is the command that makes it so. */
void check_advise(check_t *check, const char *mend, const char *format, ...) __attribute__((format(printf, 3, 4)));

/** What is missing, and the command that mends it; NULL when the text has it. */
void check_miss(check_t *check, const char *mend, const char *format, ...) __attribute__((format(printf, 3, 4)));

/**
 * Read the first line of a small file, as /sys and /proc have them, without its newline.
 *
 * @param      path  Put behind the root.
 * @param[out] text  Written only when true is returned.
 * @return false when there is no such file, or it can't be read, or is empty.
 */
bool check_read(const check_t *check, const char *path, char *text, size_t size);

/**
 * Miss a device that can't be opened: why, and the command that mends it.
 *
 * @param what     The part, as the line begins with it: "camera".
 * @param failure  errno of open().
 * @param group    That may open such devices: "video".
 */
void check_refused(check_t *check, const char *what, const char *device, int failure, const char *group);

/**
 * Miss a device that another program has; but find one that a running firmware has.
 *
 * @param who  The program, as device_user() has it.
 */
void check_held(check_t *check, const char *what, const char *device, const char *who, const char *mend);

/** The bus: interface, its state and bit rates, FD, kind of time stamps. */
void check_can(check_t *check);

/** The video source: driver, formats, sizes, signal and EDID of an HDMI receiver. */
void check_camera(check_t *check);

/** check_camera() of a camera of libcamera's: what it lists, and whether the wanted one has the wanted pictures. */
void check_libcamera(check_t *check, const camera_name_t *name);

/** The projector: connectors, their modes, who has the display. */
void check_display(check_t *check);

/** The digital lines: the chip, and who holds which of them. */
void check_lines(check_t *check);

/** The watchdog: is it there, and who has it. */
void check_watchdog(check_t *check);

/** Updates: is there an agent, and is it started; the slot, its version and whether that is marked good; what waits. */
void check_update(check_t *check);

/** Rights and the machine: priority, locked memory, cores, their governor, the clock source. */
void check_system(check_t *check);

#endif
