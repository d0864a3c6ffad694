// SPDX-License-Identifier: Apache-2.0
// What holds for any traffic on the wire: order, completeness, exact busy time, load of the pose sets.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "sim/bus/sim_bus.h"
#include "sim/bus/sim_can_bits.h"
#include "tests/support/bus_recorder.h"

enum { NODES = 5, STEPS = 300 };

static const sim_bus_config_t classic = {.bitrate = 500000};
static const sim_bus_config_t fd = {.bitrate = 1000000, .data_bitrate = 5000000, .fd = true};

/* A bus with nodes and a log of what they send. */
typedef struct {
    sim_bus_t *bus;
    hal_can_t *node[NODES];
    bus_recorder_t log;
} bench_t;

static void begin(bench_t *bench)
{
    bench->bus = sim_bus_create(&fd);
    for (int i = 0; i < NODES; i++)
        bench->node[i] = sim_bus_attach(bench->bus);
    bench->log.count = 0;
    sim_bus_set_log(bench->bus, bus_recorder_note, &bench->log);
}

static void assert_same_frame(const hal_can_frame_t *a, const hal_can_frame_t *b)
{
    assert_int_equal(a->time_us, b->time_us);
    assert_int_equal(a->id, b->id);
    assert_int_equal(a->extended, b->extended);
    assert_int_equal(a->fd, b->fd);
    assert_int_equal(a->bit_rate_switch, b->bit_rate_switch);
    assert_int_equal(a->length, b->length);
    assert_memory_equal(a->data, b->data, a->length);
}

/* The arbitration field as text: a dominant 0 sorts before a recessive 1, as it wins on the wire. */
static void arbitration_text(char text[34], const hal_can_frame_t *frame)
{
    memset(text, '0', 33);
    text[33] = '\0';
    const uint32_t base = frame->extended ? frame->id >> 18 : frame->id;
    for (int i = 0; i < 11; i++)
        text[i] = (base >> (10 - i) & 1U) != 0 ? '1' : '0';
    if (frame->extended) {
        text[11] = text[12] = '1';
        for (int i = 0; i < 18; i++)
            text[13 + i] = (frame->id >> (17 - i) & 1U) != 0 ? '1' : '0';
    }
    text[frame->extended ? 32 : 13] = frame->fd ? '1' : '0';
}

static void assert_in_order_of_arbitration(const bus_recorder_t *log, uint64_t seed)
{
    for (int i = 1; i < log->count; i++) {
        char before[34], after[34];
        arbitration_text(before, &log->frame[i - 1]);
        arbitration_text(after, &log->frame[i]);
        if (strcmp(before, after) > 0)
            fail_msg("seed %llu: frame %d (%s) was sent before %s", (unsigned long long)seed, i, before, after);
    }
}

static void test_whatever_is_pending_is_sent_in_order_of_arbitration(void **state)
{
    (void)state;
    static bench_t bench;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        uint64_t random = seed;
        begin(&bench);
        uint32_t last_base = 0;
        for (int i = 0; i < 200; i++) {
            hal_can_frame_t frame = bus_random_frame(&random, true);
            if (i % 4 == 3) /* the same base identifier in the other format */
                frame.id = frame.extended ? last_base << 18 | (frame.id & 0x3FFFF) : last_base;
            if (i % 8 == 7 && frame.extended) /* only SRR and IDE tell it from a standard one */
                frame.id &= 0x1FFC0000;
            last_base = frame.extended ? frame.id >> 18 : frame.id;
            assert_int_equal(hal_can_send(bench.node[i % NODES], &frame), HAL_OK);
        }
        sim_bus_advance(bench.bus, 1000000);
        assert_int_equal(bench.log.count, 200);
        assert_in_order_of_arbitration(&bench.log, seed);
        sim_bus_destroy(bench.bus);
    }
}

/* Every other node heard frame number i of the log next. */
static void assert_heard_by_others(const bench_t *bench, int i)
{
    for (int n = 0; n < NODES; n++) {
        hal_can_frame_t frame;
        if (n == bench->log.sender[i])
            continue;
        assert_int_equal(hal_can_receive(bench->node[n], &frame), HAL_OK);
        assert_same_frame(&frame, &bench->log.frame[i]);
    }
}

