# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Updates for the virtual board, for scripts to source: what its image has, as other versions.
#
#   bundle_make FILE VERSION [LINE]   signed as the image wants it. LINE, of a shell, is run in place of the firmware,
#                                     which is at /usr/local/bin/wallwarp.real
#   stick_make FILE BUNDLE...         a USB stick with these at its top, each named wallwarp-qemu-virt-NAME.raucb for
#                                     FOLDER/NAME.raucb
bundle_image=build/qemu-virt/image
bundle_keys=build/development-key

bundle_make() {
    local work changes=()
    work=$(mktemp -d "$1.XXXXXX") || return 1
    echo "$2" >"$work/version"
    changes=(-p "usr/lib/wallwarp/version f 644 0 0 cat $work/version")
    if [ -n "${3-}" ]; then
        printf '#!/bin/sh\n%s\n' "$3" >"$work/line"
        changes+=(-p "usr/local/bin/wallwarp f 755 0 0 cat $work/line"
            -p "usr/local/bin/wallwarp.real f 755 0 0 cat $bundle_image/root/usr/local/bin/wallwarp")
    fi
    mksquashfs $bundle_image/root "$work/root.squashfs" -all-root -no-xattrs -noappend -comp zstd -Xcompression-level 1 \
        -quiet -no-progress "${changes[@]}" -wildcards -e usr/lib/wallwarp/version ${3:+usr/local/bin/wallwarp} &&
        cp $bundle_image/kernel.vfat "$work/" &&
        board/image/bundle.sh qemu-virt "$work" $bundle_keys/signing.pem $bundle_keys/signing.key "$1" >/dev/null
    local status=$?
    rm -rf "$work"
    return $status
}

stick_make() {
    local file=$1 bundle name
    shift
    rm -f "$file"
    truncate -s 300M "$file"
    mkfs.vfat -s 64 "$file" >/dev/null
    for bundle in "$@"; do
        name=${bundle##*/}
        mcopy -i "$file" "$bundle" "::/wallwarp-qemu-virt-$name" || return
    done
}
