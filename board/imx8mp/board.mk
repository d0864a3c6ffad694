# SPDX-License-Identifier: Apache-2.0
# How the board "imx8mp" is built.
HAL   := linux
CROSS := aarch64-linux-gnu-
CPU   := -mcpu=cortex-a53
