#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What a build takes: code, static memory, stack. usage: board/size.sh BUILD, built with -fstack-usage
set -eu
build=$1
echo "code and read-only data, bytes"
for library in warp firmware; do
    size -t "$build/lib$library.a" | awk -v n="$library" 'END {printf "  %-12s %8d\n", n, $1}'
done
echo "static memory of the firmware's one projector, bytes"
nm --size-sort --print-size -t d "$build/wallwarp" | awk '$3 ~ /^[bBdD]$/ && $2 > 100000 {printf "  %-24s %10d\n", $4, $2}'
echo "stack of one call, bytes: the ten largest of warp_fixed and firmware"
find "$build/obj/warp_fixed" "$build/obj/firmware" -name '*.su' -exec cat {} + |
    awk -F '\t' '{split($1, at, ":"); printf "  %7d  %-32s %s\n", $2, at[4], at[1]}' | sort -rn | head -n 10
