#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes the virtual board's kernel: Debian's for arm64, the modules that it lacks, and the programs that start the board.
#
# usage: tests/board/virtual/kernel.sh SYSROOT FOLDER      FOLDER is made anew:
#   vmlinuz, initramfs.gz    what qemu boots
#   root/                    a layer to put below the sysroot: modules, and busybox for commands that the sysroot lacks
# The packages come through mmdebstrap, which has a configuration of its own for apt: this machine's stays as it is.
set -eu

# As mmdebstrap's hook, in the folder for the packages: the kernel is the one that Debian's package of no version names.
if [ "$*" = --download ]; then
    version=$(apt-cache depends linux-image-arm64:arm64 | sed -n 's/.*Depends: linux-image-//p')
    exec apt-get download -q "linux-image-$version:arm64" "linux-headers-$version:arm64" \
        "linux-headers-${version%-arm64}-common" linux-source-6.1 "linux-kbuild-6.1:$(dpkg --print-architecture)"
fi
[ $# = 2 ] || { echo "usage: tests/board/virtual/kernel.sh SYSROOT FOLDER" >&2; exit 2; }

here=$(dirname "$(realpath "$0")")
sysroot=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
folder=$(realpath "$2")
log=$folder/log
exec 3>&2 2>"$log"
trap '[ $? = 0 ] || { echo "kernel: failed; the end of $log:"; tail -n 15 "$log"; } >&3' EXIT

fetch() {
    mkdir -p "$folder/packages" "$folder/headers"
    mode=root
    [ "$(id -u)" = 0 ] || mode=chrootless
    mmdebstrap --mode="$mode" --variant=extract --architectures="arm64,$(dpkg --print-architecture)" \
        --extract-hook="cd '$folder/packages' && APT_CONFIG=\$MMDEBSTRAP_APT_CONFIG '$(realpath "$0")' --download" \
        bookworm "$folder/apt" >>"$log"
    rm -r "$folder/apt"
    for package in "$folder"/packages/linux-{headers,kbuild,source}*.deb; do
        dpkg-deb -x "$package" "$folder/headers"
    done
    dpkg-deb -x "$folder"/packages/linux-image-*.deb "$folder/image"
    mkdir -p "$folder/root/usr"
    mv "$folder/image/lib" "$folder/root/usr/lib"
    version=$(ls "$folder/root/usr/lib/modules")
    mv "$folder/image/boot/vmlinuz-$version" "$folder/vmlinuz"
    rm -r "$folder/packages" "$folder/image"
}

# The modules that Debian's kernel lacks, from its source; none of this is kept in the tree.
build_modules() {
    source=$folder/source
    headers=$folder/headers/usr/src/linux-headers-$version
    echo "include $folder/headers/usr/src/linux-headers-${version%-arm64}-common/Makefile" >"$headers/Makefile"
    mkdir "$source"
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
    rm -r "$folder/headers" "$source"
}

build_module() {
    part=$1
    shift
    make -C "$headers" ARCH=arm64 CROSS_COMPILE=aarch64-linux-gnu- CC=aarch64-linux-gnu-gcc M="$source/$part" "$@" \
        modules >>"$log"
    mkdir -p "$folder/root/usr/lib/modules/$version/extra"
    cp "$source/$part"/*.ko "$folder/root/usr/lib/modules/$version/extra/"
}

# Names of busybox's commands, as links, for those that no package of the sysroot brings.
link_busybox() {
    mkdir -p "$folder/root/usr/bin"
    qemu-aarch64 "$sysroot/bin/busybox" --list | while read -r name; do
        ln -s busybox "$folder/root/usr/bin/$name"
    done
}

# What must be there before the root is: the files below `initramfs`, modules in the order in which they are to be loaded.
pack_initramfs() {
    tree=$folder/initramfs
    mkdir -p "$tree"/{bin,dev,proc,sys,modules}
    cp "$sysroot/bin/busybox" "$tree/bin/"
    ln -s busybox "$tree/bin/sh"
    install -m 755 "$here/init.sh" "$tree/init"
    for name in virtio_pci 9pnet_virtio 9p overlay; do
        modprobe -d "$folder/root/usr" -S "$version" --show-depends "$name"
    done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }' | while read -r file; do
        cp "$file" "$tree/modules/"
        echo "${file##*/}" >>"$tree/modules/order"
    done
    (cd "$tree" && find . | cpio -o -H newc -R 0:0 --quiet | gzip -9) >"$folder/initramfs.gz"
    rm -r "$tree"
}

fetch
build_modules
link_busybox
pack_initramfs
