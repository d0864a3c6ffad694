#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes what programs for arm64 boards are linked with, from Debian's packages: board/sysroot.sh FOLDER
#
# The tree is also the root of the virtual board, so it holds what its tests call.
set -eu
[ $# = 1 ] || { echo "usage: board/sysroot.sh FOLDER" >&2; exit 2; }

# The compilers' libraries, as clang looks for them, and what the firmware and its tests are linked with.
libraries='libc6-dev libgcc-12-dev libstdc++-12-dev libcyaml-dev libyaml-dev libpng-dev zlib1g-dev libjansson-dev
    libcbor-dev liblo-dev libmbedtls-dev libdrm-dev libgpiod-dev libcamera-dev libmnl-dev libcmocka-dev'
# What runs on the virtual board beside them.
programs='libc-bin dash bash coreutils procps util-linux mount grep sed mawk findutils kmod udev systemd iproute2 can-utils gpiod v4l-utils
    libcamera-tools libcamera-ipa libdrm-tests busybox-static'

. "$(dirname "$0")/debian.sh"
folder=$1
debian_extract "$folder" "$libraries $programs"

# Links from the root would lead a linker out of the tree, into this machine.
find "$folder/usr" -type l -lname '/*' -printf '%l\t%p\n' | while IFS=$'\t' read -r target link; do
    [ "${target#/dev/}" = "$target" ] && ln -sfnr "$folder$target" "$link"
done
mkdir -p "$folder"/{proc,sys,run,root}
ln -sf dash "$folder/bin/sh"
