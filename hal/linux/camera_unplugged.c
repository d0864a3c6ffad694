// SPDX-License-Identifier: Apache-2.0
// The video devices that this process has open: see the header.
#include "hal/linux/camera_unplugged.h"

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/filter.h>
#include <linux/netlink.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

enum { V4L2_MAJOR = 81, LINK_LENGTH = 64 };

/* @return true to stop. */
typedef bool visit_fn(void *context, int file);

static bool visit_files(visit_fn *visit, void *context)
{
    DIR *files = opendir("/proc/self/fd");
    bool stopped = false;
    for (const struct dirent *file = NULL; files != NULL && !stopped && (file = readdir(files)) != NULL;)
        stopped = file->d_name[0] != '.' && visit(context, atoi(file->d_name));
    if (files != NULL)
        closedir(files);
    return stopped;
}

/* Where sysfs has the device of a file. @return false when it is no V4L2 device. */
static bool find_link(char link[LINK_LENGTH], int file)
{
    struct stat about;
    if (fstat(file, &about) != 0 || !S_ISCHR(about.st_mode) || major(about.st_rdev) != V4L2_MAJOR)
        return false;
    (void)snprintf(link, LINK_LENGTH, "/sys/dev/char/%u:%u", major(about.st_rdev), minor(about.st_rdev));
    return true;
}

static bool is_gone(void *context, int file)
{
    char link[LINK_LENGTH];
    (void)context;
    return find_link(link, file) && access(link, F_OK) != 0;
}

bool camera_unplugged(void)
{
    return visit_files(is_gone, NULL);
}

static bool replace(void *context, int file)
{
    const int *nothing = context;
    if (is_gone(NULL, file))
        (void)dup3(*nothing, file, O_CLOEXEC);
    return false;
}

void camera_unplugged_drop(void)
{
    int nothing = eventfd(0, EFD_CLOEXEC);
    if (nothing < 0)
        return;
    (void)visit_files(replace, &nothing);
    close(nothing);
}

static bool note(void *context, int file)
{
    camera_places_t *places = context;
    char link[LINK_LENGTH], path[PATH_MAX];
    if (!find_link(link, file) || realpath(link, path) == NULL)
        return false;
    *strrchr(path, '/') = '\0';
    if (strlen(path) < CAMERA_PLACE_LENGTH)
        memcpy(places->folder[places->count++], path, strlen(path) + 1);
    return places->count == CAMERA_PLACES;
}

void camera_places_note(camera_places_t *places)
{
    places->count = 0;
    (void)visit_files(note, places);
}

bool camera_places_are_taken(const camera_places_t *places)
{
    for (int32_t i = 0; i < places->count; i++)
        if (access(places->folder[i], F_OK) != 0)
            return false;
    return places->count > 0;
}

bool camera_places_have_usb(const camera_places_t *places)
{
    for (int32_t i = 0; i < places->count; i++)
        if (strstr(places->folder[i], "/usb") != NULL)
            return true;
    return false;
}

static bool silence(void *context, int file)
{
    static struct sock_filter drop = BPF_STMT(BPF_RET | BPF_K, 0);
    const struct sock_fprog all = {.len = 1, .filter = &drop};
    int domain = 0, protocol = 0;
    socklen_t length = sizeof domain;
    (void)context;
    if (getsockopt(file, SOL_SOCKET, SO_DOMAIN, &domain, &length) == 0 && domain == AF_NETLINK &&
        getsockopt(file, SOL_SOCKET, SO_PROTOCOL, &protocol, &length) == 0 && protocol == NETLINK_KOBJECT_UEVENT)
        (void)setsockopt(file, SOL_SOCKET, SO_ATTACH_FILTER, &all, sizeof all);
    return false;
}

void camera_udev_silence(void)
{
    (void)visit_files(silence, NULL);
}
