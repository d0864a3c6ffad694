#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes a board's root file system: Debian's programs without what a board never runs, the firmware, and its services.
#
# usage: board/image/root.sh BOARD DEBIAN CA VERSION OUT      DEBIAN is the folder of debian.sh, CA the certificate that
#                                                             bundles must come from; writes the tree OUT/root and its
#                                                             squashfs OUT/root.squashfs
set -eu -o pipefail
umask 022 # modes do not tell of who has cloned this tree
[ $# = 5 ] || { echo "usage: board/image/root.sh BOARD DEBIAN CA VERSION OUT" >&2; exit 2; }
here=$(dirname "$0")
board=$1
debian=$2
ca=$3
update_version=$4
out=$5
root=$out/root
kernel=$out/kernel_tree
version=$(basename "$kernel"/lib/modules/*)

copy_programs() {
    rm -rf "$root"
    mkdir -p "$root"
    tar -C "$debian/root" -c -X "$here/root_without" . | tar -C "$root" -xp
    # What a licence asks to be with each copy.
    (cd "$debian/root" && find usr/share/doc -name copyright -type f | tar -c -T -) | tar -C "$root" -x
    mkdir -p "$root"/{boot,card,data,dev,proc,sys,run,tmp,var}
    ln -sf dash "$root/usr/bin/sh"
    qemu-aarch64 "$root/usr/bin/busybox" --list | while read -r command; do
        [ -e "$root/usr/bin/$command" ] || [ -e "$root/usr/sbin/$command" ] || ln -s busybox "$root/usr/bin/$command"
    done
}

# keep_only FOLDER NAME...: what else is in this folder of Debian's costs a board time at each start.
keep_only() {
    local folder=$root/usr/lib/$1 file
    shift
    for file in "$folder"/*; do
        [ ! -e "$file" ] && [ ! -L "$file" ] || [[ " $* " == *" ${file##*/} "* ]] || rm -r "$file"
    done
}

trim_start() {
    local wants
    keep_only systemd/system-generators
    keep_only tmpfiles.d dbus.conf static-nodes-permissions.conf systemd.conf
    keep_only udev/rules.d 50-udev-default.rules 60-block.rules 60-persistent-storage.rules 60-persistent-v4l.rules \
        80-drivers.rules 99-systemd.rules
    for wants in "$root"/usr/lib/systemd/system/*.wants; do
        keep_only "systemd/system/${wants##*/}" systemd-journald.service systemd-journald.socket \
            systemd-journald-dev-log.socket systemd-journal-flush.service systemd-tmpfiles-setup.service \
            systemd-udevd.service systemd-udevd-control.socket systemd-udevd-kernel.socket systemd-udev-trigger.service \
            dbus.socket
    done
}

# Those of Debian's kernel that the board needs, or all that a user has chosen.
copy_modules() {
    local file
    mkdir -p "$root/usr/lib/modules"
    if [ ! -e "board/$board/modules" ]; then
        cp -r "$kernel/lib/modules/$version" "$root/usr/lib/modules/"
        return
    fi
    grep -hv '^ *#' "$here/modules" "board/$board/modules" | while read -r module; do
        modprobe -d "$kernel" -S "$version" --show-depends "$module"
    done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }' | while read -r file; do
        install -D -m 644 "$file" "$root/usr/lib/modules/${file#*/lib/modules/}"
    done
    cp "$kernel/lib/modules/$version"/modules.{builtin,builtin.modinfo,order} "$root/usr/lib/modules/$version/"
    depmod -b "$root/usr" "$version"
}

# copy_tree FOLDER: with modes that do not tell of who has checked it out.
copy_tree() {
    tar -C "$1" --mode=u=rwX,go=rX -c . | tar -C "$root" -x --no-overwrite-dir
}

copy_firmware() {
    local program
    for program in wallwarp wallwarp-pose; do
        install -D -m 755 "build/$board/$program" "$root/usr/local/bin/$program"
        # The number of a build tells of the folder that it was made in.
        aarch64-linux-gnu-strip -R .note.gnu.build-id "$root/usr/local/bin/$program"
    done
    install -D -m 644 LICENSE "$root/usr/share/doc/wallwarp/copyright"
    install -D -m 644 -t "$root/etc/udev/rules.d" board/service/60-wallwarp.rules
    install -D -m 644 -t "$root/etc/systemd/network" board/service/80-wallwarp-can.network
    install -D -m 644 -t "$root/etc/systemd/system" board/service/wallwarp.service
    "$here/update_files.sh" "$board" "$root" "$ca" "$update_version"
    copy_tree "$here/tree"
    [ ! -d "board/$board/tree" ] || copy_tree "board/$board/tree"
}

# What Debian's packages do when they are installed.
set_up() {
    cp "$root/usr/share/libc-bin/nsswitch.conf" "$root/etc/nsswitch.conf"
    cat "$root"/usr/share/ca-certificates/mozilla/*.crt >"$root/etc/ssl/certs/ca-certificates.crt"
    rm -rf "$root/usr/share/ca-certificates"
    systemd-sysusers --root="$root" 2>"$out/users.log"
    # What is made by others than root: of mode 0 these would be empty, and no program can be given another's rights,
    # which none on a board needs.
    chmod 600 "$root"/etc/shadow "$root"/etc/gshadow
    chmod 1777 "$root/tmp"
    find "$root" -perm /6000 -exec chmod a-s {} +
    ln -sfn /usr/lib/systemd/system/multi-user.target "$root/etc/systemd/system/default.target"
    xargs systemctl --root="$root" --quiet enable <"$here/enabled_units"
    systemctl --root="$root" --quiet disable systemd-network-generator.service systemd-networkd-wait-online.service
    # A board without a clock starts no earlier than this.
    touch -d "@$SOURCE_DATE_EPOCH" "$root/usr/lib/clock-epoch"
}

copy_programs
trim_start
copy_modules
copy_firmware
set_up
rm -f "$out/root.squashfs"
# One time for all: those of a tree's own files differ from clone to clone.
env -u SOURCE_DATE_EPOCH mksquashfs "$root" "$out/root.squashfs" -all-root -no-xattrs -noappend -comp zstd \
    -Xcompression-level "${LEVEL-15}" -mkfs-time "$SOURCE_DATE_EPOCH" -all-time "$SOURCE_DATE_EPOCH" -quiet -no-progress
