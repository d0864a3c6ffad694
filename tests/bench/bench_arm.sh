#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints as CSV how many AArch64 instructions and static Cortex-A72 cycles each piece of work takes per pixel.
#
# usage: bench_arm.sh PLUGIN PROGRAM SCRATCH KERNELS [BASELINE | new]     count_plugin.so, bench_arm, a folder, a table
# With a BASELINE, an earlier run's CSV, it fails when a count of instructions is more than 2 % above it; `new` makes
# this run's the one in the tree. Its first line names the compiler, for another one makes other code: then nothing is
# compared. bench_arm.c and count_case.sh say what is counted, a72_cycles.sh what a cycle is.
set -eu
plugin=$1
program=$2
scratch=$3
kernels=$4
baseline=${5-}
in_tree=tests/bench/baseline.csv
cases='grid nearest linear cubic spline area mean+cubic mean+spline ls gauss kaiser frame:area frame:mean+cubic'
formats='gray xrgb nv12'
poses='strong mild'

rm -rf "$scratch"
mkdir -p "$scratch"
llvm-objdump -d --no-show-raw-insn --mcpu=cortex-a72 "$program" >"$scratch/disassembly"
for case in $cases; do
    for format in $formats; do
        for pose in $poses; do
            echo "$case $format $pose"
        done
    done
done >"$scratch/names"
xargs -L 1 -P "$(nproc)" tests/bench/count_case.sh "$plugin" "$program" "$scratch" "$kernels" <"$scratch/names"

result=$scratch/result.csv
echo case,format,pose,instructions_per_px,a72_cycles_per_px >"$result"
while read -r case format pose; do
    cat "$scratch/$case-$format-$pose.csv"
done <"$scratch/names" >>"$result"
cat "$result"

compiler="aarch64-linux-gnu-gcc $(aarch64-linux-gnu-gcc -dumpversion | cut -d . -f 1)"
case $baseline in
'') exit 0 ;;
new)
    { echo "# $compiler"; cat "$result"; } >"$in_tree"
    echo "bench-arm: these counts are the new baseline, $in_tree" >&2
    exit 0
    ;;
esac
tests/bench/compare_counts.sh "$baseline" "$result" "$compiler"

