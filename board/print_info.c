// SPDX-License-Identifier: Apache-2.0
// The program behind `make BOARD=NAME info`, built for this machine and linked with the board's two tables.
#include <stdlib.h>

#include "board/board_info.h"

int main(void)
{
    return board_info_print(stdout, &board_table, &board_info) ? EXIT_SUCCESS : EXIT_FAILURE;
}
