// SPDX-License-Identifier: Apache-2.0
// Which other program has a device open: for messages to people.
#include "hal/linux/device_user.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_LENGTH = 300, NAME_LENGTH = 32 };

static bool has_open(long process, const char *device)
{
    char path[PATH_LENGTH], target[PATH_LENGTH];
    (void)snprintf(path, sizeof path, "/proc/%ld/fd", process);
    DIR *files = opendir(path);
    bool found = false;
    const struct dirent *file;
    while (!found && files != NULL && (file = readdir(files)) != NULL) {
        (void)snprintf(path, sizeof path, "/proc/%ld/fd/%s", process, file->d_name);
        const ssize_t length = readlink(path, target, sizeof target - 1);
        target[length < 0 ? 0 : length] = '\0';
        found = strcmp(target, device) == 0;
    }
    if (files != NULL)
        closedir(files);
    return found;
}

static void read_name(char name[NAME_LENGTH], long process)
{
    char path[PATH_LENGTH];
    (void)snprintf(path, sizeof path, "/proc/%ld/comm", process);
    FILE *file = fopen(path, "re");
    if (file == NULL || fgets(name, NAME_LENGTH, file) == NULL)
        (void)snprintf(name, NAME_LENGTH, "a program\n");
    name[strcspn(name, "\n")] = '\0';
    if (file != NULL)
        (void)fclose(file);
}

bool device_user(char user[DEVICE_USER_LENGTH], const char *device)
{
    (void)snprintf(user, DEVICE_USER_LENGTH, "another program");
    DIR *processes = opendir("/proc");
    const struct dirent *entry;
    bool found = false;
    while (!found && processes != NULL && (entry = readdir(processes)) != NULL) {
        const long process = strtol(entry->d_name, NULL, 10);
        if (process <= 0 || process == (long)getpid() || !has_open(process, device))
            continue;
        char name[NAME_LENGTH];
        read_name(name, process);
        (void)snprintf(user, DEVICE_USER_LENGTH, "%s (process %ld)", name, process);
        found = true;
    }
    if (processes != NULL)
        closedir(processes);
    return found;
}
