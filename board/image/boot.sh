#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Gathers what a board starts with: the files of the card's first partition, and its kernel.
#
# usage: board/image/boot.sh BOARD DEBIAN OUT      writes OUT/boot, for the card, and OUT/boot.packages, Debian's
#                                                  packages in it; OUT/kernel_tree, with boot/vmlinuz-* and lib/modules
# A board whose loader or kernel Debian does not have names what it needs in board/BOARD/boot_files; that is taken from the
# folder BOOT in the environment.
set -eu
[ $# = 3 ] || { echo "usage: board/image/boot.sh BOARD DEBIAN OUT" >&2; exit 2; }
here=$(dirname "$0")
board=$1
debian=$2
out=$3
list=$here/../$board/boot_files

rm -rf "${out:?}/boot" "${out:?}/boot.packages" "${out:?}/kernel_tree"
mkdir -p "$out/boot"
if [ ! -e "$list" ]; then
    ln -s "$(realpath "$debian/kernel")" "$out/kernel_tree"
    [ ! -e "$here/boot_$board.sh" ] || "$here/boot_$board.sh" "$debian" "$out/boot"
    exit
fi

missing=
while read -r name what; do
    [ -e "${BOOT:-/nonexistent}/$name" ] || missing+="    $name: $what"$'\n'
done < <(grep -v '^#' "$list")
if [ -n "$missing" ]; then
    printf '%s\n%s' "image: Debian has no loader or kernel for $board; these are missing in BOOT=${BOOT-}, expected: make image BOARD=$board BOOT=FOLDER with" "$missing" >&2
    exit 1
fi
[ "$(dd if="$BOOT/vmlinuz" bs=4 skip=14 count=1 status=none | tr -d '\0')" = ARMd ] ||
    { echo "image: $BOOT/vmlinuz: is no kernel that U-Boot's booti starts, expected arch/arm64/boot/Image of its build" >&2; exit 1; }
modules=$(echo "$BOOT"/modules/*)
[ -d "$modules" ] || { echo "image: BOOT=$BOOT: expected one folder in modules/, named as the kernel's version" >&2; exit 1; }
mkdir -p "$out/kernel_tree"/{boot,lib/modules}
cp "$BOOT/vmlinuz" "$out/kernel_tree/boot/vmlinuz-${modules##*/}"
cp -r "$modules" "$out/kernel_tree/lib/modules/"
depmod -b "$out/kernel_tree" "${modules##*/}"
while read -r name _; do
    [ "$name" = vmlinuz ] || [ "$name" = modules ] || cp -r "$BOOT/$name" "$out/boot/"
done < <(grep -v '^#' "$list")
