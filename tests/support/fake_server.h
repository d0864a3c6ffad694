// SPDX-License-Identifier: Apache-2.0
// A socketcand server made up in a thread: greets, answers two commands as the test likes, and hears what comes.
#ifndef TESTS_SUPPORT_FAKE_SERVER_H
#define TESTS_SUPPORT_FAKE_SERVER_H

#include <pthread.h>
#include <stddef.h>

enum { FAKE_SERVER_HEARD = 65536 };

typedef struct {
    const char *greeting, *answer;
    int listening;
    char address[32]; /**< 127.0.0.1:PORT */
    char heard[FAKE_SERVER_HEARD];
    size_t length; /**< of it */
    pthread_t thread;
} fake_server_t;

/**
 * Begin to serve one client. After its second command it is sent frame 123 once and frame 700 a thousand times, and is
 * heard until it leaves.
 *
 * @param greeting  What it is told when it comes,
 * @param answer    and after its first command; NULL: it is sent away before that.
 */
void fake_server_start(fake_server_t *server, const char *greeting, const char *answer);

/** Wait until the client has left. What it said is then server->heard, as text. */
void fake_server_stop(fake_server_t *server);

#endif
