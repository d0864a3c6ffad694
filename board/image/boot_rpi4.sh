#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Fetches what a Raspberry Pi 4 starts with, from Debian's packages: the chip's own firmware and U-Boot.
#
# usage: board/image/boot_rpi4.sh DEBIAN OUT      writes the files of the card's first partition into OUT; DEBIAN is the
#                                                 folder of debian.sh
# NON_FREE=yes in the environment: take packages of Debian's non-free-firmware though this machine's apt does not. The
# machine's configuration stays as it is: mmdebstrap has its own.
set -eu -o pipefail

# As mmdebstrap's hook, in the folder for the packages.
if [ "$*" = --download ]; then
    exec apt-get download -q raspi-firmware u-boot-rpi:arm64
fi
[ $# = 2 ] || { echo "usage: board/image/boot_rpi4.sh DEBIAN OUT" >&2; exit 2; }
if [ "${NON_FREE-}" != yes ] && ! apt-cache show raspi-firmware >/dev/null 2>&1; then
    echo "image: a Raspberry Pi starts with firmware of its maker, Debian's package raspi-firmware. It is in non-free-firmware," >&2
    echo "    which this machine's apt does not use. To take it for this image, and change nothing on this machine:" >&2
    echo "    make image BOARD=rpi4 NON_FREE=yes" >&2
    exit 1
fi
here=$(dirname "$0")
. "$here/../debian.sh"
packages=$2.packages
rm -rf "$2" "$packages"
mkdir -p "$2" "$packages"
debian_extract "$packages/root" base-files --components='main non-free-firmware' \
    --extract-hook="cd '$(realpath "$packages")' && APT_CONFIG=\$MMDEBSTRAP_APT_CONFIG '$(realpath "$0")' --download"
for package in "$packages"/*.deb; do
    dpkg-deb -x "$package" "$packages/files"
done
cp "$packages"/files/usr/lib/raspi-firmware/{start4.elf,fixup4.dat} "$packages/files/usr/lib/u-boot/rpi_4/u-boot.bin" "$2/"
for package in raspi-firmware u-boot-rpi; do
    cp "$packages/files/usr/share/doc/$package/copyright" "$2/copyright-$package.txt"
done
rm -r "$packages"

# The kernel's own device tree has no symbols for overlays, so the board's additions are compiled into it.
tree=$(echo "$1"/kernel/usr/lib/linux-image-*/broadcom/bcm2711-rpi-4-b.dtb)
{
    dtc -q -I dtb -O dts "$tree"
    cat "$here/../rpi4/board.dtsi"
} | dtc -q -I dts -O dtb -o "$2/bcm2711-rpi-4-b.dtb" -
cp "$here/../rpi4/config.txt" "$2/"
