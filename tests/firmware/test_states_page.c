// SPDX-License-Identifier: Apache-2.0
// STATES.md says what is true: each fault of its table is made, and state, LED, wall, bus and watchdog are looked at.
#include "tests/firmware/operator_bench.h"

#include <stdio.h>
#include <stdlib.h>

#include "sim/pose/event_text.h"

enum { CELLS = 6, CELL_LENGTH = 64, LINE_LENGTH = 256, LED_MS = 1000, HOLDING_LED_MS = 800 };

static const char page_path[] = "firmware/STATES.md";

typedef struct {
    const char *what;
    void (*begin)(void);
    void (*end)(void); /* NULL: it does not */
    int after_ms;      /* from the beginning until all is looked at */
    int led_ms;        /* for so long; 0: LED_MS */
} fault_t;

static void nothing(void)
{
}

static void stop_poses(void)
{
    bench.tracking = false;
}

static void begin_poses(void)
{
    bench.tracking = true;
}

static void damage(uint32_t ppm)
{
    sim_bus_fail(sim_world_bus(bench.world), SIM_BUS_CORRUPT, (sim_bus_fail_t){.ppm = ppm, .only = devices()->can});
}

static void damage_poses(void)
{
    damage(1000000);
}

static void damage_some_poses(void)
{
    damage(200000);
}

static void mend_poses(void)
{
    damage(0);
}

static void flood_with(uint32_t id)
{
    const hal_can_frame_t frame = {.id = id, .length = 8};
    assert_int_equal(sim_bus_fail_flood(sim_world_bus(bench.world), &frame), HAL_OK);
}

static void flood(void)
{
    flood_with(0);
}

static void flood_gaps(void)
{
    flood_with(0x7FF);
}

static void end_flood(void)
{
    assert_int_equal(sim_bus_fail_flood(sim_world_bus(bench.world), NULL), HAL_OK);
}

static void break_driver(void)
{
    sim_bus_fail_driver(devices()->can, true);
}

static void mend_driver(void)
{
    sim_bus_fail_driver(devices()->can, false);
}

static void go_bus_off(void)
{
    sim_bus_fail_bus_off(devices()->can);
}

static void unplug_camera(void)
{
    sim_camera_faults(devices()->camera)->unplugged_until_us = INT64_MAX;
}

static void plug_camera(void)
{
    sim_camera_faults(devices()->camera)->unplugged_until_us = 0;
}

static void unplug_camera_for_a_while(void)
{
    unplug_camera();
    room_bench_run(&bench, 3000);
    plug_camera();
    room_bench_run(&bench, 1000);
    bench.voice[0].flags_ever = 0;
}

static void unplug_display(void)
{
    sim_display_faults(devices()->display)->unplugged_until_us = INT64_MAX;
}

static void plug_display(void)
{
    sim_display_faults(devices()->display)->unplugged_until_us = 0;
}

static void refuse_flips(void)
{
    sim_display_faults(devices()->display)->refuse_next = 1000000;
}

static void take_flips(void)
{
    sim_display_faults(devices()->display)->refuse_next = 0;
}

static void hold_buffers(void)
{
    sim_display_faults(devices()->display)->late_blanks = 1000000;
    sim_display_faults(devices()->display)->late_next = 1;
}

static void break_lines(void)
{
    sim_gpio_faults(devices()->gpio)->io = true;
}

static void mend_lines(void)
{
    sim_gpio_faults(devices()->gpio)->io = false;
}

static void break_watchdog(void)
{
    sim_watchdog_faults(devices()->watchdog)->io = true;
}

static void freeze(void)
{
    ask_command((command_t){.kind = COMMAND_FREEZE, .freeze = true}, COMMAND_OK);
}

static void want_pattern(void)
{
    ask_command((command_t){.kind = COMMAND_PATTERN, .pattern = COMMAND_PATTERN_GRID}, COMMAND_OK);
}

static void want_reboot(void)
{
    ask_command((command_t){.kind = COMMAND_REBOOT}, COMMAND_OK);
}

static const fault_t faults[] = {
    {"no pose has come yet", stop_poses, NULL, 500, 0},
    {"no pose for 0.1 s", stop_poses, begin_poses, 150, HOLDING_LED_MS},
    {"no pose for 1 s", stop_poses, begin_poses, 1100, 0},
    {"every pose is damaged", damage_poses, mend_poses, 1100, 0},
    {"one pose in five is damaged or lost", damage_some_poses, mend_poses, 1100, 0},
    {"the bus is flooded with what goes before poses", flood, end_flood, 8000, 0},
    {"the bus is flooded with what goes after them", flood_gaps, end_flood, 8000, 0},
    {"the CAN driver fails", break_driver, mend_driver, 1100, 0},
    {"bus-off, left by itself", go_bus_off, nothing, 600, 0},
    {"no picture from the camera for 1 s", unplug_camera, plug_camera, 1100, 0},
    {"the camera is back", unplug_camera_for_a_while, nothing, 100, 0},
    {"the projector is unplugged", unplug_display, plug_display, 100, 0},
    {"the display's flips fail", refuse_flips, take_flips, 100, 0},
    {"the display never frees a buffer", hold_buffers, NULL, 100, 0},
    {"the lines can not be driven", break_lines, mend_lines, 100, 0},
    {"the watchdog can not be fed", break_watchdog, NULL, 100, 0},
    {"an operator freezes the wall", freeze, NULL, 100, 0},
    {"an operator wants a pattern", want_pattern, NULL, 100, 0},
    {"an operator wants a reboot", want_reboot, NULL, 100, 0},
};

