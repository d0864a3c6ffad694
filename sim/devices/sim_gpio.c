// SPDX-License-Identifier: Apache-2.0
// The board's digital lines in the simulator (hal/hal_gpio.h): what was driven, and a genlock input to feed.
#include "sim/devices/sim_gpio.h"

#include <stdlib.h>

struct hal_gpio {
    const hal_time_t *clock;
    bool high[HAL_GPIO_LINES];
    sim_gpio_edge_t log[SIM_GPIO_LOG_EDGES]; /**< edge n is at n % SIM_GPIO_LOG_EDGES */
    uint64_t log_count;
    int64_t genlock_us[SIM_GPIO_INPUT_EDGES]; /**< edge n is at n % SIM_GPIO_INPUT_EDGES */
    uint64_t genlock_taken, genlock_count;
    sim_gpio_faults_t faults;
};

hal_gpio_t *sim_gpio_create(const hal_time_t *clock, char error[FILE_ERROR_LENGTH])
{
    hal_gpio_t *gpio = calloc(1, sizeof *gpio);
    if (gpio == NULL) {
        file_error(error, "gpio", "out of memory");
        return NULL;
    }
    gpio->clock = clock;
    return gpio;
}

void sim_gpio_destroy(hal_gpio_t *gpio)
{
    free(gpio);
}

sim_gpio_faults_t *sim_gpio_faults(hal_gpio_t *gpio)
{
    return &gpio->faults;
}

bool sim_gpio_level(const hal_gpio_t *gpio, hal_gpio_line_t line)
{
    return gpio->high[line];
}

uint64_t sim_gpio_edge_count(const hal_gpio_t *gpio)
{
    return gpio->log_count;
}

bool sim_gpio_edge(const hal_gpio_t *gpio, uint64_t n, sim_gpio_edge_t *edge)
{
    if (n >= gpio->log_count || gpio->log_count - n > SIM_GPIO_LOG_EDGES)
        return false;
    *edge = gpio->log[n % SIM_GPIO_LOG_EDGES];
    return true;
}

void sim_gpio_genlock(hal_gpio_t *gpio, int64_t time_us)
{
    if (gpio->faults.stuck[HAL_GPIO_GENLOCK])
        return;
    gpio->genlock_us[gpio->genlock_count++ % SIM_GPIO_INPUT_EDGES] = time_us;
    if (gpio->genlock_count - gpio->genlock_taken > SIM_GPIO_INPUT_EDGES)
        gpio->genlock_taken++;
}

hal_status_t hal_gpio_set(hal_gpio_t *gpio, hal_gpio_line_t line, bool high)
{
    if (line == HAL_GPIO_GENLOCK || line >= HAL_GPIO_LINES)
        return HAL_BAD_CALL;
    if (gpio->faults.io)
        return HAL_IO;
    if (gpio->faults.stuck[line] || gpio->high[line] == high)
        return HAL_OK;
    gpio->high[line] = high;
    gpio->log[gpio->log_count++ % SIM_GPIO_LOG_EDGES] = (sim_gpio_edge_t){hal_time_now_us(gpio->clock), line, high};
    return HAL_OK;
}

hal_status_t hal_gpio_take_edge(hal_gpio_t *gpio, hal_gpio_line_t line, int64_t *time_us)
{
    if (line != HAL_GPIO_GENLOCK)
        return HAL_BAD_CALL;
    if (gpio->faults.io)
        return HAL_IO;
    if (gpio->genlock_taken == gpio->genlock_count)
        return HAL_EMPTY;
    *time_us = gpio->genlock_us[gpio->genlock_taken++ % SIM_GPIO_INPUT_EDGES];
    return HAL_OK;
}
