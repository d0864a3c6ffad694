# shellcheck shell=bash
# shellcheck disable=SC2016,SC2154 # the made-up tools expand their own variables; those of the script that sources this
# SPDX-License-Identifier: Apache-2.0
# An image, disks and tools that are made up, and what `make flash` did to them, for test_flash.sh to source. All is in
# $folder; $name is what is tested.
#
#   make_image            card.img, and the same packed, image.img.xz with its block map
#   pack_image NAME       the same of a card.img that was changed
#   make_disk NAME BYTES  a file that is a disk for the tools; tell_lsblk NAME KEY VALUE changes what is told of it
#   make_tool NAME TEXT   a program that comes before the system's; make_tools: all that are needed
#   run NAME=VALUE...     flash; exits STATUS, said TEXT and refused STATUS TEXT test what became of it
#   settings_of, data_of, is_whole, part_to_file    what is on a disk
# --- a small image of the same partitions -----------------------------------------------------------------------------

declare -A start=([card]=2048 [state]=76000 [kernel-a]=78048 [root-a]=80096 [kernel-b]=82144 [root-b]=84192 [data]=86240)
declare -A size=([card]=73952 [state]=2048 [kernel-a]=2048 [root-a]=2048 [kernel-b]=2048 [root-b]=2048 [data]=16384)

# Zeros too: they count in a file system, and a used card has other bytes there.
part_from_file() { dd if="$2" of="$folder/card.img" bs=512 seek="${start[$1]}" conv=notrunc status=none; }
part_to_file() { dd if="$1" of="$folder/part" bs=512 skip="${start[$2]}" count="${size[$2]}" status=none; }

make_image() {
    mkdir -p "$folder/root/etc/rauc" "$folder/root/usr/lib/wallwarp"
    echo 1.2-test >"$folder/root/usr/lib/wallwarp/version"
    printf '[system]\ncompatible=wallwarp-qemu-virt\n' >"$folder/root/etc/rauc/system.conf"
    printf 'root:x:0:0::/:\nwallwarp:x:990:990::/:\n' >"$folder/root/etc/passwd"
    mksquashfs "$folder/root" "$folder/root.squashfs" -quiet -no-progress >"$folder/said"
    printf '# This board.\nnode: 1\n\nroom: /data/room.yaml\n\n# The key of the room.\n# key: room.key\n# can: can1\n# end\n' \
        >"$folder/wallwarp.yaml"
    touch -d @1000000000 "$folder/wallwarp.yaml"
    truncate -s $((512 * size[card])) "$folder/card.fat"
    mkfs.vfat -F 32 -s 1 -n CARD "$folder/card.fat" >"$folder/said"
    mcopy -m -i "$folder/card.fat" "$folder/wallwarp.yaml" ::
    truncate -s $((512 * size[data])) "$folder/data.ext4"
    mke2fs -q -t ext4 "$folder/data.ext4"

    truncate -s 51M "$folder/card.img"
    {
        echo 'label: gpt'
        for part in card state kernel-a root-a kernel-b root-b data; do
            echo "start=${start[$part]}, size=${size[$part]}, name=$part"
        done
    } | sfdisk -q "$folder/card.img"
    part_from_file card "$folder/card.fat"
    part_from_file root-a "$folder/root.squashfs"
    part_from_file data "$folder/data.ext4"
    pack_image image
}

# The image, as `make image` leaves it, under another name.
pack_image() {
    bmaptool create -o "$folder/$1.img.bmap" "$folder/card.img" 2>"$folder/said"
    xz -0 -c "$folder/card.img" >"$folder/$1.img.xz"
}

# --- disks ------------------------------------------------------------------------------------------------------------

make_tool() {
    printf '#!/bin/bash\n%s\n' "$2" >"$folder/bin/$1"
    chmod +x "$folder/bin/$1"
}

# A disk of so many bytes is a file full of what was on it, beside a file with what lsblk knows of it.
make_disk() {
    head -c "$2" /dev/zero | tr '\0' '\245' >"$folder/$1"
    printf '%s\n' TYPE=disk RO=0 "SIZE=$2" "MODEL=Card of a test" >"$folder/$1.lsblk"
    echo "$folder/$1 disk" >"$folder/$1.tree"
}

