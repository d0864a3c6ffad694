# SPDX-License-Identifier: Apache-2.0
# How the board "qemu-virt" is built.
HAL   := linux
CROSS := aarch64-linux-gnu-
CPU   := -mcpu=cortex-a72
