#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes a board's root file system: Debian's programs without what a board never runs, the firmware, and its services.
#
# usage: board/image/root.sh BOARD DEBIAN OUT      DEBIAN is the folder of debian.sh; writes the tree OUT/root and its
#                                                  squashfs OUT/root.squashfs
set -eu
[ $# = 3 ] || { echo "usage: board/image/root.sh BOARD DEBIAN OUT" >&2; exit 2; }
here=$(dirname "$0")
board=$1
debian=$2
out=$3
root=$out/root
version=$(basename "$debian"/kernel/lib/modules/*)

copy_programs() {
    rm -rf "$root"
    mkdir -p "$root"
    tar -C "$debian/root" -c -X "$here/root_without" . | tar -C "$root" -x
    # What a licence asks to be with each copy.
    (cd "$debian/root" && find usr/share/doc -name copyright -type f | tar -c -T -) | tar -C "$root" -x
    mkdir -p "$root"/{boot,card,data,dev,proc,sys,run,tmp,var}
    ln -sf dash "$root/usr/bin/sh"
    qemu-aarch64 "$root/usr/bin/busybox" --list | while read -r command; do
        [ -e "$root/usr/bin/$command" ] || [ -e "$root/usr/sbin/$command" ] || ln -s busybox "$root/usr/bin/$command"
    done
}

copy_modules() {
    local file
    grep -hv '^ *#' "$here/modules" "board/$board/modules" | while read -r module _; do
        modprobe -d "$debian/kernel" -S "$version" --show-depends "$module"
    done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }' | while read -r file; do
        install -D -m 644 "$file" "$root/usr/lib/modules/${file#*/lib/modules/}"
    done
    cp "$debian/kernel/lib/modules/$version"/modules.{builtin,builtin.modinfo,order} "$root/usr/lib/modules/$version/"
    depmod -b "$root/usr" "$version"
}

copy_firmware() {
    install -D -m 755 "build/$board/wallwarp" "$root/usr/local/bin/wallwarp"
    "${CROSS:-aarch64-linux-gnu-}strip" "$root/usr/local/bin/wallwarp"
    install -m 755 "build/$board/wallwarp-pose" "$root/usr/local/bin/"
    "${CROSS:-aarch64-linux-gnu-}strip" "$root/usr/local/bin/wallwarp-pose"
    install -D -m 644 -t "$root/etc/udev/rules.d" board/service/60-wallwarp.rules
    install -D -m 644 -t "$root/etc/systemd/network" board/service/80-wallwarp-can.network
    install -D -m 644 -t "$root/etc/systemd/system" board/service/wallwarp.service
    cp -r "$here/tree/." "$root/"
    [ ! -d "board/$board/tree" ] || cp -r "board/$board/tree/." "$root/"
}

set_up() {
    SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH-0} systemd-sysusers --root="$root"
    ln -sfn /usr/lib/systemd/system/multi-user.target "$root/etc/systemd/system/default.target"
    xargs -r systemctl --root="$root" --quiet mask <"$here/masked_units"
    xargs -r systemctl --root="$root" --quiet enable <"$here/enabled_units"
}

copy_programs
copy_modules
copy_firmware
set_up
rm -f "$out/root.squashfs"
mksquashfs "$root" "$out/root.squashfs" -all-root -no-xattrs -noappend -comp zstd -Xcompression-level ${LEVEL-3} \
    -quiet -no-progress
