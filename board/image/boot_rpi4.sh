#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Fetches what a Raspberry Pi 4 starts with, from Debian's packages: the chip's own firmware and U-Boot.
#
# usage: board/image/boot_rpi4.sh DEBIAN OUT      writes the files of the card's first partition into OUT, and what
#                                                 licences.sh wants of their packages into OUT.packages; DEBIAN is the
#                                                 folder of debian.sh
# NON_FREE=yes in the environment: take packages of Debian's non-free-firmware though this machine's apt does not. The
# machine's configuration stays as it is: mmdebstrap has its own.
set -eu -o pipefail

# Boot EEPROMs from February 2025 on name the partition that start4.elf is to go on with. It understands that on a GPT
# since then, so it must not be older: github.com/raspberrypi/rpi-eeprom, issue 668. Debian 12 and 13 have older ones.
firmware_suite=forky
# Its lists are valid for a week, and mirrors may be behind; their signature is checked all the same.
firmware_source="s/^deb \(\[.*\] \)\?\([^ ]*\) bookworm main.*/deb [check-valid-until=no] \2 $firmware_suite non-free-firmware/p"

# As mmdebstrap's hook, in the folder for the packages.
if [ "$*" = --download ]; then
    exec apt-get download -q "raspi-firmware/$firmware_suite" u-boot-rpi:arm64
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
debian_extract "$packages/root" base-files \
    --setup-hook="cd \"\$1\"/etc/apt && sed -n '$firmware_source' sources.list >sources.list.d/firmware.list" \
    --extract-hook="cd '$(realpath "$packages")' && APT_CONFIG=\$MMDEBSTRAP_APT_CONFIG '$(realpath "$0")' --download"
for package in "$packages"/*.deb; do
    dpkg-deb -x "$package" "$packages/files"
    # shellcheck disable=SC2016 # the ${} are dpkg-deb's
    dpkg-deb -W --showformat '${Package} ${Version} ${source:Package} ${source:Version}\n' "$package" >>"$packages/list"
done
# The U-Boot for a Pi 3 and 4: so it runs on QEMU's Pi 3, too (tests/board/image/pi_start.sh).
cp "$packages"/files/usr/lib/raspi-firmware/{start4.elf,fixup4.dat} "$packages/files/usr/lib/u-boot/rpi_arm64/u-boot.bin" \
    "$2/"
for package in raspi-firmware u-boot-rpi; do
    install -D -m 644 "$packages/files/usr/share/doc/$package/copyright" "$packages/usr/share/doc/$package/copyright"
    cp "$packages/usr/share/doc/$package/copyright" "$2/copyright-$package.txt"
done
rm -r "$packages"/{files,root,root.log,*.deb}

"$here/device_tree_rpi4.sh" "$1" "$2/bcm2711-rpi-4-b.dtb"
cp "$here/../rpi4/config.txt" "$2/"
