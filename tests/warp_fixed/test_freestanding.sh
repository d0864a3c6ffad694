#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compile and link warp_fixed for aarch64 without an operating system, and look into what came out.
#
# usage: test_freestanding.sh BUILD
set -eu
out=$1/freestanding
mkdir -p "$out"
failed=0 passed=0
check() { # TEXT CONDITION-STATUS
    if [ "$2" = 0 ]; then
        passed=$((passed + 1))
        echo "ok      $1"
    else
        failed=$((failed + 1))
        echo "FAILED  $1"
    fi
}
for opt in -O2 -O3; do
    flags="-std=c11 -I. $opt -Wall -Wextra -Werror -ffreestanding -nostdlib"
    objects=
    for source in warp_fixed/*.c; do
        object=$out/$(basename "$source" .c)$opt.o
        aarch64-linux-gnu-gcc $flags -c "$source" -o "$object"
        objects="$objects $object"
    done
    library=$out/warp_fixed$opt.o
    aarch64-linux-gnu-ld -r -o "$library" $objects

    symbols=$(aarch64-linux-gnu-nm --undefined-only "$library" | awk '{print $2}' | tr '\n' ' ')
    other=$(echo "$symbols" | tr ' ' '\n' | grep -v -x -E 'memcpy|memmove|memset|memcmp|' || test $? = 1)
    test -z "$other" && s=0 || s=1
    check "$opt needs no symbol but memcpy, memmove, memset, memcmp (needs: ${symbols:-none})" $s

    data=$(aarch64-linux-gnu-size -A "$library" | awk '$1 ~ /^\.(data|bss)($|\.[^r])/ && $2 > 0 {print $1}')
    test -z "$data" && s=0 || s=1
    check "$opt has no writable globals" $s

    # Moves between register files (fmov) carry bits; everything else that starts with f, or converts, computes.
    aarch64-linux-gnu-objdump -d --no-show-raw-insn "$library" | awk '/^ +[0-9a-f]+:/ {print $2}' >"$library.mnemonics"
    float=$(grep -E '^(f[a-z]+|scvtf|ucvtf)$' "$library.mnemonics" | grep -v -x fmov | sort | uniq -c || test $? = 1)
    test -z "$float" && s=0 || { s=1; echo "$float"; }
    check "$opt has no floating-point arithmetic or conversion among its $(wc -l <"$library.mnemonics") instructions" $s

    aarch64-linux-gnu-gcc $flags -fno-tree-loop-distribute-patterns -static tests/warp_fixed/freestanding_start.c "$library" \
        -o "$out/freestanding$opt" && s=0 || s=1
    check "$opt links with -nostdlib" $s
done
echo "$passed passed, $failed failed"
test "$failed" = 0
