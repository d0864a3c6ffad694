// SPDX-License-Identifier: Apache-2.0
// Tells QEMU which version of its interface our plugins are for: the one that it serves.
#include "tests/bench/qemu_plugin_abi.h"

int qemu_plugin_version = 1;

/* QEMU reads the version before it calls anything, but after constructors have run. */
__attribute__((constructor)) static void choose_version(void)
{
    if (qemu_plugin_n_vcpus == NULL)
        qemu_plugin_version = 2;
}
