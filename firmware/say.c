// SPDX-License-Identifier: Apache-2.0
// What the firmware says to people on stderr, a line at a time; into systemd's journal with its priority.
#include "firmware/say.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { NAME_LENGTH = 48 };

/* Is stderr the journal? $JOURNAL_STREAM names it, but is left to programs with another stderr too (systemd.exec(5)).
 */
static bool to_journal(void)
{
    const char *journal = getenv("JOURNAL_STREAM");
    struct stat about;
    char name[NAME_LENGTH];
    if (journal == NULL || fstat(fileno(stderr), &about) != 0)
        return false;
    (void)snprintf(name, sizeof name, "%" PRIuMAX ":%" PRIuMAX, (uintmax_t)about.st_dev, (uintmax_t)about.st_ino);
    return strcmp(name, journal) == 0;
}

void say_error(const char *line)
{
    fprintf(stderr, "%swallwarp: %s\n", to_journal() ? "<3>" : "", line);
}

void say_warning(const char *line)
{
    fprintf(stderr, "%swarning: %s\n", to_journal() ? "<4>" : "", line);
}
