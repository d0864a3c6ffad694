#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Fetches what the images of all boards are made of, from Debian's packages.
#
# usage: board/image/debian.sh FOLDER      makes FOLDER/root, the unpacked packages; FOLDER/kernel, the same of the kernel's
#                                          package; FOLDER/packages, the list of both
set -eu -o pipefail

# As mmdebstrap's hook. The kernel's package would bring what makes an initramfs on a board, so it comes without what it
# depends on. It is the one that Debian's package without a version names.
if [ "${1-}" = --hook ]; then
    cd "$2"
    version=$(APT_CONFIG=$MMDEBSTRAP_APT_CONFIG apt-cache depends linux-image-arm64:arm64 | sed -n 's/.*Depends: linux-image-//p')
    APT_CONFIG=$MMDEBSTRAP_APT_CONFIG apt-get download -q "linux-image-$version:arm64"
    dpkg-deb -x linux-image-*.deb kernel
    cp -r kernel/usr/share/doc/. "$3/usr/share/doc/"
    depmod -b kernel "$version"
    # shellcheck disable=SC2016 # the ${} are dpkg-deb's
    for file in linux-image-*.deb "$3"/var/cache/apt/archives/*.deb; do
        dpkg-deb -W --showformat '${Package} ${Version} ${source:Package} ${source:Version}\n' "$file"
    done | sort >packages
    rm linux-image-*.deb
    exit
fi

[ $# = 1 ] || { echo "usage: board/image/debian.sh FOLDER" >&2; exit 2; }
. "$(dirname "$0")/../debian.sh"

# What the system needs, and what a person at the board wants; busybox has the rest.
system='libc-bin dash kmod udev systemd systemd-sysv dbus iproute2 mount util-linux fdisk e2fsprogs busybox-static
    dropbear-bin ca-certificates systemd-resolved systemd-timesyncd rauc rauc-service libubootenv-tool base-files netbase'
tools='can-utils gpiod v4l-utils'
# What the firmware is linked with, as board/NAME/info.c has it.
libraries='libcyaml1 libmbedcrypto7 libmnl0 libgpiod2 libdrm2 libcamera0.0.3 libcamera-ipa liblo7 libjansson4 libcbor0.8
    libpng16-16'

rm -rf "$1"
mkdir -p "$1"
folder=$(realpath "$1")
debian_extract "$folder/root" "$system $tools $libraries" \
    --extract-hook="'$(realpath "$0")' --hook '$folder' \"\$1\""
