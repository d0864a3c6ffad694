#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Puts a board's partitions together to the image of a card.
#
# usage: board/image/image.sh BOARD PARTS IMAGE
set -eu
[ $# = 3 ] || { echo "usage: board/image/image.sh BOARD PARTS IMAGE" >&2; exit 2; }
here=$(dirname "$0")
board=$1
out=$2
image=$3
. "$here/fat.sh"

card=$out/card
rm -rf "$card"
mkdir -p "$card"
"$here/boot_script.sh" "$card/boot.scr"
for file in "$out"/boot/*; do
    case $file in
    */flash.bin | */board.dtb | */\*) ;; # not of this partition
    *) cp -r "$file" "$card/" ;;
    esac
done
# A board's own, or that of hand installs with the room file where `make flash` puts it.
if [ -e "board/$board/wallwarp.yaml" ]; then
    cp "board/$board/"{wallwarp,room}.yaml "$card/"
else
    sed 's|^room:.*|room: /data/room.yaml|' board/service/wallwarp.yaml >"$card/wallwarp.yaml"
fi
fat_image "$out/card.vfat" 64 WALLWARP "$card"
rm -f "$out/data.ext4"
truncate -s 64M "$out/data.ext4"
# Few files: so little is to be written when it grows to the end of a large card.
E2FSPROGS_FAKE_TIME=$SOURCE_DATE_EPOCH mke2fs -q -t ext4 -b 4096 -i 65536 -L data -U 7a11ba5e-0000-4000-8000-000000000007 \
    -E hash_seed=7a11ba5e-0000-4000-8000-000000000008,lazy_itable_init=0,root_owner=0:0 "$out/data.ext4"

# A chip whose ROM looks for its loader at 32 KiB needs room for that before the first partition.
loader=$out/boot/flash.bin
loader_at_kib=32
first_mib=1
[ ! -e "$loader" ] || first_mib=8
rm -f "$image"
truncate -s 900M "$image"
sfdisk -q "$image" <<END
label: gpt
label-id: 7A11BA5E-0000-4000-8000-000000000000
first-lba: $((first_mib * 2048))
name=card, size=64MiB, type=EBD0A0A2-B9E5-4433-87C0-68B6B72699C7, attrs=LegacyBIOSBootable, uuid=7A11BA5E-0000-4000-8000-000000000001
name=state, size=1MiB, type=L, uuid=7A11BA5E-0000-4000-8000-000000000002
name=kernel-a, size=64MiB, type=EBD0A0A2-B9E5-4433-87C0-68B6B72699C7, uuid=7A11BA5E-0000-4000-8000-000000000003
name=root-a, size=256MiB, type=L, uuid=7A11BA5E-0000-4000-8000-000000000004
name=kernel-b, size=64MiB, type=EBD0A0A2-B9E5-4433-87C0-68B6B72699C7, uuid=7A11BA5E-0000-4000-8000-000000000005
name=root-b, size=256MiB, type=L, uuid=7A11BA5E-0000-4000-8000-000000000006
name=data, size=64MiB, type=L, uuid=7A11BA5E-0000-4000-8000-000000000007
END
fits() {
    [ "$(stat -c %s "$1")" -le "$2" ] || { echo "image: $1: has $(stat -c %s "$1") bytes, expected $2 or less" >&2; exit 1; }
}

# Zeros too: bmaptool writes no more than the file has, and a used card has other bytes in the rest.
put() {
    local start size
    read -r start size < <(sfdisk -d "$image" |
        sed -n "s/.*start= *\([0-9]*\), size= *\([0-9]*\),.*name=\"$1\".*/\1 \2/p")
    fits "$2" $((size * 512))
    dd if="$2" of="$image" bs=512 seek="$start" conv=notrunc status=none
}
truncate -s 1M "$out/state"
put card "$out/card.vfat"
put state "$out/state"
put kernel-a "$out/kernel.vfat"
put root-a "$out/root.squashfs"
put kernel-b "$out/kernel.vfat"
put root-b "$out/root.squashfs"
put data "$out/data.ext4"
if [ -e "$loader" ]; then
    fits "$loader" $((first_mib * 1048576 - loader_at_kib * 1024))
    dd if="$loader" of="$image" bs=1K seek=$loader_at_kib conv=notrunc status=none
fi
