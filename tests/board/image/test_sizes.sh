#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A system that is larger than its slot makes no image: it would run into the slot behind it.
# Usage, from the tree's root: tests/board/image/test_sizes.sh
set -u
# shellcheck source=tests/support/checks.sh
. tests/support/checks.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ok_files=$folder/said
mkdir "$folder/boot"
: >"$folder/kernel.vfat"

# made BYTES_OF_ROOT
made() {
    rm -f "$folder/root.squashfs"
    truncate -s "$1" "$folder/root.squashfs"
    SOURCE_DATE_EPOCH=0 board/image/image.sh rpi4 "$folder" "$folder/image" >"$folder/said" 2>&1
}

made 256M
ok $? "a system of the slot's size makes no image"
! made 268435457
ok $? "one that is a byte larger makes one"
grep -q 'root.squashfs: has 268435457 bytes, expected 268435456 or less' "$folder/said"
ok $? "nobody says what does not fit"
ok_end
