// SPDX-License-Identifier: Apache-2.0
// What a projector gives to know besides its wall and its bus: lines, watchdog, service manager.
#include "firmware/projector.h"
#include "firmware/state_led.h"

void projector_drive(projector_t *p, hal_gpio_line_t line, bool high)
{
    if (hal_gpio_set(p->board.gpio, line, high) != HAL_OK)
        p->faults.gpio++;
}

void projector_light(projector_t *p, int64_t now_us)
{
    projector_drive(p, HAL_GPIO_LED, state_led_level(p->report.state, now_us));
    projector_drive(p, HAL_GPIO_LAMP, p->report.frame_number > 0); /* light only what is meant to be seen */
}

void projector_tell_life(projector_t *p, const char *state, bool healthy, int64_t now_us)
{
    const bool alive = healthy && !commands_reboot(&p->commands);
    const hal_service_report_t report = {now_us, state, p->report.frame_number > 0, alive};
    if (alive && hal_watchdog_feed(p->board.watchdog) != HAL_OK)
        p->faults.watchdog++;
    hal_service_report(p->board.service, &report);
}
