// SPDX-License-Identifier: Apache-2.0
// Prints what a board is made of, how it is wired, and how it is set up.
#include "board/board_info.h"

static void print_devices(FILE *to, const board_table_t *table, const board_info_t *info)
{
    const hal_workers_settings_t *workers = &table->workers;
    fprintf(to, "%s\n\n| device | name |\n|---|---|\n", info->machine);
    fprintf(to, "| bus | `%s` |\n| video | `%s` |\n| projector | `%s` |\n", table->can, table->camera, table->display);
    if (table->lines.chip != NULL)
        fprintf(to, "| lines | `%s` |\n", table->lines.chip);
    if (table->watchdog != NULL)
        fprintf(to, "| watchdog | `%s` |\n", table->watchdog);
    fprintf(to, "| threads | %d", (int)workers->count);
    if (workers->first_core != HAL_WORKERS_ANY_CORE && workers->count == 1)
        fprintf(to, ", on core %d", (int)workers->first_core);
    else if (workers->first_core != HAL_WORKERS_ANY_CORE)
        fprintf(to, ", on cores %d to %d", (int)workers->first_core, (int)(workers->first_core + workers->count - 1));
    if (workers->priority != 0)
        fprintf(to, ", real-time priority %d", (int)workers->priority);
    fprintf(to, " |\n");
}

static void print_wire(FILE *to, const board_wire_t *wire, const board_table_t *table, const char *prefix)
{
    if (wire->pin == BOARD_NO_PIN)
        fprintf(to, "| | ");
    else
        fprintf(to, "| %d | ", (int)wire->pin);
    if (wire->line == BOARD_WIRE_FIXED)
        fprintf(to, "%s", wire->signal);
    else
        fprintf(to, "%s%d, %s", prefix, (int)table->lines.line[wire->line],
                hal_gpio_line_name((hal_gpio_line_t)wire->line));
    fprintf(to, " | %s |\n", wire->to);
}

/* @return Has every line that the board has exactly one wire, and no other line any? */
static bool lines_are_wired(const board_table_t *table, const board_info_t *info)
{
    for (hal_gpio_line_t line = 0; line < HAL_GPIO_LINES; line++) {
        const bool there = table->lines.chip != NULL && table->lines.line[line] != HAL_BOARD_NO_LINE;
        int wires = 0;
        for (const board_wire_t *wire = info->wire; wire != NULL && wire->to != NULL; wire++)
            wires += wire->line == (int32_t)line;
        if (wires != (there ? 1 : 0)) {
            fprintf(stderr, "board/%s/info.c: line %s has %d wires, expected %d\n", table->name,
                    hal_gpio_line_name(line), wires, there ? 1 : 0);
            return false;
        }
    }
    return true;
}

bool board_info_print(FILE *to, const board_table_t *table, const board_info_t *info)
{
    if (!lines_are_wired(table, info))
        return false;
    print_devices(to, table, info);
    if (info->wire != NULL)
        fprintf(to, "\n| %s | signal | to |\n|---|---|---|\n", info->header);
    for (const board_wire_t *wire = info->wire; wire != NULL && wire->to != NULL; wire++)
        print_wire(to, wire, table, info->line_prefix);
    for (int i = 0; i < BOARD_STEPS && info->step[i].where != NULL; i++)
        fprintf(to, "\n%s:\n\n```\n%s```\n", info->step[i].where, info->step[i].lines);
    return ferror(to) == 0;
}
