// SPDX-License-Identifier: Apache-2.0
// Tests of the pump: a log comes onto a bus as it was recorded, or with exactly the faults that were asked for.
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "sim/bus/candump_text.h"
#include "sim/bus/sim_bus.h"
#include "sim/bus/socketcand_server.h"
#include "sim/devices/sim_clock.h"
#include "sim/pose/bus_pump.h"
#include "tests/support/scratch.h"

enum { MOST_HEARD = 4096, FRAMES = 50, MILLION = 1000000 };

static const volatile sig_atomic_t going_on = 0;

/* A bus behind a port, in a thread of its own, and what was on it. */
typedef struct {
    sim_bus_t *bus;
    socketcand_server_t *server;
    char address[32];
    int64_t took_us; /* by the pump */
    volatile int quit;
    int count;
    hal_can_frame_t heard[MOST_HEARD];
    pthread_t thread;
} room_t;

static void note(void *context, int sender, const hal_can_frame_t *frame)
{
    room_t *room = context;
    (void)sender;
    if (room->count < MOST_HEARD)
        room->heard[room->count++] = *frame;
}

static void *serve(void *context)
{
    room_t *room = context;
    while (!room->quit || sim_bus_stats(room->bus).frames < socketcand_server_stats(room->server).frames_in) {
        socketcand_server_poll(room->server);
        sim_bus_advance(room->bus, sim_clock_monotonic_us());
        nanosleep(&(struct timespec){.tv_nsec = 300000}, NULL);
    }
    return NULL;
}

static void open_room(room_t *room)
{
    char error[SOCKETCAND_ERROR_LENGTH];
    memset(room, 0, sizeof *room);
    room->bus = sim_bus_create(&(sim_bus_config_t){.bitrate = 1000000, .start_us = sim_clock_monotonic_us()});
    assert_non_null(room->bus);
    sim_bus_set_log(room->bus, note, room);
    room->server = socketcand_server_open(0, room->bus, error);
    assert_non_null(room->server);
    snprintf(room->address, sizeof room->address, "127.0.0.1:%d", socketcand_server_port(room->server));
    assert_int_equal(pthread_create(&room->thread, NULL, serve, room), 0);
}

static void close_room(room_t *room)
{
    room->quit = 1;
    assert_int_equal(pthread_join(room->thread, NULL), 0);
    socketcand_server_close(room->server);
    sim_bus_destroy(room->bus);
}

/* Frame n of the log: every fifth a report, bus time or FrameClock, every seventh an FD frame; two share each time. */
static hal_can_frame_t frame_of_log(int n)
{
    static const uint32_t OTHERS[] = {0x701, 0x040, 0x0BF, 0x17F};
    hal_can_frame_t frame = {.time_us = 77000000 + (int64_t)(n / 2) * 8000,
                             .id = n % 5 == 4 ? OTHERS[n / 5 % 4] : 0x110,
                             .fd = n % 7 == 6,
                             .length = 8,
                             .data = {(uint8_t)n, 1, 2, 3, 4, 5, 6, 7}};
    return frame;
}

static bool is_sent(int n)
{
    return n % 5 != 4 && n % 7 != 6;
}

static void write_log(const char *path)
{
    char text[FRAMES * CANDUMP_TEXT_LENGTH];
    size_t length = 0;
    for (int n = 0; n < FRAMES; n++) {
        const hal_can_frame_t frame = frame_of_log(n);
        length += candump_text_from_frame(text + length, &frame, "can3");
        text[length++] = '\n';
        if (n == 3)
            text[length++] = '\n'; /* an empty line does no harm */
    }
    scratch_write(path, text, length);
}

/* Pumps the log into the room. */
static bus_pump_counts_t pump(room_t *room, const scratch_t *scratch, bus_pump_t settings)
{
    char path[SCRATCH_PATH_LENGTH], error[BUS_PUMP_MESSAGE_LENGTH];
    bus_pump_counts_t counts;
    scratch_path(scratch, "walk.log", path);
    write_log(path);
    open_room(room);
    settings.bus = room->address;
    settings.log = path;
    settings.stop = &going_on;
    const int64_t start_us = sim_clock_monotonic_us();
    if (!bus_pump(&settings, &counts, error))
        fail_msg("%s", error);
    room->took_us = sim_clock_monotonic_us() - start_us;
    close_room(room);
    return counts;
}

