// SPDX-License-Identifier: Apache-2.0
// Why a board shows its safe picture, in the words that this has for people.
#ifndef FIRMWARE_SAFE_REASON_H
#define FIRMWARE_SAFE_REASON_H

typedef struct projector projector_t;

/** @return One line that stays as it is: "no video". Of no meaning while the board shows another picture. */
const char *safe_reason(const projector_t *projector);

#endif
