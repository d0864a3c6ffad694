#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints as CSV how many cache lines a Cortex-A72 fetches per lit pixel, for a whole frame turned by some angles.
#
# usage: bench_cache.sh PLUGIN PROGRAM SCRATCH     cache_plugin.so, bench_cache, a folder
# bench_cache.c says what an order is and what is counted, cache_plugin.c what the caches are.
set -eu
plugin=$1
program=$2
scratch=$3
methods='none+linear area mean+cubic'
orders='frame 1920x1 64x16 32x16 32x32 16x64'
angles='0 10 30 45 90'

rm -rf "$scratch"
mkdir -p "$scratch"
address_of() {
    aarch64-linux-gnu-nm "$program" | awk -v name="$1" '$3 == name { print $1 }'
}
markers=begin=$(address_of bench_begin),end=$(address_of bench_end)
echo method,order,roll_degrees,l1_misses_per_px,l2_misses_per_px
for method in $methods; do
    for order in $orders; do
        for angle in $angles; do
            # Without an environment the stack begins at one place.
            lit=$(env -i "$(command -v qemu-aarch64)" -0 bench_cache -cpu cortex-a72 \
                -plugin "$plugin,out=$scratch/counts,$markers" "$program" "$method" "$order" "$angle")
            awk -v name="$method,$order,$angle" -v lit="$lit" '
                { printf "%s,%.3f,%.3f\n", name, $2 / lit, $3 / lit }' "$scratch/counts"
            rm "$scratch/counts"
        done
    done
    echo "bench-cache: $method done" >&2
done
