// SPDX-License-Identifier: Apache-2.0
// A board's sessions, numbers for commands, and signatures.
#include "firmware/bus_auth.h"

#include <string.h>

#include "firmware/can_latency.h"

_Static_assert((int)AUTH_CLOCK_FIRST_US >= (int)BUS_AUTH_NONCE_US, "a session's time is no older than its number");

void bus_auth_init(bus_auth_t *auth, can_auth_t *key, uint8_t viewer, uint64_t seed)
{
    memset(auth, 0, sizeof *auth);
    auth->key = key;
    auth->viewer = viewer;
    auth->seed = seed;
}

bool bus_auth_may_speak(const bus_auth_t *auth)
{
    return auth->key == NULL || auth->has_session;
}

bool bus_auth_wants_session(const bus_auth_t *auth, int64_t now_us)
{
    return auth->key != NULL && (!auth->has_session || now_us - auth->tracker_us > BUS_AUTH_SILENT_US);
}

/* In the same session what was taken stays old. */
static void begin_stream(can_auth_stream_t *stream, uint64_t session, uint64_t bus_us)
{
    if (stream->session != session || stream->newest_us < bus_us)
        stream->newest_us = bus_us;
    stream->session = session;
}

static void begin_own(can_auth_fresh_t *fresh, uint64_t session, uint64_t bus_us)
{
    if (fresh->session != session || fresh->time_us < bus_us)
        fresh->time_us = bus_us;
    fresh->session = session;
}

void bus_auth_begin_session(bus_auth_t *auth, uint64_t session, uint64_t bus_us, int64_t now_us)
{
    auth->has_session = true;
    auth->session = session;
    auth_clock_begin(&auth->clock, bus_us, now_us);
    auth->tracker_us = now_us;
    begin_stream(&auth->fd, session, bus_us);
    begin_stream(&auth->set, session, bus_us);
    for (int i = 0; i <= CAN_MAX_NODE; i++) {
        begin_stream(&auth->time[i], session, bus_us);
        begin_stream(&auth->frame_clock[i], session, bus_us);
        begin_stream(&auth->latency[i], session, bus_us);
    }
    begin_own(&auth->own_time, session, bus_us);
    begin_own(&auth->own_clock, session, bus_us);
    begin_own(&auth->own_latency, session, bus_us);
}

uint64_t bus_auth_give_nonce(bus_auth_t *auth, int64_t now_us)
{
    auth->nonce_given = can_auth_random(auth->key, auth->seed, auth->nonces++, &auth->nonce);
    auth->nonce_us = now_us;
    return auth->nonce;
}

int bus_auth_check_command(bus_auth_t *auth, uint32_t id, const uint8_t *command, int length, int64_t now_us)
{
    const can_auth_command_t plain = {id, command, length - CAN_AUTH_COMMAND_BYTES, auth->nonce};
    const bool given = auth->nonce_given && now_us - auth->nonce_us <= BUS_AUTH_NONCE_US;
    auth->nonce_given = false;
    return given && plain.length > 0 && can_auth_check_command(auth->key, &plain, command + plain.length) ? plain.length
                                                                                                          : 0;
}

/* @return Is the code on its way? */
static bool send_code(const bus_auth_t *auth, can_auth_fresh_t fresh, const can_auth_message_t *message, hal_can_t *can)
{
    hal_can_frame_t tag;
    return can_auth_sign(auth->key, fresh, message, &tag) && hal_can_send(can, &tag) == HAL_OK;
}

static uint64_t sign_time_us(const bus_auth_t *auth, const bus_time_t *time, int64_t now_us)
{
    return auth_clock_sign_us(&auth->clock, bus_time_from_local(time, now_us), now_us);
}

void bus_auth_sign(bus_auth_t *auth, bus_master_t *master, frame_clock_t *clock, hal_can_t *can, int64_t now_us)
{
    if (auth->key == NULL || !auth->has_session)
        return;
    const uint64_t time_us = sign_time_us(auth, &master->time, now_us);
    if (master->paired) {
        const can_auth_message_t pair = {master->pair, 2, CAN_AUTH_ID_TIME + (uint32_t)master->number};
        can_auth_fresh_step(&auth->own_time, time_us);
        master->unsent += !send_code(auth, auth->own_time, &pair, can);
    }
    if (clock->said > 0) {
        const can_auth_message_t said = {clock->say, clock->said, CAN_AUTH_ID_FRAME_CLOCK + (uint32_t)clock->node};
        can_auth_fresh_step(&auth->own_clock, time_us);
        master->unsent += !send_code(auth, auth->own_clock, &said, can);
    }
}

bool bus_auth_sign_latency(bus_auth_t *auth, const bus_time_t *time, const hal_can_frame_t *latency, hal_can_t *can,
                           int64_t now_us)
{
    if (auth->key == NULL || !auth->has_session)
        return true;
    const can_auth_message_t message = {latency, 1, latency->id + CAN_AUTH_ID_LATENCY - CAN_ID_LATENCY};
    can_auth_fresh_step(&auth->own_latency, sign_time_us(auth, time, now_us));
    return send_code(auth, auth->own_latency, &message, can);
}
