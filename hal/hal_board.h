// SPDX-License-Identifier: Apache-2.0
// A board: its devices by handle, and the table that says which they are.
#ifndef HAL_HAL_BOARD_H
#define HAL_HAL_BOARD_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_camera.h"
#include "hal/hal_can.h"
#include "hal/hal_display.h"
#include "hal/hal_gpio.h"
#include "hal/hal_service.h"
#include "hal/hal_status.h"
#include "hal/hal_time.h"
#include "hal/hal_update.h"
#include "hal/hal_watchdog.h"
#include "hal/hal_workers.h"

enum { HAL_BOARD_ERROR_LENGTH = 256, HAL_BOARD_HELP_LENGTH = 512, HAL_BOARD_NO_LINE = -1 };

/** The open devices of one board. Handles are opaque; each HAL defines the structs behind them. */
typedef struct {
    hal_can_t *can;
    hal_camera_t *camera;
    hal_display_t *display;
    hal_gpio_t *gpio;
    hal_time_t *clock;
    hal_watchdog_t *watchdog;
    hal_workers_t *workers; /**< NULL: the loop's thread alone */
    hal_service_t *service; /**< NULL: nobody is told how the firmware does */
    hal_update_t *update;   /**< NULL: there is no update agent */
    void *own;              /**< what the HAL keeps behind its devices, or NULL */
} hal_board_t;

/** Where the digital lines are. */
typedef struct {
    const char *chip;             /**< name or label of the chip that has them; NULL: the board has none */
    int32_t line[HAL_GPIO_LINES]; /**< by hal_gpio_line_t: its offset on the chip, or HAL_BOARD_NO_LINE: setting it does
                                     nothing, and no edge ever comes */
} hal_board_lines_t;

/** What a board is made of: one constant of this type in board/NAME/board.c. Names are the HAL's own. */
typedef struct {
    const char *name;    /**< of the board, as in BOARD=NAME */
    const char *machine; /**< a name that its device tree lists as compatible, its chip's for one; NULL: any machine; of
                                no meaning in the simulator */
    const char *can;     /**< bus: an interface (can0), or in the simulator a port of 127.0.0.1 */
    const char *camera;  /**< video source: a device, or in the simulator a picture or video file, or "pattern";
                                there a format may be before it, as in nv12:FILE */
    const char *display; /**< where pictures go: a connector, or in the simulator a folder, or "none"; there a format
                                that it takes besides XRGB8888 may be before it, as in nv12:none */
    hal_board_lines_t lines; /**< of no meaning in the simulator, which has them all */
    const char *watchdog;    /**< device that resets the board, or NULL for none; of no meaning in the simulator */
    hal_workers_settings_t workers; /**< threads that make a picture together */
} board_table_t;

extern const board_table_t board_table;

/** What bus, camera and display are called in a board_table_t: sentences for the help of programs, at most
 *  HAL_BOARD_HELP_LENGTH - 1 characters. */
extern const char hal_board_help[];

/** What the room file asks of the devices. */
typedef struct {
    int32_t picture_width, picture_height;   /**< of the camera's pictures, pixels */
    int32_t panel_width, panel_height;       /**< of the projector, pixels */
    int32_t refresh_frames, refresh_seconds; /**< of the projector, refreshes a second as a fraction: 60000 / 1001 */
    int32_t bitrate, data_bitrate;           /**< of the bus, bit/s */
    bool fd;                                 /**< the bus carries CAN FD */
} hal_board_needs_t;

/**
 * Open every device of the board, in order; on failure close those already open, in reverse.
 *
 * @param[out] board   Written only when HAL_OK is returned.
 * @param      table   Which devices; must live as long as the board is open.
 * @param      needs   Sizes and rates.
 * @param[out] error   On failure: one line, what failed, with which device, and what to do.
 * @return HAL_OK; HAL_IO when a name or size is wrong, or a device is missing or refuses.
 */
MUST_CHECK hal_status_t hal_board_open(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                       char error[HAL_BOARD_ERROR_LENGTH]);

/**
 * Open what is there of a board that can't do its work, so that it can say so: clock, bus as it is set up, display in
 * the size and rate that the projector prefers, lines, service manager, update agent, watchdog. What is missing is told
 * on stderr.
 *
 * @param[out] board  Written only when HAL_OK is returned; then for hal_board_close(). Bus and display are NULL where
 *                    they could not be opened, camera and workers always; all others may be used, also where they do
 *                    nothing.
 * @param      table  As for hal_board_open(). A bus of NULL is left alone; on another machine only the display is
 *                    opened, as the rest may not be what its name says. Where the display is missing another one of
 *                    the board is taken, if there is one.
 * @param[out] error  On failure: one line.
 * @return HAL_OK; HAL_IO when not even that can be had.
 */
MUST_CHECK hal_status_t hal_board_open_some(hal_board_t *board, const board_table_t *table,
                                            char error[HAL_BOARD_ERROR_LENGTH]);

/** Close every device, in reverse, and leave the outputs in their safe state. */
void hal_board_close(hal_board_t *board);

/**
 * Drive every output low, and do nothing else: for the time after a firmware that did not get to hal_board_close().
 *
 * @param[out] error  On failure: one line, as from hal_board_open().
 * @return HAL_OK, also when the board has no lines; HAL_IO when the chip is missing or a line is held by a program.
 */
MUST_CHECK hal_status_t hal_board_outputs_off(const board_table_t *table, char error[HAL_BOARD_ERROR_LENGTH]);

/** What hal_board_check() thinks of a thing that it has looked at. */
typedef enum {
    HAL_CHECK_FOUND,  /**< there, and as it is needed */
    HAL_CHECK_ADVICE, /**< the firmware starts, but would do better after the command */
    HAL_CHECK_MISSING /**< hal_board_open() would fail */
} hal_check_t;

/**
 * Take note of one thing that was looked at.
 *
 * @param line  What was found: "can: can0, 500000 bit/s"; where that is not as needed, also what was expected and the
 *              command that mends it, as in the errors of hal_board_open().
 */
typedef void hal_check_print_fn(void *context, hal_check_t what, const char *line);

/**
 * Look at everything that hal_board_open() would need, without opening anything for itself alone and without changing
 * anything. A firmware that runs meanwhile does not notice.
 *
 * @param needs  What the room file asks for, or NULL to leave that out.
 * @param print  Called for each thing, in the order of hal_board_t.
 * @return Nothing was HAL_CHECK_MISSING.
 */
MUST_CHECK bool hal_board_check(const board_table_t *table, const hal_board_needs_t *needs, hal_check_print_fn *print,
                                void *context);

#endif
