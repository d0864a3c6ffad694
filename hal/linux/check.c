// SPDX-License-Identifier: Apache-2.0
// What the parts of hal_board_check() have in common: saying what was found, and small files.
#include "hal/linux/check.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void say(check_t *check, hal_check_t what, const char *mend, const char *format, va_list arguments)
    __attribute__((format(printf, 4, 0)));

static void say(check_t *check, hal_check_t what, const char *mend, const char *format, va_list arguments)
{
    char line[CHECK_LINE_LENGTH];
    const int length = vsnprintf(line, sizeof line, format, arguments);
    if (mend != NULL && length >= 0 && (size_t)length < sizeof line)
        (void)snprintf(line + length, sizeof line - (size_t)length, "; to mend: %s", mend);
    check->print(check->context, what, line);
}

void check_found(check_t *check, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(check, HAL_CHECK_FOUND, NULL, format, arguments);
    va_end(arguments);
}

void check_advise(check_t *check, const char *mend, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(check, HAL_CHECK_ADVICE, mend, format, arguments);
    va_end(arguments);
}

void check_miss(check_t *check, const char *mend, const char *format, ...)
{
    va_list arguments;
    check->missing = true;
    va_start(arguments, format);
    say(check, HAL_CHECK_MISSING, mend, format, arguments);
    va_end(arguments);
}

bool check_read(const check_t *check, const char *path, char *text, size_t size)
{
    char full[PATH_MAX], line[CHECK_LINE_LENGTH];
    const int length = snprintf(full, sizeof full, "%s%s", check->root, path);
    if (length < 0 || (size_t)length >= sizeof full)
        return false;
    FILE *file = fopen(full, "re");
    if (file == NULL)
        return false;
    const bool any = fgets(line, sizeof line, file) != NULL;
    fclose(file);
    if (!any)
        return false;
    line[strcspn(line, "\n")] = '\0';
    (void)snprintf(text, size, "%s", line);
    return text[0] != '\0';
}

void check_refused(check_t *check, const char *what, const char *device, int failure, const char *group)
{
    char mend[CHECK_LINE_LENGTH];
    if (failure == EACCES || failure == EPERM)
        (void)snprintf(mend, sizeof mend, "sudo usermod -aG %s $USER, then log in anew", group);
    else if (failure == EBUSY)
        (void)snprintf(mend, sizeof mend, "sudo fuser -v %s, and stop the program that it names", device);
    else
        (void)snprintf(mend, sizeof mend, "ls -l %s; sudo dmesg | tail", device);
    check_miss(check, mend, "%s: can't open %s: %s", what, device, strerror(failure));
}

void check_held(check_t *check, const char *what, const char *device, const char *who, const char *mend)
{
    if (strncmp(who, "wallwarp ", 9) == 0)
        check_found(check, "%s: %s, in use by %s", what, device, who);
    else
        check_miss(check, mend, "%s: %s is held by %s", what, device, who);
}
