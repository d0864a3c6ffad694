#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Packs the virtual board's first file system: init.sh, and what it needs to reach the folders that are the board's root.
#
# usage: tests/board/virtual/initramfs.sh SYSROOT KERNEL      writes KERNEL/initramfs.gz, and KERNEL/root/usr/bin: busybox
#                                                             for the commands that the sysroot, above it, lacks
set -eu
[ $# = 2 ] || { echo "usage: tests/board/virtual/initramfs.sh SYSROOT KERNEL" >&2; exit 2; }
here=$(dirname "$0")
busybox=$1/bin/busybox
root=$2/root
tree=$2/initramfs
version=$(basename "$root"/usr/lib/modules/*)

rm -rf "${tree:?}" "${root:?}/usr/bin"
mkdir -p "$tree"/{bin,dev,modules} "$root/usr/bin"
qemu-aarch64 "$busybox" --list | while read -r command; do
    ln -s busybox "$root/usr/bin/$command"
done

cp "$busybox" "$tree/bin/"
ln -s busybox "$tree/bin/sh"
cp "$here/init.sh" "$tree/init"
# Each after those that it needs.
for module in virtio_pci 9pnet_virtio 9p overlay; do
    modprobe -d "$root/usr" -S "$version" --show-depends "$module"
done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }' | while read -r file; do
    cp "$file" "$tree/modules/"
    echo "${file##*/}" >>"$tree/modules/order"
done
(cd "$tree" && find . | cpio -o -H newc -R 0:0 --quiet) | gzip >"$2/initramfs.gz"
rm -r "$tree"
