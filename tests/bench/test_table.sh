#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The README's table of speeds is made by table.sh, and what it says of AArch64 is the baseline. usage: test_table.sh
set -u
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0
check() { # TEXT FOUND EXPECTED
    if [ "$2" = "$3" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED: %s\nfound:\n%s\nexpected:\n%s\n' "$1" "$2" "$3"
    fi
}

cat >"$scratch/arm.csv" <<'END'
# aarch64-linux-gnu-gcc 12
case,format,pose,instructions_per_px,a72_cycles_per_px
grid,xrgb,strong,16.048,8.146
grid,xrgb,mild,10.480,5.340
area,gray,strong,47.341,20.531
area,gray,mild,73.053,31.847
area,xrgb,strong,52.371,23.503
area,xrgb,mild,72.712,33.836
END
cat >"$scratch/x86.csv" <<'END'
case,format,pose,threads,neon_ns_per_px,neon_iqr,opencv,opencv_ns_per_px,opencv_iqr,ratio,memcpy_ns_per_px
area,xrgb,strong,1,2.51,0.1,linear,6.04,0.2,2.41,0.3
area,xrgb,mild,1,4.01,0.1,linear,8.02,0.2,2.00,0.3
area,xrgb,strong,2,1.25,0.1,linear,3.02,0.2,2.42,0.3
END
check 'rows of one format' "$(tests/bench/table.sh "$scratch/arm.csv" "$scratch/x86.csv" xrgb | tail -n +3)" \
    "| \`grid\` | xrgb | 16.0 / 10.5 | 8.1 / 5.3 | - | - | - |
| \`area\` | xrgb | 52.4 / 72.7 | 23.5 / 33.8 | 2.5 / 4.0 | linear 6.0 / 8.0 | 2.4 / 2.0 |"
check 'formats in the order asked for' \
    "$(tests/bench/table.sh "$scratch/arm.csv" /dev/null xrgb gray | tail -n +3 | cut -d '|' -f 2,3)" \
    " \`grid\` | xrgb 
 \`area\` | xrgb 
 \`area\` | gray "

# What a machine's timing does not change: the heading, and the first four columns.
sed -n '/^| work | format /,/^$/p' README.md >"$scratch/readme"
formats=$(tail -n +3 "$scratch/readme" | awk '$4 != "" && !seen[$4]++ { print $4 }')
# shellcheck disable=SC2086 # one argument for each format
tests/bench/table.sh tests/bench/baseline.csv /dev/null $formats >"$scratch/table"
check 'heading in the README' "$(head -n 2 "$scratch/readme")" "$(head -n 2 "$scratch/table")"
check 'rows in the README, counts of the baseline: put in what tests/bench/table.sh says' \
    "$(tail -n +3 "$scratch/readme" | cut -d '|' -f 2-5)" "$(tail -n +3 "$scratch/table" | cut -d '|' -f 2-5)"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