static void test_nothing_is_lost_or_early_and_the_wire_is_busy_for_the_exact_bits(void **state)
{
    (void)state;
    static bench_t bench;
    static int64_t queued_us[NODES][STEPS];
    for (uint64_t seed = 1; seed <= 20; seed++) {
        uint64_t random = seed;
        begin(&bench);
        int sent[NODES] = {0}, seen[NODES] = {0}, checked = 0;
        int64_t bits_ns = 0, end_us = 0;
        for (int step = 0; step <= STEPS; step++) {
            const int from = (int)(bus_random(&random) % NODES);
            hal_can_frame_t frame = bus_random_frame(&random, true);
            frame.id = (uint32_t)from + 1; /* one identifier a node: its frames keep their order */
            if (step < STEPS) {
                queued_us[from][sent[from]++] = sim_bus_now_us(bench.bus);
                assert_int_equal(hal_can_send(bench.node[from], &frame), HAL_OK);
            }
            const int64_t pause_us = step < STEPS ? (int64_t)(bus_random(&random) % 200) : 1000000;
            sim_bus_advance(bench.bus, sim_bus_now_us(bench.bus) + pause_us);
            for (; checked < bench.log.count; checked++) {
                const sim_can_bits_t bits = sim_can_bits(&bench.log.frame[checked]);
                const int64_t frame_ns = bits.arbitration * 1000 + bits.data * 200;
                const int64_t start_us = bench.log.frame[checked].time_us - (frame_ns - 3000) / 1000;
                const int sender = bench.log.sender[checked];
                if (start_us < queued_us[sender][seen[sender]++] || start_us < end_us)
                    fail_msg("seed %llu: frame %d started early", (unsigned long long)seed, checked);
                bits_ns += frame_ns;
                end_us = bench.log.frame[checked].time_us;
                assert_heard_by_others(&bench, checked);
            }
        }
        assert_int_equal(checked, STEPS);
        for (int n = 0; n < NODES; n++)
            assert_int_equal(hal_can_receive(bench.node[n], &(hal_can_frame_t){0}), HAL_EMPTY);
        assert_int_equal(sim_bus_stats(bench.bus).busy_ns, bits_ns);
        assert_int_equal(sim_bus_stats(bench.bus).frames, STEPS);
        sim_bus_destroy(bench.bus);
    }
}

/* 240 pose sets a second of three 8-byte frames of 111 to 135 bits; a board adds nothing. */
static void test_pose_sets_at_240_hz_load_500_kbit_between_16_and_19_percent(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        uint64_t random = seed;
        sim_bus_t *bus = sim_bus_create(&classic);
        hal_can_t *tracker = sim_bus_attach(bus);
        for (int64_t set = 0; set < 720; set++) {
            sim_bus_advance(bus, set * 1000000 / 240);
            for (uint32_t part = 0; part < 3; part++) {
                hal_can_frame_t frame = {.id = 0x110 + part, .length = 8};
                for (int i = 0; i < 8; i++)
                    frame.data[i] = seed == 1 ? 0 : (uint8_t)bus_random(&random);
                assert_int_equal(hal_can_send(tracker, &frame), HAL_OK);
            }
        }
        sim_bus_advance(bus, 3000000);
        const sim_bus_stats_t stats = sim_bus_stats(bus);
        assert_int_equal(stats.frames, 720 * 3);
        assert_in_range(stats.load_ppm, 159800, 194400);
        assert_in_range(stats.window_load_ppm, 159800, 194400);
        assert_int_equal(stats.busy_ns, stats.bits * 2000);
        sim_bus_destroy(bus);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_whatever_is_pending_is_sent_in_order_of_arbitration),
        cmocka_unit_test(test_nothing_is_lost_or_early_and_the_wire_is_busy_for_the_exact_bits),
        cmocka_unit_test(test_pose_sets_at_240_hz_load_500_kbit_between_16_and_19_percent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
