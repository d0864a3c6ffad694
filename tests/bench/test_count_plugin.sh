#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# count_plugin.c counts code of known length, to the instruction. usage: test_count_plugin.sh BUILD
set -u
plugin=$1/count_plugin.so
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

aarch64-linux-gnu-gcc -nostdlib -static tests/bench/counted.S -o "$scratch/counted" || exit 1
at() {
    aarch64-linux-gnu-nm "$scratch/counted" | awk -v name="$1" '$3 == name { print $1 }'
}
run() { # ARGUMENTS
    rm -f "$scratch/counts"
    qemu-aarch64 -plugin "$plugin,out=$scratch/counts,$1" "$scratch/counted" >"$scratch/said" 2>&1
    status=$?
}
total() {
    awk '{ sum += $2 * $3 } END { print sum + 0 }' "$scratch/counts"
}
markers=begin=$(at bench_begin),end=$(at bench_end)

# loop, call, two functions, nops, call, what `last` does before the end; the second stretch
run "$markers"
check 'everything' "$(total)" $((2001 + 1 + 5 + 3 * 5 + 3000 + 1 + 2 + 2))
check 'turns of a loop' "$(awk -v loop="$(at turn)" '$1 == substr(loop, length(loop) - length($1) + 1) { print $3 }' \
    "$scratch/counts")" 999
run "$markers,without=$(at left_out)"
check 'without a function and its callees' "$(total)" $((2001 + 1 + 3000 + 1 + 2 + 2))
run "$markers,without=$(at inner)"
check 'a function left out that is jumped to' "$(cat "$scratch/said")" \
    'count_plugin: a function that is left out had not returned at the end marker'
run "$markers,without=$(at last)"
check 'a function left out that holds the end' "$(cat "$scratch/said")" \
    'count_plugin: a function that is left out had not returned at the end marker'
check 'writes no counts' "$([ -e "$scratch/counts" ] && echo some)" ''
run "begin=$(at bench_begin),end=$(at unused)"
check 'no end' "$(cat "$scratch/said")" 'count_plugin: the end marker was not reached'
run "begin=$(at bench_end),end=$(at bench_begin)"
check 'no end to the last beginning' "$(cat "$scratch/said")" \
    'count_plugin: the begin marker is not followed by the end marker'
run "$markers,without=nowhere"
check 'a bad address' "$status" 1
run "begin=$(at bench_begin)"
check 'an end that is not given' "$status" 1

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