enum { FAULTS = sizeof faults / sizeof faults[0] };

/* The cells of a table's row, without blanks around them. @return false when the line is no such row. */
static bool read_row(char cell[CELLS][CELL_LENGTH], const char *line)
{
    if (line[0] != '|')
        return false;
    for (int i = 0; i < CELLS; i++) {
        const char *end = strchr(++line, '|');
        if (end == NULL)
            return false;
        const char *last = end;
        while (line < last && *line == ' ')
            line++;
        while (last > line && last[-1] == ' ')
            last--;
        snprintf(cell[i], CELL_LENGTH, "%.*s", (int)(last - line), line);
        line = end;
    }
    return true;
}

static bool find_row(char cell[CELLS][CELL_LENGTH], const char *what)
{
    char line[LINE_LENGTH];
    FILE *page = fopen(page_path, "r");
    if (page == NULL)
        fail_msg("%s is missing", page_path);
    bool found = false;
    while (!found && fgets(line, sizeof line, page) != NULL)
        found = read_row(cell, line) && strcmp(cell[0], what) == 0;
    fclose(page);
    return found;
}

/* How the LED goes, in the page's words. */
static const char *led_for(int milliseconds)
{
    int edges = 0;
    bool before = sim_gpio_level(devices()->gpio, HAL_GPIO_LED);
    const uint64_t all_edges = sim_gpio_edge_count(devices()->gpio);
    for (int i = 0; i < milliseconds * ROOM_BENCH_HZ / 1000; i++) {
        room_bench_step(&bench);
        const bool now = sim_gpio_level(devices()->gpio, HAL_GPIO_LED);
        edges += now != before;
        before = now;
    }
    if (sim_gpio_edge_count(devices()->gpio) == all_edges)
        return "kept"; /* the strobe has none either */
    return edges == 0 ? (before ? "on" : "off") : edges <= 2 ? "gaps" : edges <= 5 ? "slow" : "fast";
}

/* What the wall shows, in the page's words. */
static const char *wall_now(char wall[CELL_LENGTH])
{
    const uint64_t flips = sim_display_counts(devices()->display).flips;
    room_bench_run(&bench, 100);
    if (sim_world_shown(bench.world, 0, room_bench_now_us(&bench)) == NULL)
        return "dark";
    if (sim_display_counts(devices()->display).flips == flips)
        return "kept";
    const char *reason = room_bench_safe_reason(&bench, 0);
    if (reason != NULL) {
        snprintf(wall, CELL_LENGTH, "safe: %s", reason);
        return wall;
    }
    return report()->corrected ? "corrected" : "pattern";
}

static void test_fault(void **state)
{
    const fault_t *fault = &faults[*(const int *)*state];
    char cell[CELLS][CELL_LENGTH], names[FAULT_NAMES_LENGTH], wall[CELL_LENGTH];
    if (!find_row(cell, fault->what))
        fail_msg("%s has no row: %s", page_path, fault->what);
    if (fault == faults) { /* all but the first begin with a board that runs */
        open_bench(NULL);
    } else {
        open_operator(NULL);
        start_running();
    }
    bench.voice[0].flags_ever = 0;
    fault->begin();
    room_bench_run(&bench, fault->after_ms);
    assert_string_equal(can_board_state_name(report()->state), cell[1]);
    assert_string_equal(led_for(fault->led_ms == 0 ? LED_MS : fault->led_ms), cell[2]);
    if (fault->led_ms != 0) { /* the state would end meanwhile */
        begin_poses();
        room_bench_run(&bench, 100);
        stop_poses();
        room_bench_run(&bench, fault->after_ms);
    }
    assert_string_equal(wall_now(wall), cell[3]);
    room_bench_run(&bench, 2500);
    assert_string_equal(expired() ? "yes" : "no", cell[5]);
    if (fault->end != NULL)
        fault->end();
    room_bench_run(&bench, 1100);
    event_fault_names(names, bench.voice[0].flags_ever);
    assert_string_equal(names[0] == '\0' ? "-" : names, cell[4]);
    if (fault->end != NULL)
        assert_well_again();
    close_bench(NULL);
}

/* Every row between the page's two marks is one of the faults above. */
static void test_every_row_is_tested(void **state)
{
    char line[LINE_LENGTH], cell[CELLS][CELL_LENGTH];
    FILE *page = fopen(page_path, "r");
    bool inside = false;
    int rows = -2; /* the head, and the line below it */
    (void)state;
    assert_non_null(page);
    while (fgets(line, sizeof line, page) != NULL) {
        inside = strncmp(line, "<!-- tested by ", 15) == 0 || (inside && strncmp(line, "<!-- end", 8) != 0);
        rows += inside && read_row(cell, line);
    }
    fclose(page);
    assert_int_equal(rows, FAULTS);
}

int main(void)
{
    static int number[FAULTS];
    struct CMUnitTest tests[FAULTS + 1];
    for (int i = 0; i < FAULTS; i++) {
        number[i] = i;
        tests[i] = (struct CMUnitTest){.name = faults[i].what, .test_func = test_fault, .initial_state = &number[i]};
    }
    tests[FAULTS] = (struct CMUnitTest)cmocka_unit_test(test_every_row_is_tested);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