static void test_log_comes_as_it_was_recorded(void **state)
{
    static room_t room;
    const bus_pump_counts_t counts = pump(&room, *state, (bus_pump_t){.speed = 1});
    int heard = 0;
    for (int n = 0; n < FRAMES; n++) {
        if (!is_sent(n))
            continue;
        assert_true(heard < room.count);
        assert_int_equal(room.heard[heard].data[0], n);
        assert_int_equal(room.heard[heard++].id, 0x110);
    }
    assert_int_equal(room.count, heard);
    assert_int_equal(counts.sent, heard);
    assert_int_equal(counts.taken, heard);
    assert_true(room.took_us >= frame_of_log(FRAMES - 1).time_us - frame_of_log(0).time_us);
}

static void test_reports_are_sent_when_asked_for(void **state)
{
    static room_t room;
    const bus_pump_counts_t counts = pump(&room, *state, (bus_pump_t){.speed = 100, .reports = true});
    int expected = 0;
    for (int n = 0; n < FRAMES; n++)
        expected += n % 7 != 6;
    assert_int_equal(room.count, expected);
    assert_int_equal(counts.sent, expected);
}

static void test_dropped_all(void **state)
{
    static room_t room;
    const bus_pump_counts_t counts = pump(&room, *state, (bus_pump_t){.speed = 100, .faults = {.drop_ppm = MILLION}});
    assert_int_equal(room.count, 0);
    assert_int_equal(counts.sent, 0);
    assert_int_equal(counts.dropped, counts.taken);
}

static void test_duplicated_all(void **state)
{
    static room_t room;
    (void)pump(&room, *state, (bus_pump_t){.speed = 100, .faults = {.duplicate_ppm = MILLION}});
    int heard = 0;
    for (int n = 0; n < FRAMES; n++)
        for (int copy = 0; is_sent(n) && copy < 2; copy++)
            assert_int_equal(room.heard[heard++].data[0], n);
    assert_int_equal(room.count, heard);
}

/* Half of the frames come 40 ms late: after others that were recorded later, and none is lost. */
static void test_delayed_ones_are_overtaken(void **state)
{
    static room_t room;
    const bus_pump_counts_t counts =
        pump(&room, *state, (bus_pump_t){.speed = 1, .seed = 7, .faults = {.delay_ppm = MILLION / 2, .delay_ms = 40}});
    int overtaken = 0, seen[256] = {0};
    for (int i = 0; i < room.count; i++) {
        seen[room.heard[i].data[0]]++;
        overtaken += i > 0 && room.heard[i].data[0] < room.heard[i - 1].data[0];
    }
    for (int n = 0; n < FRAMES; n++)
        assert_int_equal(seen[n], is_sent(n) ? 1 : 0);
    assert_true(counts.delayed > 0 && counts.delayed < counts.taken && overtaken > 0);
}

/* One frame a microsecond is more than it can send: the pump is late, but what is due first still goes first. */
static void test_a_late_pump_keeps_the_order(void **state)
{
    enum { LATE_FRAMES = 1500, DELAY = 1000 /* frames, and us */ };
    static room_t room;
    static char text[LATE_FRAMES * CANDUMP_TEXT_LENGTH];
    const bus_faults_t faults = {.delay_ppm = MILLION / 10, .delay_ms = 1};
    rng_t rng = {.state = 3};
    bool late[LATE_FRAMES];
    size_t length = 0;
    for (int n = 0; n < LATE_FRAMES; n++) {
        hal_can_frame_t frame = {
            .time_us = n * 1000, .id = 0x110, .length = 2, .data = {(uint8_t)n, (uint8_t)(n >> 8)}};
        bus_pump_counts_t counts = {.taken = 0};
        length += candump_text_from_frame(text + length, &frame, "can3");
        text[length++] = '\n';
        (void)bus_pump_strike(&faults, &rng, &frame, &counts, &late[n]);
    }
    char path[SCRATCH_PATH_LENGTH], error[BUS_PUMP_MESSAGE_LENGTH];
    bus_pump_counts_t counts;
    scratch_path(*state, "long.log", path);
    scratch_write(path, text, length);
    open_room(&room);
    const bus_pump_t settings = {
        .bus = room.address, .log = path, .speed = 1000, .faults = faults, .seed = 3, .stop = &going_on};
    assert_true(bus_pump(&settings, &counts, error));
    close_room(&room);
    assert_int_equal(room.count, LATE_FRAMES);
    int heard = 0;
    for (int due = 0; due < LATE_FRAMES + DELAY; due++) {
        for (int kind = 0; kind < 2; kind++) {
            const int n = kind == 0 ? due - DELAY : due; /* the delayed one was there first */
            if (n < 0 || n >= LATE_FRAMES || late[n] != (kind == 0))
                continue;
            const uint8_t *data = room.heard[heard++].data;
            if (data[0] + 256 * data[1] != n)
                fail_msg("frame %d on the bus is number %d, expected %d", heard, data[0] + 256 * data[1], n);
        }
    }
}

