// SPDX-License-Identifier: Apache-2.0
// Tests of --check on Linux where its files can be made up: cores, governor, clock, watchdog, updates, who says what.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "hal/linux/check.h"
#include "tests/support/scratch.h"

enum { LINES = 16, FOLDERS = 32 };

/* What was said, and the made-up machine. */
typedef struct {
    scratch_t scratch;
    char folder[FOLDERS][SCRATCH_PATH_LENGTH], file[FOLDERS][SCRATCH_PATH_LENGTH];
    int folders, files;
    int lines;
    hal_check_t what[LINES];
    char line[LINES][CHECK_LINE_LENGTH];
} machine_t;

static machine_t machine;
static board_table_t table;
static check_t check;

static void note(void *context, hal_check_t what, const char *line)
{
    machine_t *m = context;
    assert_true(m->lines < LINES);
    m->what[m->lines] = what;
    snprintf(m->line[m->lines++], CHECK_LINE_LENGTH, "%s", line);
}

/* A file of the machine, and the folders that lead to it. */
static void write_file(const char *path, const char *text)
{
    char full[SCRATCH_PATH_LENGTH];
    scratch_path(&machine.scratch, path + 1, full);
    for (char *slash = full + strlen(machine.scratch.folder) + 1; (slash = strchr(slash, '/')) != NULL; slash++) {
        *slash = '\0';
        if (mkdir(full, 0777) == 0) {
            assert_true(machine.folders < FOLDERS);
            snprintf(machine.folder[machine.folders++], SCRATCH_PATH_LENGTH, "%s", full);
        }
        *slash = '/';
    }
    scratch_write(full, text, strlen(text));
    assert_true(machine.files < FOLDERS);
    snprintf(machine.file[machine.files++], SCRATCH_PATH_LENGTH, "%s", full);
}

static int set_up(void **state)
{
    (void)state;
    machine = (machine_t){.lines = 0};
    scratch_open(&machine.scratch);
    table = (board_table_t){.watchdog = "/dev/watchdog0", .workers = {.count = 3, .first_core = 1}};
    check = (check_t){.table = &table, .print = note, .context = &machine, .root = machine.scratch.folder};
    write_file("/sys/devices/system/cpu/online", "0-3\n");
    write_file("/sys/devices/system/cpu/isolated", "1-3\n");
    write_file("/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance\n");
    write_file("/sys/devices/system/clocksource/clocksource0/current_clocksource", "arch_sys_counter\n");
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    for (int i = 0; i < machine.files; i++)
        (void)unlink(machine.file[i]);
    while (machine.folders > 0)
        (void)rmdir(machine.folder[--machine.folders]);
    scratch_close(&machine.scratch);
    return 0;
}

/* The line that begins so must be there, of that kind. */
static void assert_said(hal_check_t what, const char *begin)
{
    for (int i = 0; i < machine.lines; i++)
        if (strncmp(machine.line[i], begin, strlen(begin)) == 0) {
            assert_int_equal(machine.what[i], what);
            return;
        }
    for (int i = 0; i < machine.lines; i++)
        print_message("said: %s\n", machine.line[i]);
    fail_msg("no line begins with: %s", begin);
}

static void test_a_good_machine(void **state)
{
    (void)state;
    check_system(&check);
    assert_said(HAL_CHECK_FOUND, "cores: 0-3, of them isolated: 1-3");
    assert_said(HAL_CHECK_FOUND, "governor: performance");
    assert_said(HAL_CHECK_FOUND, "clock: CLOCK_MONOTONIC from arch_sys_counter");
}

static void test_machine(void **state)
{
    (void)state;
    table.name = "rpi4";
    table.machine = "brcm,bcm2711";
    check_system(&check);
    assert_said(HAL_CHECK_FOUND, "machine: it has no device tree");
    write_file("/proc/device-tree/compatible", "linux,dummy-virt");
    machine.lines = 0;
    check_system(&check);
    assert_said(HAL_CHECK_MISSING, "machine: found linux,dummy-virt, expected brcm,bcm2711, as this is the firmware of "
                                   "board rpi4; to mend: install the firmware of this board");
    table.machine = "linux,dummy-virt";
    machine.lines = 0;
    check_system(&check);
    assert_said(HAL_CHECK_FOUND, "machine: linux,dummy-virt");
}

