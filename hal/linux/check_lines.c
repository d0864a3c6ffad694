// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): the digital lines. The chip is asked who holds them; none is taken.
#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hal/linux/check.h"
#include "hal/linux/gpiod_lines.h"

enum { CHIPS = 64 };

static void check_line(check_t *check, int file, const struct gpiochip_info *chip, hal_gpio_line_t line)
{
    const int32_t offset = check->table->lines.line[line];
    const char *name = hal_gpio_line_name(line);
    struct gpio_v2_line_info info = {.offset = (uint32_t)offset};
    if (offset == HAL_BOARD_NO_LINE)
        return;
    if (offset < 0 || (uint32_t)offset >= chip->lines || ioctl(file, GPIO_V2_GET_LINEINFO_IOCTL, &info) != 0)
        check_miss(check, "name one of them in the board's table", "gpio %s: has no line %d (%s), expected 0 to %u",
                   chip->label, (int)offset, name, chip->lines - 1);
    else if ((info.flags & GPIO_V2_LINE_FLAG_USED) != 0 && strcmp(info.consumer, gpiod_lines_consumer) != 0)
        check_miss(check, "stop that program, or take the overlay of that driver out",
                   "gpio %s: line %d (%s) is held by \"%s\"", chip->label, (int)offset, name,
                   info.consumer[0] == '\0' ? "a driver" : info.consumer);
    else
        check_found(check, "gpio %s: line %d (%s)%s%s", chip->label, (int)offset, name,
                    info.name[0] == '\0' ? "" : ", ", info.name);
}

/* Open a chip. @return Its file, or -1: errno says why. */
static int open_chip(int number, struct gpiochip_info *chip, char path[CHECK_WORD_LENGTH])
{
    (void)snprintf(path, CHECK_WORD_LENGTH, "/dev/gpiochip%d", number);
    const int file = open(path, O_RDWR | O_CLOEXEC);
    if (file < 0)
        return -1;
    if (ioctl(file, GPIO_GET_CHIPINFO_IOCTL, chip) == 0)
        return file;
    close(file);
    errno = ENOTTY;
    return -1;
}

/* By label or name; or a link in /dev has the name and leads to it. */
static bool is_wanted(const char *wanted, int file, const struct gpiochip_info *chip)
{
    char link[CHECK_LINE_LENGTH];
    struct stat target, own;
    (void)snprintf(link, sizeof link, "/dev/%s", wanted);
    return strcmp(chip->label, wanted) == 0 || strcmp(chip->name, wanted) == 0 ||
           (stat(link, &target) == 0 && fstat(file, &own) == 0 && target.st_rdev == own.st_rdev);
}

void check_lines(check_t *check)
{
    const char *wanted = check->table->lines.chip;
    char path[CHECK_WORD_LENGTH], there[CHECK_LINE_LENGTH / 2] = "";
    size_t used = 0;
    if (wanted == NULL)
        return;
    for (int n = 0; n < CHIPS; n++) {
        struct gpiochip_info chip;
        const int file = open_chip(n, &chip, path);
        if (file < 0 && errno == EACCES) {
            check_refused(check, "gpio", path, EACCES, "gpio");
            return;
        }
        if (file < 0)
            continue;
        const bool found = is_wanted(wanted, file, &chip);
        for (hal_gpio_line_t line = 0; found && line < HAL_GPIO_LINES; line++)
            check_line(check, file, &chip, line);
        close(file);
        if (found)
            return;
        if (used < sizeof there)
            used += (size_t)snprintf(there + used, sizeof there - used, " %s", chip.label);
    }
    check_miss(check, "gpiodetect; is BOARD= of the build this board?", "gpio %s: there is no such chip; found%s",
               wanted, used == 0 ? " none" : there);
}
