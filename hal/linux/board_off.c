// SPDX-License-Identifier: Apache-2.0
// hal_board_outputs_off() on Linux: taking the lines drives their outputs low, and so does giving them back.
#include <stddef.h>

#include "hal/linux/gpio_gpiod.h"

hal_status_t hal_board_outputs_off(const board_table_t *table, char error[HAL_BOARD_ERROR_LENGTH])
{
    hal_gpio_t *gpio;
    if (table->lines.chip == NULL)
        return HAL_OK;
    const hal_status_t status = gpio_gpiod_open(&gpio, &table->lines, error);
    if (status == HAL_OK)
        gpio_gpiod_close(gpio);
    return status;
}
