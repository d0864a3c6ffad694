// SPDX-License-Identifier: Apache-2.0
// Whether two rows of figures put the same methods in the same order.
#ifndef SIM_STUDY_INTENSITY_ORDER_H
#define SIM_STUDY_INTENSITY_ORDER_H

#include <stdint.h>

/** Pairs that differ in the first row, and those of them that differ the same way in the second. */
typedef struct {
    int64_t pairs, kept;
} intensity_order_t;

/** Add all pairs of count figures. @param least  A smaller difference in the first row is none. */
void intensity_order_add(intensity_order_t *order, const double *first, const double *second, int32_t count,
                         double least);

/** @return Kept pairs of all, per cent; 100 when no pair differs. */
double intensity_order_percent(const intensity_order_t *order);

#endif
