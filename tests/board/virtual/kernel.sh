#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes the virtual board's kernel from Debian's for arm64, and the modules that it lacks from Debian's source of it.
#
# usage: tests/board/virtual/kernel.sh FOLDER      FOLDER is made anew, with vmlinuz and root/usr/lib/modules
#
# The packages come through mmdebstrap, which has a configuration of its own for apt: this machine's stays as it is, and
# nothing is installed.
set -eu

# As mmdebstrap's hook, in the folder for the packages. The kernel is the one that Debian's package without a version names.
if [ "$*" = --download ]; then
    version=$(apt-cache depends linux-image-arm64:arm64 | sed -n 's/.*Depends: linux-image-//p')
    exec apt-get download -q "linux-image-$version:arm64" "linux-headers-$version:arm64" \
        "linux-headers-${version%-arm64}-common" linux-source-6.1 "linux-kbuild-6.1:$(dpkg --print-architecture)"
fi
[ $# = 1 ] || { echo "usage: tests/board/virtual/kernel.sh FOLDER" >&2; exit 2; }

rm -rf "$1"
mkdir -p "$1/packages"
folder=$(realpath "$1")
log=$folder/log
exec 3>&2 2>"$log"
trap '[ $? = 0 ] || { echo "kernel: failed; the end of $log:"; tail -n 15 "$log"; } >&3' EXIT

fetch() {
    local mode=root package
    [ "$(id -u)" = 0 ] || mode=chrootless
    mmdebstrap --mode="$mode" --variant=extract --architectures="arm64,$(dpkg --print-architecture)" \
        --extract-hook="cd '$folder/packages' && APT_CONFIG=\$MMDEBSTRAP_APT_CONFIG '$(realpath "$0")' --download" \
        bookworm "$folder/apt" >>"$log"
    for package in "$folder"/packages/linux-{headers,kbuild,source}*.deb; do
        dpkg-deb -x "$package" "$folder/headers"
    done
    dpkg-deb -x "$folder"/packages/linux-image-*.deb "$folder/image"
    mkdir -p "$folder/root/usr"
    mv "$folder/image/lib" "$folder/root/usr/lib"
    modules=$(echo "$folder"/root/usr/lib/modules/*)
    version=${modules##*/}
    mv "$folder/image/boot/vmlinuz-$version" "$folder/vmlinuz"
}

build_module() {
    local part=$source/$1
    shift
    make -C "$headers" ARCH=arm64 CROSS_COMPILE=aarch64-linux-gnu- CC=aarch64-linux-gnu-gcc M="$part" "$@" modules >>"$log"
    cp "$part"/*.ko "$modules/extra/"
}

build_modules() {
    headers=$folder/headers/usr/src/linux-headers-$version
    source=$folder/source
    mkdir "$source" "$modules/extra"
    # Debian's names the place where the package would be installed.
    echo "include ${headers%-arm64}-common/Makefile" >"$headers/Makefile"
    tar -xJf "$folder/headers/usr/src/linux-source-6.1.tar.xz" -C "$source" --strip-components=1 \
        linux-source-6.1/{drivers/gpio/gpio-sim.c,drivers/gpio/gpiolib.h,kernel/irq/irq_sim.c} \
        linux-source-6.1/drivers/{media/test-drivers/vimc,gpu/drm/vkms,net/can/ctucanfd}
    # A module may not see the descriptor of an interrupt, but it may deliver one by its number.
    sed -e 's/handle_simple_irq(irq_to_desc(irqnum));/generic_handle_irq(irqnum);/' -e '1i #include <linux/module.h>' \
        -e '$a MODULE_LICENSE("GPL");' "$source/kernel/irq/irq_sim.c" >"$source/drivers/gpio/irq_sim.c"
    echo 'obj-m := irq_sim.o gpio-sim.o' >"$source/drivers/gpio/Makefile"
    build_module drivers/gpio
    build_module drivers/media/test-drivers/vimc CONFIG_VIDEO_VIMC=m
    build_module drivers/gpu/drm/vkms CONFIG_DRM_VKMS=m
    build_module drivers/net/can/ctucanfd CONFIG_CAN_CTUCANFD=m CONFIG_CAN_CTUCANFD_PCI=m
    depmod -b "$folder/root/usr" "$version"
}

fetch
build_modules
rm -r "$folder"/{apt,packages,headers,source,image}
