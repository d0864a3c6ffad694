#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# cache_plugin.c counts the misses of walks that are known. usage: test_cache_plugin.sh BUILD
set -u
plugin=$1/cache_plugin.so
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0
check() { # TEXT FOUND EXPECTED
    if [ "$2" = "$3" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $1: '$2', expected '$3'"
        cat "$scratch/said"
    fi
}

aarch64-linux-gnu-gcc -nostdlib -static tests/bench/cached.S -o "$scratch/cached" || exit 1
at() {
    aarch64-linux-gnu-nm "$scratch/cached" | awk -v name="$1" '$3 == name { print $1 }'
}
run() { # ARGUMENTS
    rm -f "$scratch/counts"
    qemu-aarch64 -plugin "$plugin,out=$scratch/counts,$1" "$scratch/cached" >"$scratch/said" 2>&1
    status=$?
}

run "begin=$(at bench_begin),end=$(at bench_end)"
read -r accesses l1 l2 <"$scratch/counts"
check 'accesses' "$accesses" $((2 * 1024 + 2))
check 'lines fetched by the first cache' "$l1" $((1024 + 1024 + 1))
check 'lines fetched by the second' "$l2" $((1024 + 1))
run "begin=$(at bench_end),end=$(at bench_begin)"
check 'an end before the beginning' "$(cat "$scratch/said")" 'cache_plugin: the markers were not reached in turn'
check 'writes no counts' "$([ -e "$scratch/counts" ] && echo some)" ''
run "begin=$(at bench_begin)"
check 'an end that is not given' "$status" 1
run "begin=$(at bench_begin),end=nowhere"
check 'a bad address' "$status" 1

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
