#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes the device tree of a Raspberry Pi 4 with its hat: board/image/device_tree_rpi4.sh DEBIAN FILE. DEBIAN is the folder
# of debian.sh. The kernel's own tree has no symbols for overlays, so the board's additions are compiled into it.
set -eu -o pipefail
[ $# = 2 ] || { echo "usage: board/image/device_tree_rpi4.sh DEBIAN FILE" >&2; exit 2; }
tree=$(echo "$1"/kernel/usr/lib/linux-image-*/broadcom/bcm2711-rpi-4-b.dtb)
{
    dtc -q -I dtb -O dts "$tree"
    cat "$(dirname "$0")/../rpi4/board.dtsi"
} | dtc -q -I dts -O dtb -o "$2" -
