// SPDX-License-Identifier: Apache-2.0
// Frame lengths: by hand, within the known bounds, and against a frame builder written only for this test.
#include "sim/bus/sim_can_bits.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RANDOM_FRAMES = 20000, LONGEST_STREAM = 1024 };

static const uint8_t fd_lengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};

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
    frame.length = fd_lengths[next_random(state) % (frame.fd ? 16 : 9)];
    const unsigned style = next_random(state) % 4;
    if (style == 0)
        frame.id = 0;
    for (int i = 0; i < frame.length; i++)
        frame.data[i] = style < 2 ? (uint8_t)(next_random(state) % 2 * 0xFF) : (uint8_t)next_random(state);
    return frame;
}

/* Bits as characters, so that the oracle shares nothing with the code under test. */
typedef struct {
    char bit[LONGEST_STREAM];
    int count;
} text_t;

static void put(text_t *text, uint32_t value, int count)
{
    for (int i = count - 1; i >= 0; i--)
        text->bit[text->count++] = (value >> i & 1U) != 0 ? '1' : '0';
}

/* CRC-15 by long division of the whole stream. */
static void put_crc15(text_t *text)
{
    static const char divisor[] = "1100010110011001";
    text_t rest = *text;
    put(&rest, 0, 15);
    for (int i = 0; i < text->count; i++) {
        if (rest.bit[i] == '0')
            continue;
        for (int j = 0; j < 16; j++)
            rest.bit[i + j] = rest.bit[i + j] == divisor[j] ? '0' : '1';
    }
    memcpy(text->bit + text->count, rest.bit + text->count, 15);
    text->count += 15;
}

/* Stuff bits in text[0..count), each told by the index of the bit it follows; returns how many follow [begin, end). */
static int stuff_bits(const text_t *text, int count, int begin, int end)
{
    int found = 0;
    text_t sent = {.count = 0};
    for (int i = 0; i < count; i++) {
        sent.bit[sent.count++] = text->bit[i];
        if (sent.count < 5)
            continue;
        const char *tail = sent.bit + sent.count - 5;
        if (memcmp(tail, "00000", 5) != 0 && memcmp(tail, "11111", 5) != 0)
            continue;
        sent.bit[sent.count++] = text->bit[i] == '0' ? '1' : '0';
        found += i >= begin && i < end;
    }
    return found;
}

static sim_can_bits_t oracle_bits(const hal_can_frame_t *frame)
{
    uint32_t code = 0;
    while (fd_lengths[code] != frame->length)
        code++;
    text_t text = {.count = 0};
    put(&text, 0, 1);
    put(&text, frame->extended ? frame->id >> 18 : frame->id, 11);
    if (frame->extended) {
        put(&text, 3, 2);
        put(&text, frame->id & 0x3FFFF, 18);
    }
    put(&text, 0, frame->extended ? 1 : 2); /* RTR or RRS; IDE of a standard frame */
    if (frame->fd)
        put(&text, frame->bit_rate_switch ? 5 : 4, 3);
    else
        put(&text, 0, frame->extended ? 2 : 1);
    const int switched_at = text.count;
    put(&text, code, frame->fd ? 5 : 4);
    for (int i = 0; i < frame->length; i++)
        put(&text, frame->data[i], 8);
    const int end_of_frame = 1 + 1 + 7 + 3;
    if (!frame->fd) {
        put_crc15(&text);
        const int stuffed = stuff_bits(&text, text.count, 0, text.count);
        return (sim_can_bits_t){.arbitration = text.count + stuffed + 1 + end_of_frame};
    }
    const int crc_field = frame->length > 16 ? 4 + 21 + 7 : 4 + 17 + 6;
    const int before = switched_at + stuff_bits(&text, text.count, 0, switched_at);
    const int stuffed = stuff_bits(&text, text.count, switched_at, text.count - 1);
    const int after = text.count - switched_at + stuffed + crc_field + 1;
    if (frame->bit_rate_switch)
        return (sim_can_bits_t){before + end_of_frame, after};
    return (sim_can_bits_t){.arbitration = before + after + end_of_frame};
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
            const sim_can_bits_t bits = sim_can_bits(&frame), expected = oracle_bits(&frame);
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
