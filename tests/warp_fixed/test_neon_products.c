// SPDX-License-Identifier: Apache-2.0
// Products as neon.h and prefilter_sums_neon.h have them: lane by lane as Arm's manual defines them.
#include "tests/support/lanes.h"
#include "warp_fixed/prefilter_sums_neon.h"

/* Eight lanes of 16 bits from bytes `begin` on, by what they were before, and the products' sign. */
static void expect_products(round_t *r, int begin, int before, int sign)
{
    for (int i = 0; i < 8; i++)
        r->expected.u16[i] = (uint16_t)(before * r->c.u16[i] + sign * r->a.u8[begin + i] * r->b.u8[begin + i]);
}

static void products_of_bytes(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const uint8x16_t a = r.a.vector, b = r.b.vector;
        const uint8x8_t x = vget_low_u8(a), y = vget_low_u8(b);
        const uint16x8_t c = vreinterpretq_u16_u8(r.c.vector);
        expect_products(&r, 0, 0, 1);
        check(&r, "vmull_u8", vreinterpretq_u8_u16(vmull_u8(x, y)));
        expect_products(&r, 0, 1, 1);
        check(&r, "vmlal_u8", vreinterpretq_u8_u16(vmlal_u8(c, x, y)));
        expect_products(&r, 0, 1, -1);
        check(&r, "vmlsl_u8", vreinterpretq_u8_u16(vmlsl_u8(c, x, y)));
        expect_products(&r, 8, 0, 1);
        check(&r, "vmull_high_u8", vreinterpretq_u8_u16(vmull_high_u8(a, b)));
        expect_products(&r, 8, 1, 1);
        check(&r, "vmlal_high_u8", vreinterpretq_u8_u16(vmlal_high_u8(c, a, b)));
        for (int i = 0; i < 8; i++)
            r.expected.s16[i] = (int16_t)(r.a.s8[i] * r.b.s8[i]);
        check(&r, "vmull_s8", vreinterpretq_u8_s16(vmull_s8(vreinterpret_s8_u8(x), vreinterpret_s8_u8(y))));
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = (uint16_t)(r.c.s16[i] + r.a.s8[i] * r.b.s8[i]);
        check(&r, "vmlal_s8",
              vreinterpretq_u8_s16(vmlal_s8(vreinterpretq_s16_u16(c), vreinterpret_s8_u8(x), vreinterpret_s8_u8(y))));
    }
}

static void wider_bytes(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const uint8x16_t a = r.a.vector, b = r.b.vector;
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = r.a.u8[i];
        check(&r, "vmovl_u8", vreinterpretq_u8_u16(vmovl_u8(vget_low_u8(a))));
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = r.a.u8[8 + i];
        check(&r, "vmovl_high_u8", vreinterpretq_u8_u16(vmovl_high_u8(a)));
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = (uint16_t)(r.a.u8[i] + r.b.u8[i]);
        check(&r, "vaddl_u8", vreinterpretq_u8_u16(vaddl_u8(vget_low_u8(a), vget_low_u8(b))));
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = (uint16_t)(r.a.u8[8 + i] + r.b.u8[8 + i]);
        check(&r, "vaddl_high_u8", vreinterpretq_u8_u16(vaddl_high_u8(a, b)));
    }
}

/* Four lanes of 32 bits from number `begin` of a on, weighed by numbers of b: `lane` of them, or each its own. */
static void expect_signed(round_t *r, int begin, int before, int lane)
{
    for (int i = 0; i < 4; i++) {
        const int32_t weight = r->b.s16[lane < 0 ? begin + i : lane];
        r->expected.u32[i] = (uint32_t)before * r->c.u32[i] + (uint32_t)(r->a.s16[begin + i] * weight);
    }
}

static void signed_products(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const int16x8_t a = vreinterpretq_s16_u8(r.a.vector), b = vreinterpretq_s16_u8(r.b.vector);
        const int16x4_t x = vget_low_s16(a), y = vget_low_s16(b);
        const int32x4_t c = vreinterpretq_s32_u8(r.c.vector);
        expect_signed(&r, 0, 0, -1);
        check(&r, "vmull_s16", vreinterpretq_u8_s32(vmull_s16(x, y)));
        expect_signed(&r, 0, 1, -1);
        check(&r, "vmlal_s16", vreinterpretq_u8_s32(vmlal_s16(c, x, y)));
        expect_signed(&r, 4, 0, -1);
        check(&r, "vmull_high_s16", vreinterpretq_u8_s32(vmull_high_s16(a, b)));
        expect_signed(&r, 4, 1, -1);
        check(&r, "vmlal_high_s16", vreinterpretq_u8_s32(vmlal_high_s16(c, a, b)));
        expect_signed(&r, 0, 0, 2);
        check(&r, "vmull_lane_s16", vreinterpretq_u8_s32(vmull_lane_s16(x, y, 2)));
        check(&r, "vmull_n_s16", vreinterpretq_u8_s32(vmull_n_s16(x, r.b.s16[2])));
        expect_signed(&r, 0, 1, 3);
        check(&r, "vmlal_lane_s16", vreinterpretq_u8_s32(vmlal_lane_s16(c, x, y, 3)));
        check(&r, "vmlal_n_s16", vreinterpretq_u8_s32(vmlal_n_s16(c, x, r.b.s16[3])));
        expect_signed(&r, 4, 1, 1);
        check(&r, "vmlal_high_n_s16", vreinterpretq_u8_s32(vmlal_high_n_s16(c, a, r.b.s16[1])));
    }
}

