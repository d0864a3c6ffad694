// SPDX-License-Identifier: Apache-2.0
// The service manager: systemd.
#include "hal/linux/service_systemd.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "hal/linux/board_error.h"

enum { MESSAGE_LENGTH = 640 };

struct hal_service {
    int socket;
    struct sockaddr_un address;
    socklen_t address_length;
    int64_t feed_every_us; /* 0: it does not watch */
    int64_t feed_due_us;
    const char *told_state; /* the last one, or NULL */
    bool told_ready;
};

/* A manager that ends this process when it has heard nothing for $WATCHDOG_USEC is fed four times as often. */
static int64_t feed_every_us(void)
{
    const char *period = getenv("WATCHDOG_USEC"), *process = getenv("WATCHDOG_PID");
    if (period == NULL || (process != NULL && strtol(process, NULL, 10) != (long)getpid()))
        return 0;
    return strtoll(period, NULL, 10) / 4;
}

hal_status_t service_systemd_open(hal_service_t **service, char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *path = getenv("NOTIFY_SOCKET");
    if (path == NULL) {
        *service = NULL;
        return HAL_OK;
    }
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    const size_t length = strlen(path);
    if ((path[0] != '/' && path[0] != '@') || length >= sizeof address.sun_path)
        return board_error(error, "service: NOTIFY_SOCKET is \"%.60s\", expected a path or @name as systemd sets it",
                           path);
    memcpy(address.sun_path, path, length);
    if (path[0] == '@')
        address.sun_path[0] = '\0'; /* the abstract namespace */
    hal_service_t *s = calloc(1, sizeof *s);
    if (s == NULL)
        return board_error(error, "service: out of memory");
    s->address = address;
    s->address_length = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length);
    s->feed_every_us = feed_every_us();
    s->socket = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (s->socket < 0) {
        free(s);
        return board_error(error, "service: can't make a socket: %s", strerror(errno));
    }
    *service = s;
    return HAL_OK;
}

static bool tell(const hal_service_t *s, const char *message)
{
    return sendto(s->socket, message, strlen(message), MSG_NOSIGNAL, (const struct sockaddr *)&s->address,
                  s->address_length) >= 0;
}

void hal_service_report(hal_service_t *s, const hal_service_report_t *report)
{
    if (s == NULL)
        return;
    if (report->showing && !s->told_ready)
        s->told_ready = tell(s, "READY=1");
    if (s->told_state == NULL || strcmp(s->told_state, report->state) != 0) {
        char message[MESSAGE_LENGTH];
        (void)snprintf(message, sizeof message, "STATUS=%s", report->state);
        if (tell(s, message))
            s->told_state = report->state;
    }
    if (s->feed_every_us > 0 && report->healthy && report->now_us >= s->feed_due_us && tell(s, "WATCHDOG=1"))
        s->feed_due_us = report->now_us + s->feed_every_us;
}

void service_systemd_close(hal_service_t *s)
{
    if (s == NULL)
        return;
    (void)tell(s, "STOPPING=1");
    close(s->socket);
    free(s);
}
