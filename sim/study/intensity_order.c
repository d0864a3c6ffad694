// SPDX-License-Identifier: Apache-2.0
// Whether two rows of figures put the same methods in the same order.
#include "sim/study/intensity_order.h"

void intensity_order_add(intensity_order_t *order, const double *first, const double *second, int32_t count,
                         double least)
{
    for (int32_t a = 0; a < count; a++)
        for (int32_t b = 0; b < count; b++)
            if (first[a] > first[b] + least) {
                order->pairs++;
                order->kept += second[a] > second[b];
            }
}

double intensity_order_percent(const intensity_order_t *order)
{
    return order->pairs > 0 ? 100.0 * (double)order->kept / (double)order->pairs : 100.0;
}
