// SPDX-License-Identifier: Apache-2.0
// A libgpiod 2 of one chip that is not there: it notes what it is told, and answers what the test wants.
#ifndef TESTS_HAL_LINUX_FAKE_GPIOD_V2_H
#define TESTS_HAL_LINUX_FAKE_GPIOD_V2_H

#include <stdbool.h>
#include <stdint.h>

enum { FAKE_LOG_LENGTH = 1024, FAKE_EDGES = 64 };

typedef struct {
    char log[FAKE_LOG_LENGTH]; /**< what was asked of lines, "OFFSET WHAT;" */
    int objects;               /**< made and not yet freed */
    int refused;               /**< offset of the line that can't be had, or -1 */
    int refused_with;          /**< its errno */
    const char *holder;        /**< its name, or NULL */
    uint64_t edge_ns[FAKE_EDGES];
    int first_edge, edges; /**< [first_edge, edges) are waiting */
    bool broken;           /**< every call about a taken line fails */
} fake_gpiod_t;

/** The one there is: tests set it anew. */
extern fake_gpiod_t fake_gpiod;

#endif
