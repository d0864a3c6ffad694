#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Counts one case of bench_arm, and writes its CSV line to SCRATCH/CASE-FORMAT-POSE.csv.
#
# usage: count_case.sh PLUGIN PROGRAM SCRATCH KERNELS CASE FORMAT POSE     SCRATCH/disassembly is PROGRAM's
set -eu
plugin=$1
program=$2
scratch=$3
kernels=$4
case=$5
format=$6
pose=$7
name=$case-$format-$pose
began=$(date +%s)

# xargs ends at a status of 255.
fail() {
    cat "$scratch/$name.log" >&2
    echo "bench-arm: could not count $case $format $pose${1+: $1}" >&2
    exit 255
}

# What a case leaves out of its frame: the grid, which is a case of its own, and what makes another picture of the
# picture before a pixel is resampled: prefilter, spline coefficients. Method ls fits, but with axes solved before.
left_out() {
    case $case in
    grid | gauss | kaiser | frame:*) ;;
    *) echo "grid_from_homography grid_row_cursor grid_points_$kernels prefilter_begin" \
        "prefilter_make_pixels prefilter_make_coefficients ls_axis_update" ;;
    esac
}

: >"$scratch/$name.log"
arguments=out=$scratch/$name.counts
for function in begin=bench_begin end=bench_end $(left_out | sed -E 's/[^ ]+/without=&/g'); do
    address=$(aarch64-linux-gnu-nm "$program" | awk -v name="${function#*=}" '$3 == name { print $1 }')
    [ -n "$address" ] || fail "$program has no function ${function#*=}"
    arguments=$arguments,${function%=*}=$address
done
# Without an environment, and always under one name: the stack begins at one place, and so memcpy() takes one path.
pixels=$(env -i "$(command -v qemu-aarch64)" -0 bench_arm -cpu cortex-a72 -plugin "$plugin,$arguments" "$program" \
    "$case" "$format" "$pose" "$kernels" 2>"$scratch/$name.log") || fail
[ -s "$scratch/$name.counts" ] || fail
tests/bench/a72_cycles.sh "$scratch/disassembly" "$scratch/$name.counts" "$scratch/$name" >"$scratch/$name.sums" ||
    fail
awk -v name="$case,$format,$pose" -v pixels="$pixels" '{ printf "%s,%.3f,%.3f\n", name, $1 / pixels, $2 / pixels }' \
    "$scratch/$name.sums" >"$scratch/$name.csv"
echo "bench-arm: $case $format $pose counted in $(($(date +%s) - began)) s" >&2
