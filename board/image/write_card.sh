#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Writes what counts of an image onto a disk or into a file, and reads all of it again.
#
# usage: board/image/write_card.sh IMAGE BMAP DEV      BMAP is the image's block map, with checksums
#
# As root for a disk, and under flock(1), so that no desktop mounts what is only half written. Exit status: 0 done, 1 failed.
set -eu -o pipefail
[ $# = 3 ] || { echo "usage: board/image/write_card.sh IMAGE BMAP DEV" >&2; exit 2; }
image=$1
bmap=$2
dev=$3

fail() {
    echo "flash: DEV=$dev: $*" >&2
    exit 1
}

# Each part that the block map names, once more from the disk.
read_back() {
    local sum first last parts=0 count block
    block=$(sed -n 's/.*<BlockSize> *\([0-9]*\).*/\1/p' "$bmap")
    count=$(grep -c '<Range' "$bmap")
    while read -r sum first last; do
        parts=$((parts + 1))
        [ ! -t 2 ] || printf '\rflash: reading back, part %d of %d ' "$parts" "$count" >&2
        dd if="$dev" iflag=skip_bytes,count_bytes bs=1M skip=$((block * first)) \
            count=$((block * (last - first + 1))) status=none | sha256sum | grep -q "^$sum " ||
            fail "reads back otherwise than it was written, from byte $((block * first)); expected a good disk"
    done < <(sed -n 's/.*<Range chksum="\([0-9a-f]*\)"> *\([0-9]*\)-\?\([0-9]*\) .*/\1 \2 \3/p' "$bmap" |
        awk '{print $1, $2, $3 == "" ? $2 : $3}')
    [ ! -t 2 ] || echo >&2
    [[ $parts = "$count" && $count -gt 0 ]] || fail "$parts of $count parts were read back, expected all"
}

bmaptool copy --bmap "$bmap" "$image" "$dev" || fail "was not written whole, expected a good disk that nobody else uses"
# So that not memory is read, but the card; a plain file has no such call.
blockdev --flushbufs "$dev" 2>/dev/null || [ -f "$dev" ] || fail "cannot be flushed, expected a disk"
read_back
