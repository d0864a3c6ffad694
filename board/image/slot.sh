#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes a board's kernel partition: kernel, first file system, command line.
#
# usage: board/image/slot.sh BOARD DEBIAN OUT      writes OUT/kernel.vfat
set -eu -o pipefail
umask 022 # modes do not tell of who has cloned this tree
[ $# = 3 ] || { echo "usage: board/image/slot.sh BOARD DEBIAN OUT" >&2; exit 2; }
here=$(dirname "$0")
board=$1
debian=$2
out=$3
. "$here/fat.sh"
files=$out/kernel
kernel=$out/kernel_tree

rm -rf "$files"
mkdir -p "$files"
cp "$kernel"/boot/vmlinuz-* "$files/vmlinuz"
modules=()
[ ! -e "board/$board/modules_early" ] || mapfile -t modules < <(grep -v '^#' "board/$board/modules_early")
board/initramfs.sh "$debian/root/bin/busybox" "$here/init.sh" "$kernel" "$files/initrd" "${modules[@]}"
# Which cores are the pictures' own is told by the board's table.
cores=$("build/info/$board" | grep '^isolcpus=')
own=
[ ! -e "board/$board/cmdline" ] || own=$(cat "board/$board/cmdline")
echo "$(cat "$here/cmdline") $cores $own" >"$files/cmdline"
[ ! -e "$out/boot/board.dtb" ] || cp "$out/boot/board.dtb" "$files/"
fat_image "$out/kernel.vfat" 64 KERNEL "$files"