static void test_chances_are_kept(void **state)
{
    (void)state;
    const bus_faults_t faults = {.drop_ppm = 100000, .duplicate_ppm = 50000, .corrupt_ppm = 200000, .delay_ppm = 10000};
    bus_pump_counts_t counts = {.taken = 0};
    rng_t rng = {5};
    int64_t copies = 0;
    for (int i = 0; i < MILLION; i++) {
        hal_can_frame_t frame = {.length = 8}, before = frame;
        const int64_t corrupted = counts.corrupted;
        bool late = false;
        const int times = bus_pump_strike(&faults, &rng, &frame, &counts, &late);
        copies += times;
        int bits = 0;
        for (int b = 0; b < 8; b++)
            bits += __builtin_popcount((unsigned)(frame.data[b] ^ before.data[b]));
        /* two of three turns may meet in one bit */
        assert_in_range(bits, 0, counts.corrupted > corrupted ? 3 : 0);
    }
    assert_in_range(counts.dropped, 98500, 101500);
    assert_in_range(counts.duplicated, 44300, 45700); /* of what is not dropped */
    assert_in_range(counts.corrupted, 178500, 181500);
    assert_in_range(counts.delayed, 8700, 9300);
    assert_int_equal(copies, MILLION - counts.dropped + counts.duplicated);
    hal_can_frame_t empty = {.length = 0};
    bool late = false;
    assert_int_equal(bus_pump_strike(&(bus_faults_t){.corrupt_ppm = MILLION}, &rng, &empty, &counts, &late), 1);
}

static void test_bad_logs_are_refused_with_their_line(void **state)
{
    static const char *const text[][2] = {
        {"nonsense\n", "bad.log:1: expected a time"},
        {"(1.000000) can0 123#11\n\n(1.000000) can0 123#1\n", "bad.log:3: expected pairs"},
    };
    char path[SCRATCH_PATH_LENGTH], error[BUS_PUMP_MESSAGE_LENGTH];
    scratch_path(*state, "bad.log", path);
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        static room_t room;
        bus_pump_counts_t counts;
        scratch_write(path, text[i][0], strlen(text[i][0]));
        open_room(&room);
        const bus_pump_t settings = {.bus = room.address, .log = path, .speed = 1, .stop = &going_on};
        assert_false(bus_pump(&settings, &counts, error));
        close_room(&room);
        if (strstr(error, text[i][1]) == NULL)
            fail_msg("\"%s\" is not in \"%s\"", text[i][1], error);
    }
    bus_pump_counts_t counts;
    const bus_pump_t missing = {.bus = "127.0.0.1:1", .log = "no/such.log", .speed = 1, .stop = &going_on};
    assert_false(bus_pump(&missing, &counts, error));
    assert_non_null(strstr(error, "no/such.log"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_log_comes_as_it_was_recorded),
        cmocka_unit_test(test_reports_are_sent_when_asked_for),
        cmocka_unit_test(test_dropped_all),
        cmocka_unit_test(test_duplicated_all),
        cmocka_unit_test(test_delayed_ones_are_overtaken),
        cmocka_unit_test(test_a_late_pump_keeps_the_order),
        cmocka_unit_test(test_chances_are_kept),
        cmocka_unit_test(test_bad_logs_are_refused_with_their_line),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
