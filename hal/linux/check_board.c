// SPDX-License-Identifier: Apache-2.0
// hal_board_check() on Linux: every part, in the order of hal_board_t; the machine comes last.
#include "hal/linux/check.h"

bool hal_board_check(const board_table_t *table, const hal_board_needs_t *needs, hal_check_print_fn *print,
                     void *context)
{
    check_t check = {.table = table, .needs = needs, .print = print, .context = context, .root = ""};
    check_can(&check);
    check_camera(&check);
    check_display(&check);
    check_lines(&check);
    check_watchdog(&check);
    check_update(&check);
    check_system(&check);
    return !check.missing;
}
