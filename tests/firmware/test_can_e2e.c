// SPDX-License-Identifier: Apache-2.0
// Tests of the end-to-end protection: CRCs and counters.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "firmware/can_e2e.h"

/* Published by AUTOSAR for profile 1 (data id 0x123) and profile 5 (data id 0x1234), all other bytes zero; and the
 * usual check values of both polynomials over "123456789". */
static void test_crcs_match_published_values(void **state)
{
    (void)state;
    const uint8_t zero[8] = {0};
    const uint8_t counted[8] = {0, 1};
    assert_int_equal(can_e2e_p01_crc(0x123, zero, 8), 0xCC);
    assert_int_equal(can_e2e_p01_crc(0x123, counted, 8), 0x91);
    assert_int_equal(can_e2e_p05_crc(0x1234, zero, 8), 0xCA1C);
    assert_int_equal(can_e2e_p01_crc(0x3231, (const uint8_t *)"?3456789", 8), 0x37);
    assert_int_equal(can_e2e_p05_crc(0x3938, (const uint8_t *)"??1234567", 9), 0x29B1);
}

static void test_counter_steps(void **state)
{
    (void)state;
    uint32_t lost = 99;
    assert_int_equal(can_e2e_step(14, 0, CAN_E2E_P01_COUNTERS, &lost), CAN_E2E_NEXT);
    assert_int_equal(lost, 0);
    assert_int_equal(can_e2e_step(14, 6, CAN_E2E_P01_COUNTERS, &lost), CAN_E2E_NEXT);
    assert_int_equal(lost, 6);
    assert_int_equal(can_e2e_step(14, 14, CAN_E2E_P01_COUNTERS, &lost), CAN_E2E_DUPLICATE);
    assert_int_equal(lost, 0);
    assert_int_equal(can_e2e_step(1, 13, CAN_E2E_P01_COUNTERS, &lost), CAN_E2E_STALE);
    assert_int_equal(can_e2e_step(5, 1, CAN_E2E_P01_COUNTERS, &lost), CAN_E2E_RESTART);
    assert_int_equal(can_e2e_step(14, 7, CAN_E2E_P01_COUNTERS, &lost), CAN_E2E_RESTART);
    assert_int_equal(can_e2e_step(255, 127, CAN_E2E_P05_COUNTERS, &lost), CAN_E2E_NEXT);
    assert_int_equal(lost, 127);
    assert_int_equal(can_e2e_step(200, 168, CAN_E2E_P05_COUNTERS, &lost), CAN_E2E_STALE);
    assert_int_equal(can_e2e_step(200, 167, CAN_E2E_P05_COUNTERS, &lost), CAN_E2E_RESTART);
    assert_int_equal(lost, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crcs_match_published_values),
        cmocka_unit_test(test_counter_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
