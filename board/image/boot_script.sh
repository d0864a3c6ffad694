#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes U-Boot's script of boot.cmd: board/image/boot_script.sh FILE. The same bytes each time.
set -eu
[ $# = 1 ] || { echo "usage: board/image/boot_script.sh FILE" >&2; exit 2; }
SOURCE_DATE_EPOCH=0 mkimage -A arm64 -T script -C none -n wallwarp -d "$(dirname "$0")/boot.cmd" "$1" >/dev/null
