// SPDX-License-Identifier: Apache-2.0
// Pairs that keep their order.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sim/study/intensity_order.h"

static double percent(const double *first, const double *second, int32_t count, double least)
{
    intensity_order_t order = {0, 0};
    intensity_order_add(&order, first, second, count, least);
    return intensity_order_percent(&order);
}

static void same_order_is_kept(void **state)
{
    (void)state;
    assert_true(percent((const double[]){3, 1, 2}, (const double[]){30, 29, 29.5}, 3, 0.0) == 100.0);
}

static void reversed_order_is_not(void **state)
{
    (void)state;
    assert_true(percent((const double[]){3, 1, 2}, (const double[]){1, 3, 2}, 3, 0.0) == 0.0);
}

static void order_that_is_lost_is_not_kept(void **state)
{
    (void)state;
    assert_true(percent((const double[]){3, 1}, (const double[]){1, 1}, 2, 0.1) == 0.0);
    assert_true(percent((const double[]){3, 1}, (const double[]){1, 1.05}, 2, 0.1) == 0.0);
    assert_true(percent((const double[]){3, 1}, (const double[]){1.05, 1}, 2, 0.1) == 100.0);
}

static void each_pair_counts_once(void **state)
{
    (void)state;
    assert_true(percent((const double[]){4, 3, 2, 1}, (const double[]){4, 3, 1, 2}, 4, 0.0) == 100.0 * 5 / 6);
}

static void small_differences_are_no_pairs(void **state)
{
    (void)state;
    assert_true(percent((const double[]){1.0, 1.05}, (const double[]){2, 1}, 2, 0.1) == 100.0);
    assert_true(percent((const double[]){1.0, 1.05, 3.0}, (const double[]){2, 1, 1.5}, 3, 0.1) == 50.0);
}

static void rows_add_up(void **state)
{
    (void)state;
    intensity_order_t order = {0, 0};
    intensity_order_add(&order, (const double[]){1, 2}, (const double[]){1, 2}, 2, 0.0);
    intensity_order_add(&order, (const double[]){1, 2}, (const double[]){2, 1}, 2, 0.0);
    assert_true(intensity_order_percent(&order) == 50.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_order_is_kept),
        cmocka_unit_test(reversed_order_is_not),
        cmocka_unit_test(each_pair_counts_once),
        cmocka_unit_test(small_differences_are_no_pairs),
        cmocka_unit_test(order_that_is_lost_is_not_kept),
        cmocka_unit_test(rows_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
