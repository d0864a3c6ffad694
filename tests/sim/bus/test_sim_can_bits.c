// SPDX-License-Identifier: Apache-2.0
// Frame lengths: by hand, within the known bounds, and against a frame builder written only for tests.
#include "sim/bus/sim_can_bits.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/can_bits_oracle.h"

enum { RANDOM_FRAMES = 20000 };

static uint64_t next_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* Payloads are random bytes, or long runs that need much stuffing. */
static hal_can_frame_t random_frame(uint64_t *state)
{
    hal_can_frame_t frame = {.extended = next_random(state) % 2, .fd = next_random(state) % 2};
    frame.bit_rate_switch = frame.fd && next_random(state) % 2;
    frame.id = (uint32_t)next_random(state) & (frame.extended ? 0x1FFFFFFFU : 0x7FFU);
    frame.length = can_bits_lengths[next_random(state) % (frame.fd ? 16 : 9)];
    const unsigned style = next_random(state) % 4;
    if (style == 0)
        frame.id = 0;
    for (int i = 0; i < frame.length; i++)
        frame.data[i] = style < 2 ? (uint8_t)(next_random(state) % 2 * 0xFF) : (uint8_t)next_random(state);
    return frame;
}

static void assert_bits(const hal_can_frame_t *frame, int arbitration, int data)
{
    const sim_can_bits_t bits = sim_can_bits(frame);
    assert_int_equal(bits.arbitration, arbitration);
    assert_int_equal(bits.data, data);
}

/* 34 zeros to the end of the CRC, so 6 stuff bits; then delimiter, ACK 2, end 7, intermission 3. */
static void test_empty_classic_frame_of_identifier_0(void **state)
{
    (void)state;
    assert_bits(&(hal_can_frame_t){.id = 0}, 34 + 6 + 1 + 2 + 7 + 3, 0);
}

/* 14 zeros with 2 stuff bits, FDF, 7 zeros with 1; 4 + 17 + 6 bits of CRC field; delimiter; 12 bits of tail. */
static void test_empty_fd_frame_of_identifier_0(void **state)
{
    (void)state;
    assert_bits(&(hal_can_frame_t){.id = 0, .fd = true}, 14 + 2 + 1 + 7 + 1 + 27 + 1 + 12, 0);
}

/* With BRS recessive the five zeros after it end the data: the first fixed stuff bit stands for theirs. */
static void test_fixed_stuff_bit_replaces_a_due_one(void **state)
{
    (void)state;
    assert_bits(&(hal_can_frame_t){.id = 0, .fd = true, .bit_rate_switch = true}, 14 + 2 + 3 + 12, 5 + 27 + 1);
}

/* Identifier 555h and bytes 55h need no stuff bit in arbitration and data: 17 + 12, and 5 + 256 + 32 + 1. */
static void test_fd_frame_of_32_bytes_without_stuffing(void **state)
{
    (void)state;
    hal_can_frame_t frame = {.id = 0x555, .fd = true, .bit_rate_switch = true, .length = 32};
    memset(frame.data, 0x55, 32);
    assert_bits(&frame, 29, 294);
    frame.extended = true; /* SRR for RRS, and 18 more identifier bits and IDE: 19 more, none stuffed */
    frame.id = 0x15555555;
    assert_bits(&frame, 29 + 19, 294);
}

/* Random payloads reach the least; runs of four and five bits come near the most. */
static void test_unstuffed_classic_frame_of_8_bytes_has_111_bits(void **state)
{
    (void)state;
    uint64_t seed = 1;
    int least = 1000, most = 0;
    for (int i = 0; i < RANDOM_FRAMES; i++) {
        hal_can_frame_t frame = {.id = (uint32_t)next_random(&seed) & 0x7FF, .length = 8};
        for (int j = 0; j < 8; j++)
            frame.data[j] = i % 2 == 0 ? (uint8_t)next_random(&seed) : (uint8_t)(j % 2 == 0 ? 0x0F : 0x87);
        const int bits = sim_can_bits(&frame).arbitration;
        least = bits < least ? bits : least;
        most = bits > most ? bits : most;
    }
    assert_int_equal(least, 111);
    assert_in_range(most, 111, 135);
}

/* Least: no stuffing. Most: a stuff bit after the first 5 of the stuffed bits, then one each 4 of them. */
static void assert_within_formula(const hal_can_frame_t *frame, uint64_t seed, int index)
{
    const sim_can_bits_t bits = sim_can_bits(frame);
    const int total = bits.arbitration + bits.data;
    const int payload = 8 * frame->length;
    const int classic = frame->extended ? 54 : 34, fd = frame->extended ? 41 : 22;
    const int stuffed = payload + (frame->fd ? fd : classic);
    const int fixed = frame->fd ? (frame->length > 16 ? 32 : 27) : 0;
    const int least = stuffed + fixed + 1 + 12;
    const int most = least + (stuffed - 1) / 4;
    if (total < least || total > most)
        fail_msg("seed %llu frame %d: %d bits, expected %d to %d", (unsigned long long)seed, index, total, least, most);
}

static void test_random_frames_are_as_built_by_the_oracle_and_within_the_formula(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        uint64_t random = seed;
        for (int i = 0; i < RANDOM_FRAMES; i++) {
            const hal_can_frame_t frame = random_frame(&random);
            const sim_can_bits_t bits = sim_can_bits(&frame), expected = can_bits_oracle(&frame);
            if (bits.arbitration != expected.arbitration || bits.data != expected.data)
                fail_msg("seed %llu frame %d (id %x, fd %d, %d bytes): %d + %d bits, expected %d + %d",
                         (unsigned long long)seed, i, (unsigned)frame.id, frame.fd, frame.length, bits.arbitration,
                         bits.data, expected.arbitration, expected.data);
            assert_within_formula(&frame, seed, i);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty_classic_frame_of_identifier_0),
        cmocka_unit_test(test_empty_fd_frame_of_identifier_0),
        cmocka_unit_test(test_fixed_stuff_bit_replaces_a_due_one),
        cmocka_unit_test(test_fd_frame_of_32_bytes_without_stuffing),
        cmocka_unit_test(test_unstuffed_classic_frame_of_8_bytes_has_111_bits),
        cmocka_unit_test(test_random_frames_are_as_built_by_the_oracle_and_within_the_formula),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
