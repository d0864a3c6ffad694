// SPDX-License-Identifier: Apache-2.0
// The board's digital lines in the simulator (hal/hal_gpio.h): what was driven, and a genlock input to feed.
#ifndef SIM_DEVICES_SIM_GPIO_H
#define SIM_DEVICES_SIM_GPIO_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_gpio.h"
#include "hal/hal_time.h"
#include "sim/files/file_io.h"

enum { SIM_GPIO_LOG_EDGES = 1024, SIM_GPIO_INPUT_EDGES = 16 };

/** One change of an output. */
typedef struct {
    int64_t time_us; /**< on the board's clock */
    hal_gpio_line_t line;
    bool high;
} sim_gpio_edge_t;

typedef struct {
    bool io;                    /**< every call fails with HAL_IO and changes nothing */
    bool stuck[HAL_GPIO_LINES]; /**< an output keeps its level though calls succeed; an input sees no edges */
} sim_gpio_faults_t;

/**
 * @param clock  The board's; must outlive the lines. All outputs start low.
 * @return NULL with the reason in error when there is no memory. Uses the heap.
 */
hal_gpio_t *sim_gpio_create(const hal_time_t *clock, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void sim_gpio_destroy(hal_gpio_t *gpio);

/** @return The faults, to be set and cleared at any time between the firmware's steps. */
sim_gpio_faults_t *sim_gpio_faults(hal_gpio_t *gpio);

/** @return The level an output has now. */
bool sim_gpio_level(const hal_gpio_t *gpio, hal_gpio_line_t line);

/** @return How many edges all outputs have made; setting a line to the level it has is none. */
uint64_t sim_gpio_edge_count(const hal_gpio_t *gpio);

/**
 * Read the log.
 *
 * @param      n     Which edge, from 0; the newest SIM_GPIO_LOG_EDGES are kept.
 * @param[out] edge  Written only when true is returned.
 * @return false when edge n has not happened, or is forgotten.
 */
bool sim_gpio_edge(const hal_gpio_t *gpio, uint64_t n, sim_gpio_edge_t *edge);

/** Let the genlock input rise, at that time of the board's clock. SIM_GPIO_INPUT_EDGES are kept, the newest ones. */
void sim_gpio_genlock(hal_gpio_t *gpio, int64_t time_us);

#endif
