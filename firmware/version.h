// SPDX-License-Identifier: Apache-2.0
// Which firmware this is, for people.
#ifndef FIRMWARE_VERSION_H
#define FIRMWARE_VERSION_H

static const char firmware_version[] = "wallwarp 0.5";

#endif