static void expect_unsigned(round_t *r, int begin, int before, int lane)
{
    for (int i = 0; i < 4; i++) {
        const uint32_t weight = r->b.u16[lane < 0 ? begin + i : lane];
        r->expected.u32[i] = (uint32_t)before * r->c.u32[i] + r->a.u16[begin + i] * weight;
    }
}

static void unsigned_products(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const uint16x8_t a = vreinterpretq_u16_u8(r.a.vector), b = vreinterpretq_u16_u8(r.b.vector);
        const uint16x4_t x = vget_low_u16(a), y = vget_low_u16(b);
        const uint32x4_t c = vreinterpretq_u32_u8(r.c.vector);
        expect_unsigned(&r, 0, 0, -1);
        check(&r, "vmull_u16", vreinterpretq_u8_u32(vmull_u16(x, y)));
        expect_unsigned(&r, 0, 1, -1);
        check(&r, "vmlal_u16", vreinterpretq_u8_u32(vmlal_u16(c, x, y)));
        expect_unsigned(&r, 4, 1, -1);
        check(&r, "vmlal_high_u16", vreinterpretq_u8_u32(vmlal_high_u16(c, a, b)));
        expect_unsigned(&r, 0, 0, 3);
        check(&r, "vmull_lane_u16", vreinterpretq_u8_u32(vmull_lane_u16(x, y, 3)));
        expect_unsigned(&r, 0, 1, 1);
        check(&r, "vmlal_lane_u16", vreinterpretq_u8_u32(vmlal_lane_u16(c, x, y, 1)));
    }
}

static void two_weighed_in_each_pair(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        for (int i = 0; i < 8; i++) {
            r.a.u16[i] &= INT16_MAX;
            r.b.u16[i] &= INT16_MAX;
        }
        for (int pair = 0; pair < 4; pair++) {
            for (int i = 0; i < 4; i++)
                r.expected.u32[i] =
                    (uint32_t)r.a.u16[i] * r.b.u16[2 * pair] + (uint32_t)r.a.u16[4 + i] * r.b.u16[2 * pair + 1];
            check(&r, "two_weighed",
                  vreinterpretq_u8_u32(
                      two_weighed(vreinterpretq_u16_u8(r.a.vector), vreinterpretq_u16_u8(r.b.vector), pair)));
        }
    }
}

/* Sums of three products, divided: what all of prefilter_sums_neon.h makes. */
static void filter_sums(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < LANES_ROUNDS; seed++) {
        round_t r = new_round(seed);
        const int16_t *weights = r.c.s16;
        uint32_t sums[8];
        for (int i = 0; i < 8; i++)
            sums[i] = (uint32_t)(r.a.s16[i] * weights[0]) + (uint32_t)(r.b.s16[i] * weights[1]) +
                      (uint32_t)(r.a.s16[i] * weights[2]);
        const int16x8_t a = vreinterpretq_s16_u8(r.a.vector), b = vreinterpretq_s16_u8(r.b.vector);
        const sums_t vector = add_product(add_product(product(a, weights[0]), b, weights[1]), a, weights[2]);
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = (uint16_t)((sums[i] + (1 << (FIRST_SHIFT - 1))) >> FIRST_SHIFT);
        check(&r, "first_pass_sums", vreinterpretq_u8_s16(first_pass_sums(vector)));
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = (uint16_t)((sums[i] + (1 << 15)) >> 16);
        check(&r, "rounded_upper_halves", vreinterpretq_u8_s16(rounded_upper_halves(vector)));
        for (int i = 0; i < 8; i++)
            r.expected.u16[i] = (uint16_t)(sums[i] >> 16);
        check(&r, "upper_halves", vreinterpretq_u8_s16(upper_halves(vector)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_of_bytes),        cmocka_unit_test(wider_bytes),
        cmocka_unit_test(signed_products),          cmocka_unit_test(unsigned_products),
        cmocka_unit_test(two_weighed_in_each_pair), cmocka_unit_test(filter_sums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
