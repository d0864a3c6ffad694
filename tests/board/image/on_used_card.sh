#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Lays an image onto a card that is full of other bytes, as bmaptool writes it: only what its block map names. All file
# systems must be whole, so their zeros too must be in the map. usage: on_used_card.sh FILE.img.xz
set -eu -o pipefail
export LC_ALL=C
PATH=$PATH:/usr/sbin:/sbin
[ $# = 1 ] || { echo "usage: on_used_card.sh FILE.img.xz" >&2; exit 2; }
bmap=${1%.xz}.bmap
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ok_files=$folder/said
. "$(dirname "$0")/../../support/checks.sh"

expect() {
    sed -i 20q "$folder/said"
    ok "$1" "$2"
}

# bmaptool empties a file before it writes, so what it wrote is laid over the other bytes here.
bmaptool -q copy --bmap "$bmap" "$1" "$folder/image"
head -c "$(stat -c %s "$folder/image")" /dev/zero | tr '\0' '\245' >"$folder/card"
block=$(sed -n 's/.*<BlockSize> *\([0-9]*\).*/\1/p' "$bmap")
grep '<Range' "$bmap" | tr '<>-' '   ' | while read -r _ _ first last _; do
    [ "$last" != /Range ] || last=$first
    dd if="$folder/image" of="$folder/card" bs="$block" skip="$first" seek="$first" count=$((last - first + 1)) \
        conv=notrunc status=none
done

# A partition into the file `part`.
take() {
    local start size
    rm -f "$folder/part"
    read -r start size < <(sfdisk -d "$folder/card" |
        sed -n 's/.* start= *\([0-9]*\), size= *\([0-9]*\),.*name="'"$1"'".*/\1 \2/p')
    dd if="$folder/card" of="$folder/part" bs=1M iflag=skip_bytes,count_bytes skip=$((512 * start)) \
        count=$((512 * size)) status=none
}

for part in card kernel-a kernel-b; do
    code=0
    take "$part" && fsck.vfat -n "$folder/part" >"$folder/said" 2>&1 || code=$?
    expect $code "partition $part is no whole FAT file system"
done
code=0
take data && e2fsck -fn "$folder/part" >"$folder/said" 2>&1 || code=$?
expect $code "partition data is no whole ext4 file system"
for part in root-a root-b; do
    code=0
    take "$part" && unsquashfs -s "$folder/part" >"$folder/said" 2>&1 &&
        unsquashfs -d "$folder/files" "$folder/part" -no-xattrs -quiet -no-progress >>"$folder/said" 2>&1 || code=$?
    rm -rf "$folder/files"
    expect $code "partition $part is no whole squashfs"
done
# Its two copies have a CRC, and RAUC makes what is not there: no bytes of another card may be there.
code=0
take state && [ "$(grep -c "$(printf '\245')" "$folder/part" 2>"$folder/said")" = 0 ] || code=1
expect $code "partition state holds what the card had before"
ok_end
