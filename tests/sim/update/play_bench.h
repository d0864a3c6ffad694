// SPDX-License-Identifier: Apache-2.0
// A room of some boards whose update is played, and what must hold whatever fails, for tests.
#ifndef TESTS_SIM_UPDATE_PLAY_BENCH_H
#define TESTS_SIM_UPDATE_PLAY_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "sim/update/update_play.h"
#include "tests/support/small_room.h"

enum { MOST_BOARDS = 6, PERIOD_US = 16667, TIME_BOUND_US = 2000 };

/* No board switches before all have the bundle. @return What is wrong, or NULL. */
static inline const char *wrong_now(const update_play_t *play, int boards, int64_t first_us)
{
    int having = 0, switching = 0;
    for (int i = 0; i < boards; i++) {
        const update_play_look_t look = update_play_look(play, i);
        switching += update_play_switched_us(play, i) != INT64_MIN;
        having += update_play_has_bundle(play, i) || look >= UPDATE_PLAY_DOWN;
    }
    return switching > 0 && first_us == INT64_MIN && having < boards ? "a board switches before all have the bundle"
                                                                     : NULL;
}

/* Boards that switch do so at one refresh, but for what their bus times may differ by. */
static inline const char *wrong_at_the_end(const update_play_t *play, int boards)
{
    int64_t first_us = INT64_MAX, last_us = INT64_MIN;
    int new = 0;
    for (int i = 0; i < boards; i++) {
        const int64_t at_us = update_play_switched_us(play, i);
        const update_play_look_t look = update_play_look(play, i);
        new += look == UPDATE_PLAY_NEW;
        if (at_us == INT64_MIN)
            continue;
        first_us = at_us < first_us ? at_us : first_us;
        last_us = at_us > last_us ? at_us : last_us;
    }
    const room_update_t *u = update_play_operator(play);
    const bool switch_task = u->settings.task == ROOM_UPDATE_SWITCH;
    const bool done = switch_task && u->result == ROOM_UPDATE_DONE;
    if (last_us != INT64_MIN && last_us - first_us > PERIOD_US + TIME_BOUND_US)
        return "boards switch at different times";
    if (done != (new == boards))
        return "the operator is told that all is done when it is not, or the reverse";
    if (u->result == ROOM_UPDATE_WORKING)
        return "it has no end";
    if (last_us != INT64_MIN && (u->result == ROOM_UPDATE_CANCELLED || u->result == ROOM_UPDATE_REFUSED))
        return "the operator is told that none has switched, and one has";
    return NULL;
}

/* To the end. @return What is wrong, or NULL. */
static inline const char *play_all(update_play_t *play, int boards)
{
    int64_t first_us = INT64_MIN;
    while (update_play_step(play)) {
        const char *wrong = wrong_now(play, boards, first_us);
        if (wrong != NULL)
            return wrong;
        for (int i = 0; i < boards; i++)
            if (update_play_switched_us(play, i) > first_us)
                first_us = update_play_switched_us(play, i);
    }
    return update_play_error(play) != NULL ? update_play_error(play) : wrong_at_the_end(play, boards);
}

#endif
