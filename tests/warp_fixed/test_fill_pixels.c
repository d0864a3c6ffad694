// SPDX-License-Identifier: Apache-2.0
// Pixels of one colour: every count and alignment, and not a byte beyond.
#include "warp_fixed/fill_pixels.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdbool.h>
#include <string.h>

enum { MAX_COUNT = 150, GUARD = 64, UNTOUCHED = 0xa5 };

static void check_fill(image_format_t format, int32_t count, size_t offset)
{
    static const uint8_t colour[4] = {10, 20, 30, 40};
    uint8_t bytes[MAX_COUNT * IMAGE_XRGB8888 + 2 * GUARD];
    const size_t size = (size_t)count * format, begin = GUARD - offset;
    memset(bytes, UNTOUCHED, sizeof bytes);
    fill_pixels(bytes + begin, colour, format, count);
    for (size_t k = 0; k < sizeof bytes; k++) {
        const bool within = k >= begin && k < begin + size;
        const int expected = within ? colour[(k - begin) % format] : UNTOUCHED;
        if (bytes[k] != expected)
            fail_msg("%d pixels of %d bytes at offset %zu: byte %td is %d, expected %d", count, (int)format, offset,
                     (ptrdiff_t)k - (ptrdiff_t)begin, bytes[k], expected);
    }
}

static void every_count_and_alignment_is_filled_exactly(void **state)
{
    (void)state;
    for (int32_t count = 0; count <= MAX_COUNT; count++) {
        for (size_t offset = 0; offset < 17; offset++) {
            check_fill(IMAGE_GRAY8, count, offset);
            check_fill(IMAGE_UV88, count, offset);
            check_fill(IMAGE_XRGB8888, count, offset);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_count_and_alignment_is_filled_exactly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
