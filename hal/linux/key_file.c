// SPDX-License-Identifier: Apache-2.0
// The room's secret key from a file of Linux.
#include "hal/hal_key.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { DIGITS = 2 * HAL_KEY_BYTES, OTHERS_RIGHTS = 077 };

__attribute__((format(printf, 3, 4))) static hal_status_t refuse(char error[HAL_KEY_ERROR_LENGTH], const char *path,
                                                                 const char *format, ...)
{
    char what[HAL_KEY_ERROR_LENGTH / 2];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    snprintf(error, HAL_KEY_ERROR_LENGTH, "%.*s: %s", HAL_KEY_ERROR_LENGTH / 2 - 8, path, what);
    return HAL_BAD_CALL;
}

/* Of the open file, so that nobody changes it between check and use. */
static hal_status_t check_rights(int file, const char *path, char error[HAL_KEY_ERROR_LENGTH])
{
    struct stat about;
    if (fstat(file, &about) != 0) {
        (void)refuse(error, path, "cannot look at the key file: %s", strerror(errno));
        return HAL_IO;
    }
    if (!S_ISREG(about.st_mode))
        return refuse(error, path, "is not a regular file, expected a key file");
    if (about.st_uid != geteuid() && geteuid() != 0)
        return refuse(error, path, "belongs to user %u, expected the reader, user %u (chown)", (unsigned)about.st_uid,
                      (unsigned)geteuid());
    if ((about.st_mode & OTHERS_RIGHTS) != 0)
        return refuse(error, path, "has mode %04o, so that others may use the key; expected 0600 (chmod 600)",
                      (unsigned)about.st_mode & 07777U);
    return HAL_OK;
}

/* @return 0 to 15, or -1. */
static int digit_value(char digit)
{
    if (digit >= '0' && digit <= '9')
        return digit - '0';
    const char lower = (char)(digit | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/* The key in a text of so many bytes. */
static bool parse(hal_key_t *key, const char *text, ssize_t length)
{
    if (length != DIGITS && !(length == DIGITS + 1 && text[DIGITS] == '\n'))
        return false;
    for (int i = 0; i < HAL_KEY_BYTES; i++) {
        const int high = digit_value(text[2 * i]), low = digit_value(text[2 * i + 1]);
        if (high < 0 || low < 0)
            return false;
        key->bytes[i] = (uint8_t)(16 * high + low);
    }
    return true;
}

hal_status_t hal_key_load(hal_key_t *key, const char *path, char error[HAL_KEY_ERROR_LENGTH])
{
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK); /* a pipe would wait for a writer */
    if (file < 0) {
        (void)refuse(error, path, "cannot open the key file: %s",
                     errno == ELOOP ? "it is a link, expected the file itself" : strerror(errno));
        return HAL_IO;
    }
    hal_status_t status = check_rights(file, path, error);
    char text[DIGITS + 2];
    hal_key_t read_key;
    if (status == HAL_OK) {
        const ssize_t length = read(file, text, sizeof text);
        if (length < 0) {
            (void)refuse(error, path, "cannot read the key file: %s", strerror(errno));
            status = HAL_IO;
        } else if (!parse(&read_key, text, length)) {
            status = refuse(error, path, "is no key, expected %d hexadecimal digits in one line", DIGITS);
        } else {
            *key = read_key;
        }
    }
    explicit_bzero(text, sizeof text);
    hal_key_wipe(&read_key);
    close(file);
    return status;
}

void hal_key_wipe(hal_key_t *key)
{
    explicit_bzero(key, sizeof *key);
}
