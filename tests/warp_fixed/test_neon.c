// SPDX-License-Identifier: Apache-2.0
// Short vectors, loads, stores, and narrower numbers as neon.h has them: lane by lane as Arm's manual defines them.
#include "tests/support/lanes.h"

static void halves(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < 100; seed++) {
        round_t r = new_round(seed);
        const uint8x16_t a = r.a.vector, b = r.b.vector;
        memcpy(r.expected.u8, r.a.u8, 8);
        check_half(&r, "vget_low_u8", vget_low_u8(a));
        check_half(&r, "vget_low_s16", vreinterpret_u8_s16(vget_low_s16(vreinterpretq_s16_u8(a))));
        check_half(&r, "vget_low_u16", vreinterpret_u8_u16(vget_low_u16(vreinterpretq_u16_u8(a))));
        check_half(&r, "vget_low_s32", vreinterpret_u8_s32(vget_low_s32(vreinterpretq_s32_u8(a))));
        check_half(&r, "vld1_u8", vld1_u8(r.a.u8));
        uint8_t stored[8];
        vst1_u8(stored, vget_low_u8(a));
        check_bytes(&r, "vst1_u8", stored, sizeof stored);
        memcpy(r.expected.u8, r.a.u8 + 8, 8);
        check_half(&r, "vget_high_u8", vget_high_u8(a));
        check_half(&r, "vget_high_s16", vreinterpret_u8_s16(vget_high_s16(vreinterpretq_s16_u8(a))));
        check_half(&r, "vget_high_u16", vreinterpret_u8_u16(vget_high_u16(vreinterpretq_u16_u8(a))));
        check_half(&r, "vget_high_s32", vreinterpret_u8_s32(vget_high_s32(vreinterpretq_s32_u8(a))));
        memset(r.expected.u8, r.a.u8[5], 8);
        check_half(&r, "vdup_n_u8", vdup_n_u8(r.a.u8[5]));
        check_half(&r, "vld1_dup_u8", vld1_dup_u8(&r.a.u8[5]));
        memcpy(r.expected.u8, r.a.u8 + 8, 8);
        memcpy(r.expected.u8 + 8, r.b.u8, 8);
        const uint8x8_t low = vget_high_u8(a), high = vget_low_u8(b);
        check(&r, "vcombine_u8", vcombine_u8(low, high));
        check(&r, "vcombine_s16",
              vreinterpretq_u8_s16(vcombine_s16(vreinterpret_s16_u8(low), vreinterpret_s16_u8(high))));
        check(&r, "vcombine_u16",
              vreinterpretq_u8_u16(vcombine_u16(vreinterpret_u16_u8(low), vreinterpret_u16_u8(high))));
        check(&r, "vcombine_s32",
              vreinterpretq_u8_s32(vcombine_s32(vreinterpret_s32_u8(low), vreinterpret_s32_u8(high))));
        check(&r, "vcombine_s64",
              vreinterpretq_u8_s64(vcombine_s64(vreinterpret_s64_u8(low), vreinterpret_s64_u8(high))));
        memset(r.expected.u8 + 4, 0, 4);
        memcpy(r.expected.u8, r.a.u8 + 3, 4);
        check_half(&r, "load_word",
                   vreinterpret_u8_u32(vset_lane_u32(0, vreinterpret_u32_u8(vget_low_u8(load_word(r.a.u8 + 3))), 1)));
        r.expected = r.a;
        uint32_t numbers[4];
        vst1q_u32(numbers, vreinterpretq_u32_u8(a));
        check_bytes(&r, "vst1q_u32", numbers, sizeof numbers);
    }
}

static void rows_of_vectors(void **state)
{
    (void)state;
    int16_t numbers[32];
    for (int i = 0; i < 32; i++)
        numbers[i] = (int16_t)(i * 1001);
    const int16x8x4_t four = vld1q_s16_x4(numbers);
    assert_memory_equal(&four, numbers, sizeof four);
    const int16x8x3_t three = vld1q_s16_x3(numbers);
    assert_memory_equal(&three, numbers, sizeof three);
}

static uint8_t saturated(int32_t value)
{
    return value < 0 ? 0 : value > UINT8_MAX ? UINT8_MAX : (uint8_t)value;
}

static void narrower_numbers(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const int16x8_t a = vreinterpretq_s16_u8(r.a.vector);
        const uint16x8_t u = vreinterpretq_u16_u8(r.a.vector);
        for (int i = 0; i < 8; i++)
            r.expected.u8[i] = saturated(r.a.s16[i] >> 6);
        check_half(&r, "vqshrun_n_s16", vqshrun_n_s16(a, 6));
        for (int i = 0; i < 8; i++)
            r.expected.u8[i] = saturated((r.a.s16[i] + 8) >> 4);
        check_half(&r, "vqrshrun_n_s16 by 4", vqrshrun_n_s16(a, 4));
        for (int i = 0; i < 8; i++)
            r.expected.u8[i] = saturated((r.a.s16[i] + 128) >> 8);
        check_half(&r, "vqrshrun_n_s16 by 8", vqrshrun_n_s16(a, 8));
        for (int i = 0; i < 8; i++)
            r.expected.u8[i] = (uint8_t)(r.a.u16[i] >> 6);
        check_half(&r, "vshrn_n_u16", vshrn_n_u16(u, 6));
        for (int i = 0; i < 8; i++)
            r.expected.u8[i] = (uint8_t)r.a.u16[i];
        check_half(&r, "vmovn_u16", vmovn_u16(u));
    }
}

