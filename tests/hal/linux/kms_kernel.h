// SPDX-License-Identifier: Apache-2.0
// The kernel's part of a display, played for tests: it takes flips and lights, answers when it is told to, and its time
// passes only while the display sleeps.
#ifndef TESTS_HAL_LINUX_KMS_KERNEL_H
#define TESTS_HAL_LINUX_KMS_KERNEL_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/linux/display_kms_state.h"

enum { KMS_KERNEL_WIDTH = 8, KMS_KERNEL_HEIGHT = 4, KMS_KERNEL_NV12 = 100 };

/** What it was asked, and what it answers. */
typedef struct {
    int answer;                   /**< to flips and lights: 0 or an errno */
    int32_t flips, lights, asked; /**< how many; asked: for a blank without a flip */
    bool darkened;                /**< since the last light */
    kms_scan_t flown, lit;        /**< the newest of each */
    uint64_t token;               /**< of the newest flip; with holds, or request for a blank */
    bool blanks;                  /**< the driver has vertical blanks */
    bool at_once;                 /**< each flip is answered as it comes */
    bool holds;                   /**< requests for blanks are not */
    bool master;
    drmModeModeInfo mode; /**< the only one that is offered */
    int events[2];        /**< a pipe: what it writes, the display reads */
    int64_t now_ns;
    int64_t time_ns; /**< of the last blank */
    uint32_t sequence;
} kms_kernel_t;

extern kms_kernel_t kms_kernel;

/** A lit display with three buffers, framebuffers 1 to 3 in XRGB8888 and KMS_KERNEL_NV12 on in NV12; 1 is shown. */
extern hal_display_t kms_display;

/** Set-up and tear-down of a test: all of it anew. */
int kms_kernel_set_up(void **state);
int kms_kernel_tear_down(void **state);

/** One vertical blank, that answers a request. */
void kms_kernel_answer(uint64_t token);

/** What the connector's file says from now on; the display looks at it in the next wait. */
void kms_kernel_set_status(const char *text);

/** Borrow a buffer and present it, with that result. @return Its framebuffer. */
uint32_t kms_kernel_show(hal_status_t expected);

#endif
