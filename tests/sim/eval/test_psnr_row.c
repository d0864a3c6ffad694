// SPDX-License-Identifier: Apache-2.0
// Rows of wallwarp-eval psnr: their columns, and how those of walls add up.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>

#include "sim/eval/psnr_row.h"

static const psnr_row_t front = {.method = "area",
                                 .square_error = 65025,
                                 .limit_square_error = 6502,
                                 .covered = 100,
                                 .samples = 400,
                                 .step = {.in_q16 = 3 << 15, .all_q16 = 2 << 16}};

static void assert_prints(const psnr_row_t *row, const char *expected)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    assert_non_null(out);
    psnr_row_print_header(out, row);
    psnr_row_print(out, row);
    fclose(out);
    assert_string_equal(text, expected);
    free(text);
}

static void columns_are_those_that_are_named(void **state)
{
    (void)state;
    psnr_row_t row = front;
    assert_prints(&row, "method,psnr_db,limit_db,k_in,k_all,coverage\n"
                        "area,20.000,30.000,1.5000,2.0000,0.2500\n");
    row.board = "front";
    assert_prints(&row, "board,method,psnr_db,limit_db,k_in,k_all,coverage\n"
                        "front,area,20.000,30.000,1.5000,2.0000,0.2500\n");
    row.channel = "R";
    assert_prints(&row, "board,channel,method,psnr_db,limit_db,k_in,k_all,coverage\n"
                        "front,R,area,20.000,30.000,1.5000,2.0000,0.2500\n");
    row.board = NULL;
    assert_prints(&row, "channel,method,psnr_db,limit_db,k_in,k_all,coverage\n"
                        "R,area,20.000,30.000,1.5000,2.0000,0.2500\n");
}

static void wall_out_of_view_is_inf(void **state)
{
    (void)state;
    const psnr_row_t row = {.method = "limit", .samples = 400};
    assert_prints(&row, "method,psnr_db,limit_db,k_in,k_all,coverage\n"
                        "limit,inf,inf,0.0000,0.0000,0.0000\n");
}

static void view_is_the_sum_of_its_walls(void **state)
{
    (void)state;
    psnr_row_t view = front;
    const psnr_row_t left = {.method = "area",
                             .square_error = 65025 * 2,
                             .limit_square_error = 6502 * 2,
                             .covered = 200,
                             .samples = 400,
                             .step = {.in_q16 = 1 << 16, .all_q16 = 4 << 16}};
    psnr_row_add(&view, &left);
    assert_prints(&view, "method,psnr_db,limit_db,k_in,k_all,coverage\n"
                         "area,20.000,30.000,1.5000,4.0000,0.7500\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_those_that_are_named),
        cmocka_unit_test(wall_out_of_view_is_inf),
        cmocka_unit_test(view_is_the_sum_of_its_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
