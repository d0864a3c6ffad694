// SPDX-License-Identifier: Apache-2.0
// A CAN frame out of a fuzzer's input.
#ifndef TESTS_FUZZ_INPUT_FRAME_H
#define TESTS_FUZZ_INPUT_FRAME_H

#include "hal/hal_can.h"
#include "tests/fuzz/input.h"

/**
 * @return A frame that a controller could deliver: any identifier, flags, legal length and bytes. Most of them have an
 *         identifier of wallwarp.dbc and a CRC that is right for it. Its time is 0.
 */
hal_can_frame_t input_frame(input_t *input);

#endif
