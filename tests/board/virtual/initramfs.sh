#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Packs the virtual board's first file system: init.sh, and what it needs to reach the folders that are the board's root.
#
# usage: tests/board/virtual/initramfs.sh SYSROOT KERNEL      writes KERNEL/initramfs.gz, and KERNEL/root/usr/bin: busybox
#                                                             for the commands that the sysroot, above it, lacks
set -eu
[ $# = 2 ] || { echo "usage: tests/board/virtual/initramfs.sh SYSROOT KERNEL" >&2; exit 2; }
busybox=$1/bin/busybox
root=$2/root

rm -rf "${root:?}/usr/bin"
mkdir -p "$root/usr/bin"
qemu-aarch64 "$busybox" --list | while read -r command; do
    ln -s busybox "$root/usr/bin/$command"
done
board/initramfs.sh "$busybox" "$(dirname "$0")/init.sh" "$root/usr" "$2/initramfs.gz" virtio_pci 9pnet_virtio 9p overlay
