#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints as CSV how many AArch64 instructions and static Cortex-A72 cycles each piece of work takes per pixel.
#
# usage: bench_arm.sh PLUGIN PROGRAM SCRATCH KERNELS [BASELINE | new]     count_plugin.so, bench_arm, a folder, a table
# With a BASELINE, an earlier run's CSV, it fails when a count of instructions is more than 2 % above it; `new` makes
# this run's the one in the tree. bench_arm.c and count_case.sh say what is counted, a72_cycles.sh what a cycle is.
set -eu
plugin=$1
program=$2
scratch=$3
kernels=$4
baseline=${5-}
in_tree=tests/bench/baseline.csv
cases='grid nearest linear cubic spline area mean+cubic mean+spline ls gauss kaiser frame:area frame:mean+cubic'
formats='gray xrgb'
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

case $baseline in
'') exit 0 ;;
new)
    cp "$result" "$in_tree"
    echo "bench-arm: these counts are the new baseline, $in_tree" >&2
    exit 0
    ;;
esac
awk -F, '
    function fail(text) {
        print "bench-arm: " $1 " " $2 " " $3 ": " text >"/dev/stderr"
        failed = 1
    }
    FNR == 1 { next }
    { key = $1 "," $2 "," $3 }
    FNR == NR { old[key] = $4; next }
    !(key in old) { fail("not in the baseline"); next }
    $4 > 1.02 * old[key] {
        fail(sprintf("%.3f instructions per pixel, %.1f %% above the baseline, %.3f", $4, 100 * ($4 / old[key] - 1),
            old[key]))
    }
    END {
        if (failed)
            print "bench-arm: if that is meant, take the new counts: make bench-arm BASELINE=new" >"/dev/stderr"
        exit failed
    }' "$baseline" "$result"
