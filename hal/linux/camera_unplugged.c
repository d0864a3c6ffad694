// SPDX-License-Identifier: Apache-2.0
// Was a video device unplugged: see the header.
#include "hal/linux/camera_unplugged.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

enum { V4L2_MAJOR = 81 };

static bool is_gone(int file)
{
    struct stat about;
    if (fstat(file, &about) != 0 || !S_ISCHR(about.st_mode) || major(about.st_rdev) != V4L2_MAJOR)
        return false;
    char path[64];
    (void)snprintf(path, sizeof path, "/sys/dev/char/%u:%u", major(about.st_rdev), minor(about.st_rdev));
    return access(path, F_OK) != 0;
}

bool camera_unplugged(void)
{
    DIR *files = opendir("/proc/self/fd");
    bool gone = false;
    for (const struct dirent *file = NULL; files != NULL && !gone && (file = readdir(files)) != NULL;)
        gone = file->d_name[0] != '.' && is_gone(atoi(file->d_name));
    if (files != NULL)
        closedir(files);
    return gone;
}