static void test_cores(void **state)
{
    static const struct {
        const char *online, *isolated;
        hal_check_t what;
        const char *line;
    } cases[] = {
        {"0-3\n", "1,2-3\n", HAL_CHECK_FOUND, "cores: 0-3, of them isolated: 1,2-3"},
        {"0-1,3\n", "1-3\n", HAL_CHECK_MISSING, "cores: found 0-1,3, expected 1 to 3 among them; to mend: "},
        {"0\n", "", HAL_CHECK_MISSING, "cores: found 0, expected 1 to 3"},
        {"0-3\n", "1-2\n", HAL_CHECK_ADVICE, "cores: found 0-3, of them isolated: 1-2; expected 1 to 3; to mend: "},
        {"0-3\n", "\n", HAL_CHECK_ADVICE, "cores: found 0-3, of them isolated: none; expected 1 to 3"},
        {"nonsense\n", "1-3\n", HAL_CHECK_MISSING, "cores: found nonsense"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_file("/sys/devices/system/cpu/online", cases[i].online);
        write_file("/sys/devices/system/cpu/isolated", cases[i].isolated);
        machine.lines = 0;
        check.missing = false;
        check_system(&check);
        assert_said(cases[i].what, cases[i].line);
        machine.files -= 2; /* the same two again */
    }
    table.workers = (hal_workers_settings_t){.count = 1, .first_core = HAL_WORKERS_ANY_CORE};
    machine.lines = 0;
    check_system(&check);
    assert_said(HAL_CHECK_FOUND, "cores: ");
}

static void test_governor(void **state)
{
    (void)state;
    write_file("/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "ondemand\n");
    check_system(&check);
    assert_said(HAL_CHECK_ADVICE, "governor: found ondemand, expected performance; to mend: echo performance");
    (void)unlink(machine.file[machine.files - 1]);
    machine.lines = 0;
    check_system(&check);
    assert_said(HAL_CHECK_FOUND, "governor: none");
}

static void test_rights(void **state)
{
    (void)state;
    table.workers.priority = 40;
    write_file("/proc/self/status", "Name:\ttest\nCapEff:\t0000000000805000\n");
    check_system(&check);
    assert_said(HAL_CHECK_FOUND, "rights: real-time priority 40, by CAP_SYS_NICE");
    assert_said(HAL_CHECK_FOUND, "rights: locked memory, by CAP_IPC_LOCK");
    assert_said(HAL_CHECK_FOUND, "rights: CAP_NET_ADMIN");
    write_file("/proc/self/status", "Name:\ttest\nCapEff:\t0000000000000000\n");
    machine.lines = 0;
    check_system(&check);
    assert_said(HAL_CHECK_FOUND, "rights: no CAP_NET_ADMIN");
}

static void test_watchdog(void **state)
{
    (void)state;
    check_watchdog(&check);
    assert_said(HAL_CHECK_MISSING, "watchdog: there is no /dev/watchdog0, expected the one of the board; to mend: ");
    assert_true(check.missing);
    write_file("/dev/watchdog0", "");
    write_file("/sys/class/watchdog/watchdog0/identity", "a dog\n");
    machine.lines = 0;
    check_watchdog(&check);
    assert_said(HAL_CHECK_FOUND, "watchdog: /dev/watchdog0, a dog");
    table.watchdog = NULL;
    machine.lines = 0;
    check_watchdog(&check);
    assert_int_equal(machine.lines, 0);
}

static void test_held_devices(void **state)
{
    (void)state;
    check_held(&check, "display", "/dev/dri/card0", "wallwarp (process 7)", "stop it");
    assert_said(HAL_CHECK_FOUND, "display: /dev/dri/card0, in use by wallwarp (process 7)");
    assert_false(check.missing);
    check_held(&check, "display", "/dev/dri/card1", "Xorg (process 8)", "stop it");
    assert_said(HAL_CHECK_MISSING, "display: /dev/dri/card1 is held by Xorg (process 8); to mend: stop it");
    assert_true(check.missing);
}

static void check_update_again(void)
{
    machine.lines = 0;
    check_update(&check);
}

static void write_update_state(const char *text)
{
    write_file("/run/wallwarp/update/state", text);
    machine.files--; /* the same one again */
    check_update_again();
}

static void test_updates(void **state)
{
    static const char link[] = "/etc/systemd/system/multi-user.target.wants/wallwarp-update";
    char path[CHECK_LINE_LENGTH];
    (void)state;
    check_update_again();
    assert_said(HAL_CHECK_FOUND, "updates: there is no update agent");
    assert_int_equal(machine.lines, 1);

    write_file("/usr/local/lib/wallwarp/update_agent", "");
    check_update_again();
    assert_said(HAL_CHECK_ADVICE, "updates: wallwarp-update.path is not enabled, expected it at each start; to mend: "
                                  "sudo systemctl enable --now wallwarp-update.path");
    assert_said(HAL_CHECK_ADVICE, "updates: wallwarp-update-start.service is not enabled");
    assert_said(HAL_CHECK_ADVICE,
                "updates: /run/wallwarp/update/state can't be read, expected the update agent's lines");
    assert_int_equal(machine.lines, 3);
    assert_false(check.missing);

    (void)snprintf(path, sizeof path, "%s.path", link);
    write_file(path, "");
    (void)snprintf(path, sizeof path, "%s-start.service", link);
    write_file(path, "");
    write_file("/run/wallwarp/update/state", "");
    write_update_state("state=idle\nslot=A\ntrial=0\nrunning=1.0\nwaiting=\nother=0.9\n");
    assert_said(HAL_CHECK_FOUND, "updates: slot A, version 1.0, marked good");
    assert_said(HAL_CHECK_FOUND, "updates: version 0.9 is in the other slot, to go back to");
    assert_int_equal(machine.lines, 2);
    write_update_state("state=ready\nslot=A\ntrial=0\nrunning=1.0\nwaiting=2.0\nother=2.0\n");
    assert_said(HAL_CHECK_FOUND, "updates: version 2.0 waits for the switch");
    assert_int_equal(machine.lines, 2);
    write_update_state("state=installing\nprogress=40\nslot=A\ntrial=0\nrunning=1.0\nmessage=usb\n");
    assert_said(HAL_CHECK_FOUND, "updates: installing, 40 %: usb");
    write_update_state("state=failed\nslot=B\ntrial=1\nrunning=2.0\nmessage=no stick\n");
    assert_said(HAL_CHECK_FOUND, "updates: slot B, version 2.0, on trial");
    assert_said(HAL_CHECK_FOUND, "updates: the last request failed: no stick");
    write_update_state("state=idle\n");
    assert_said(HAL_CHECK_FOUND, "updates: slot ?, version unknown, marked good");
    write_update_state("nonsense\n");
    assert_said(HAL_CHECK_ADVICE, "updates: /run/wallwarp/update/state can't be read");

    write_file("/run/wallwarp/update/request", "switch\n");
    check_update_again();
    assert_said(HAL_CHECK_FOUND, "updates: the update agent has not answered the last request yet");
    assert_false(check.missing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_good_machine, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_machine, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_cores, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_governor, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_rights, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_watchdog, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_held_devices, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_updates, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
