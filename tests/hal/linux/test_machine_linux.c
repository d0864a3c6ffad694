// SPDX-License-Identifier: Apache-2.0
// Tests of which machine it is, with made-up device trees.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "hal/linux/machine_linux.h"
#include "tests/support/scratch.h"

static const char *const folders[] = {"proc", "proc/device-tree"};
static const char *const names = "proc/device-tree/compatible";

static scratch_t scratch;

static int set_up(void **state)
{
    (void)state;
    char path[SCRATCH_PATH_LENGTH];
    scratch_open(&scratch);
    for (int i = 0; i < 2; i++) {
        scratch_path(&scratch, folders[i], path);
        if (mkdir(path, 0777) != 0)
            return -1;
    }
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(&scratch, names, path);
    (void)unlink(path);
    for (int i = 1; i >= 0; i--) {
        scratch_path(&scratch, folders[i], path);
        (void)rmdir(path);
    }
    scratch_close(&scratch);
    return 0;
}

static void write_names(const void *list, size_t length)
{
    char path[SCRATCH_PATH_LENGTH];
    scratch_path(&scratch, names, path);
    scratch_write(path, list, length);
}

static void any_of_its_names_will_do(void **state)
{
    (void)state;
    static const char list[] = "raspberrypi,4-model-b\0brcm,bcm2711";
    char found[MACHINE_LINUX_NAME_LENGTH];
    write_names(list, sizeof list);
    static const char *const good[] = {"raspberrypi,4-model-b", "brcm,bcm2711", NULL};
    for (int i = 0; i < 3; i++) {
        assert_true(machine_linux_is(scratch.folder, good[i], found));
        assert_string_equal(found, "raspberrypi,4-model-b");
    }
    static const char *const bad[] = {"brcm,bcm2712", "brcm,bcm271", "raspberrypi", "bcm2711", ""};
    for (int i = 0; i < 5; i++) {
        assert_false(machine_linux_is(scratch.folder, bad[i], found));
        assert_string_equal(found, "raspberrypi,4-model-b");
    }
}

static void without_a_device_tree_nobody_can_tell(void **state)
{
    (void)state;
    char found[MACHINE_LINUX_NAME_LENGTH] = "before";
    assert_true(machine_linux_is(scratch.folder, "brcm,bcm2711", found));
    assert_string_equal(found, "");
}

static void odd_lists_are_read_within_bounds(void **state)
{
    (void)state;
    char found[MACHINE_LINUX_NAME_LENGTH], list[5000];
    write_names("", 0);
    assert_false(machine_linux_is(scratch.folder, "brcm,bcm2711", found));
    assert_string_equal(found, "");
    write_names("brcm,bcm2711", 12); /* its end is missing */
    assert_true(machine_linux_is(scratch.folder, "brcm,bcm2711", found));
    memset(list, 'a', sizeof list);
    write_names(list, sizeof list);
    assert_false(machine_linux_is(scratch.folder, "brcm,bcm2711", found));
    assert_int_equal(strlen(found), MACHINE_LINUX_NAME_LENGTH - 1);
}

static void firmware_of_another_board_is_refused(void **state)
{
    (void)state;
    static const char list[] = "linux,dummy-virt";
    board_table_t table = {.name = "rpi4", .machine = "brcm,bcm2711"};
    char error[HAL_BOARD_ERROR_LENGTH] = "untouched";
    write_names(list, sizeof list);
    assert_int_equal(machine_linux_open(scratch.folder, &table, error), HAL_IO);
    assert_string_equal(error, "machine: this is linux,dummy-virt, and the firmware that of board rpi4, expected "
                               "brcm,bcm2711: install the firmware of this board (make BOARD=NAME)");
    (void)snprintf(error, sizeof error, "untouched");
    table.machine = list;
    assert_int_equal(machine_linux_open(scratch.folder, &table, error), HAL_OK);
    assert_string_equal(error, "untouched");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(any_of_its_names_will_do, set_up, tear_down),
        cmocka_unit_test_setup_teardown(without_a_device_tree_nobody_can_tell, set_up, tear_down),
        cmocka_unit_test_setup_teardown(odd_lists_are_read_within_bounds, set_up, tear_down),
        cmocka_unit_test_setup_teardown(firmware_of_another_board_is_refused, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
