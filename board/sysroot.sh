#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes what programs for arm64 boards are linked with, from Debian's packages: board/sysroot.sh FOLDER
#
# No arm64 program runs and nothing is installed on this machine. The tree is also the root of the virtual board, so it
# holds what its tests call. mmdebstrap knows where Debian's packages are, or takes a place from this machine's apt.
set -eu
[ $# = 1 ] || { echo "usage: board/sysroot.sh FOLDER" >&2; exit 2; }

# The compilers' libraries, as clang looks for them, and what the firmware and its tests are linked with.
libraries='libc6-dev libgcc-12-dev libstdc++-12-dev libcyaml-dev libyaml-dev libpng-dev zlib1g-dev libjansson-dev
    libcbor-dev liblo-dev libmbedtls-dev libdrm-dev libgpiod-dev libcamera-dev libmnl-dev libcmocka-dev'
# What runs on the virtual board beside them.
programs='libc-bin dash bash coreutils procps util-linux mount grep sed mawk findutils kmod udev systemd iproute2 can-utils gpiod v4l-utils
    libcamera-tools libcamera-ipa libdrm-tests busybox-static'

folder=$1
rm -rf "$folder" "$folder.part"
mkdir -p "$(dirname "$folder")"
mode=root
[ "$(id -u)" = 0 ] || mode=chrootless
# bin, sbin and lib are links into usr, as on every Debian system.
# shellcheck disable=SC2016 # $1 is mmdebstrap's
link_usr='for f in bin sbin lib; do mkdir -p "$1/usr/$f"; ln -s "usr/$f" "$1/$f"; done'
# shellcheck disable=SC2086 # one word for each package
packages=$(printf '%s,' $libraries $programs)
if ! mmdebstrap --mode="$mode" --architectures=arm64 --variant=extract \
    --setup-hook="$link_usr" --include="${packages%,}" bookworm "$folder.part" 2>"$folder.log"; then
    echo "sysroot: mmdebstrap failed; the end of what it said, all of which is in $folder.log:" >&2
    tail -n 15 "$folder.log" >&2
    exit 1
fi

# Links from the root would lead a linker out of the tree, into this machine.
find "$folder.part/usr" -type l -lname '/*' -printf '%l\t%p\n' | while IFS=$'\t' read -r target link; do
    [ "${target#/dev/}" = "$target" ] && ln -sfnr "$folder.part$target" "$link"
done
mkdir -p "$folder.part"/{proc,sys,run,root}
ln -sf dash "$folder.part/bin/sh"
mv "$folder.part" "$folder"