/* Sixteen bits of each of a's numbers, or of it and b's, after rounding. */
static void expect_sixteen(round_t *r, uint32_t sign_of_b, uint64_t rounding, int shift)
{
    for (int i = 0; i < 4; i++) {
        const uint32_t sum = r->a.u32[i] + sign_of_b * r->b.u32[i];
        r->expected.u16[i] = (uint16_t)((sum + rounding) >> shift);
    }
}

static void sixteen_of_thirty_two_bits(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const int32x4_t a = vreinterpretq_s32_u8(r.a.vector), b = vreinterpretq_s32_u8(r.b.vector);
        const uint32x4_t ua = vreinterpretq_u32_u8(r.a.vector), ub = vreinterpretq_u32_u8(r.b.vector);
        expect_sixteen(&r, 0, 0, 0);
        check_half(&r, "vmovn_s32", vreinterpret_u8_s16(vmovn_s32(a)));
        expect_sixteen(&r, 0, 0, 11);
        check_half(&r, "vshrn_n_s32", vreinterpret_u8_s16(vshrn_n_s32(a, 11)));
        check_half(&r, "vshrn_n_u32", vreinterpret_u8_u16(vshrn_n_u32(ua, 11)));
        expect_sixteen(&r, 0, 1 << 7, 8);
        check_half(&r, "vrshrn_n_s32 by 8", vreinterpret_u8_s16(vrshrn_n_s32(a, 8)));
        expect_sixteen(&r, 0, 1 << 15, 16);
        check_half(&r, "vrshrn_n_s32 by 16", vreinterpret_u8_s16(vrshrn_n_s32(a, 16)));
        expect_sixteen(&r, 1, 0, 16);
        check_half(&r, "vaddhn_s32", vreinterpret_u8_s16(vaddhn_s32(a, b)));
        check_half(&r, "vaddhn_u32", vreinterpret_u8_u16(vaddhn_u32(ua, ub)));
        expect_sixteen(&r, UINT32_MAX, 0, 16);
        check_half(&r, "vsubhn_s32", vreinterpret_u8_s16(vsubhn_s32(a, b)));
    }
}

static void numbers_of_64_bits(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const int64x2_t a = vreinterpretq_s64_u8(r.a.vector);
        const int32x2_t x = vreinterpret_s32_u8(vget_low_u8(r.a.vector)),
                        y = vreinterpret_s32_u8(vget_low_u8(r.b.vector));
        for (int i = 0; i < 2; i++)
            r.expected.u32[i] = (uint32_t)(r.a.s64[i] >> 32);
        check_half(&r, "vshrn_n_s64", vreinterpret_u8_s32(vshrn_n_s64(a, 32)));
        for (int i = 0; i < 2; i++)
            r.expected.u32[i] = (uint32_t)(((r.a.s64[i] >> 5) + 1) >> 1);
        check_half(&r, "vrshrn_n_s64", vreinterpret_u8_s32(vrshrn_n_s64(a, 6)));
        for (int i = 0; i < 2; i++)
            r.expected.u32[i] = r.a.u32[i] * r.b.u32[i];
        check_half(&r, "vmul_s32", vreinterpret_u8_s32(vmul_s32(x, y)));
        for (int i = 0; i < 2; i++)
            r.expected.s64[i] = (int64_t)r.a.s32[i] * r.b.s32[i];
        check(&r, "vmull_s32", vreinterpretq_u8_s64(vmull_s32(x, y)));
    }
}

static void halves_of_products(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        for (int i = 0; i < 4; i++)
            r.b.u32[i] |= 1; /* not both factors are -2^31 */
        const int32x4_t a = vreinterpretq_s32_u8(r.a.vector), b = vreinterpretq_s32_u8(r.b.vector);
        const int32x4_t c = vreinterpretq_s32_u8(r.c.vector);
        for (int i = 0; i < 4; i++)
            r.expected.s32[i] = (int32_t)((int64_t)r.a.s32[i] * r.b.s32[i] >> 32);
        check(&r, "upper_product", vreinterpretq_u8_s32(upper_product(a, b)));
        for (int i = 0; i < 4; i++)
            r.expected.u32[i] += r.c.u32[i];
        check(&r, "add_upper_product", vreinterpretq_u8_s32(add_upper_product(c, a, b)));
        for (int i = 0; i < 2; i++) {
            r.expected.u32[i] = (uint32_t)(((uint64_t)r.a.s64[i] + 1) >> 1);
            r.expected.u32[2 + i] = (uint32_t)(((uint64_t)r.b.s64[i] + 1) >> 1);
        }
        check(&r, "rounded_halves",
              vreinterpretq_u8_s32(rounded_halves(vreinterpretq_s64_s32(a), vreinterpretq_s64_s32(b))));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(halves),
        cmocka_unit_test(rows_of_vectors),
        cmocka_unit_test(narrower_numbers),
        cmocka_unit_test(sixteen_of_thirty_two_bits),
        cmocka_unit_test(numbers_of_64_bits),
        cmocka_unit_test(halves_of_products),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
