#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Each board's page shows what `make BOARD=NAME info` prints, so that neither can be changed alone. From the tree's root.
# To mend a page: put what is printed between its two marks.
set -u
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
boards=0
failed=0

fail() {
    echo "FAILED: $*"
    failed=$((failed + 1))
}

for table in board/*/info.c; do
    board=$(basename "$(dirname "$table")")
    boards=$((boards + 1))
    make -s BOARD="$board" info >"$folder/printed" || fail "make BOARD=$board info"
    [ "$board" = host ] && continue # its page is the tree's README.md
    awk -v mark="<!-- make BOARD=$board info -->" '
        $0 == "<!-- end -->" {on = 0} on; $0 == mark {on = 1}' "board/$board/README.md" >"$folder/shown"
    cmp -s "$folder/printed" "$folder/shown" || {
        fail "board/$board/README.md does not show what make BOARD=$board info prints:"
        diff "$folder/shown" "$folder/printed" | sed 's/^/    /'
    }
done
[ $boards -ge 5 ] || fail "found $boards boards, expected 5 or more"

# A wire of a line that the board has not, and a line without a wire, are refused.
sed 's/HAL_GPIO_LAMP, NULL/HAL_GPIO_LED, NULL/' board/qemu-virt/info.c >"$folder/info.c"
gcc -I. -std=c11 -o "$folder/wrong" board/qemu-virt/board.c "$folder/info.c" board/print_info.c board/board_info.c &&
    "$folder/wrong" >"$folder/printed" 2>&1 && fail "two wires of one line were printed"
grep -q 'line LED has 2 wires, expected 1' "$folder/printed" || fail "two wires of one line: $(cat "$folder/printed")"

echo "$boards passed, $failed failed"
[ "$failed" = 0 ]