tell_lsblk() { sed -i "s|^$2=.*|$2=$3|" "$folder/$1.lsblk"; }

make_tools() {
    mkdir "$folder/bin"
    make_tool lsblk '
        case $1 in
        -dbno) [ -f "$3.lsblk" ] && sed -n "s/^$2=/ /p" "$3.lsblk" ;;
        -nrpo) cat "$3.tree" ;;
        -nsrpo) [ "$3" = /dev/root1 ] && cat '"$folder"'/system ;;
        -dnrpo) for f in '"$folder"'/*.lsblk; do echo "${f%.lsblk}"; done ;;
        *) echo "lsblk $*: not expected" >&2; exit 1 ;;
        esac'
    make_tool findmnt 'case $* in "-nvo SOURCE --target /") echo /dev/root1 ;; *) echo overlay ;; esac'
    make_tool blockdev 'echo "blockdev $*, $(flock -n "$2" echo not) locked" >>'"$folder"'/flushed; . '"$folder"'/on_flush'
    # bmaptool empties a file before it writes: a disk keeps what is not written.
    make_tool bmaptool '
        disk=${*: -1}
        [ -f "$disk.lsblk" ] || exec /usr/bin/bmaptool "$@"
        [ ! -e '"$folder"'/refuse ] || { echo "bmaptool: ERROR: no" >&2; exit 1; }
        /usr/bin/bmaptool "${@:1:4}" "$disk.new" || exit
        grep "<Range" "$3" | tr "<>-" "   " | while read -r _ _ first last _; do
            [ "$last" != /Range ] || last=$first
            dd if="$disk.new" of="$disk" bs=4096 skip="$first" seek="$first" count=$((last - first + 1)) \
                conv=notrunc status=none
        done
        rm "$disk.new"'
    : >"$folder/on_flush"
    printf '/dev/root1\n%s\n' "$folder/system_disk" >"$folder/system"
}

run() {
    PATH="$folder/bin:$PATH" "$flash" BOARD=qemu-virt IMAGE="$folder/image.img.xz" "$@" >"$folder/out" 2>"$folder/said" \
        </dev/null
    code=$?
}

said() {
    grep -qF -e "$1" "$folder/said"
    ok $? "$name: says '$1'"
}

exits() {
    [ "$code" = "$1" ]
    ok $? "$name: exit status $1, found $code"
}

# The last run ended with one line that says this, and left the disk or file as it was, and nothing else behind.
refused() {
    exits "$1"
    said "$2"
    [ "$(grep -vc 'flash: unpacking' "$folder/said")" = 1 ]
    ok $? "$name: refuses in one line"
    [ ! -e "$folder/sdx" ] || cmp -s "$folder/sdx" "$folder/sdx.before"
    ok $? "$name: leaves the disk as it was"
    [ ! -e "$folder/made.img" ]
    ok $? "$name: makes no file"
    [ -z "$(find build -mindepth 2 2>/dev/null)" ]
    ok $? "$name: leaves nothing behind"
}

# --- what is on them --------------------------------------------------------------------------------------------------

settings_of() { mcopy -n -i "$1@@$((512 * start[card]))" ::wallwarp.yaml -; }
data_of() { debugfs -R "$2" "$1?offset=$((512 * start[data]))" 2>/dev/null; }

is_whole() {
    part_to_file "$1" card && fsck.vfat -n "$folder/part" >"$folder/said" 2>&1
    ok $? "$name: the FAT file system is whole"
    part_to_file "$1" data && e2fsck -fn "$folder/part" >"$folder/said" 2>&1
    found=$?
    sed -i 20q "$folder/said"
    ok $found "$name: the data partition is whole"
    part_to_file "$1" root-a && cmp -s -n "$(stat -c %s "$folder/root.squashfs")" "$folder/part" "$folder/root.squashfs"
    ok $? "$name: the root slot is the image's"
}
