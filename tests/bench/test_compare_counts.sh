#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What compare_counts.sh lets pass and what it does not. usage: test_compare_counts.sh
set -u
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0
compiler='aarch64-linux-gnu-gcc 12'

# Counts CSV lines as they are said on stdin, held to a baseline of two rows.
check() { # TEXT FIRST_LINE STATUS SAYS
    printf '%s\n' "$2" case,format,pose,instructions_per_px,a72_cycles_per_px area,xrgb,strong,100.000,50 \
        area,xrgb,mild,200.000,90 >"$scratch/baseline"
    { echo case,format,pose,instructions_per_px,a72_cycles_per_px && cat; } >"$scratch/counts"
    tests/bench/compare_counts.sh "$scratch/baseline" "$scratch/counts" "$compiler" >"$scratch/said" 2>&1
    status=$?
    if [ "$status" = "$3" ] && [ "$(sed "s#$scratch/##g" "$scratch/said")" = "$4" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $1: exit status $status, expected $3; expected to read: $4"
        sed 's/^/    said: /' "$scratch/said"
    fi
}
advice='bench-arm: if that is meant, take the new counts: make bench-arm BASELINE=new'

check 'two percent more' "# $compiler" 0 '' <<'END'
area,xrgb,strong,102.000,60
area,xrgb,mild,180.000,80
END
check 'a little more than that' "# $compiler" 1 \
    "bench-arm: area xrgb strong: 102.001 instructions per pixel, 2.0 % above the baseline, 100.000
$advice" <<'END'
area,xrgb,strong,102.001,40
area,xrgb,mild,200.000,80
END
check 'a row that the baseline has not' "# $compiler" 1 "bench-arm: area gray mild: not in the baseline
$advice" <<'END'
area,xrgb,strong,100.000,50
area,xrgb,mild,200.000,90
area,gray,mild,5.000,3
END
check 'a row that was not counted' "# $compiler" 1 "bench-arm: area xrgb mild: in the baseline, but not counted
$advice" <<'END'
area,xrgb,strong,100.000,50
END
check 'another compiler' '# aarch64-linux-gnu-gcc 14' 0 \
    'bench-arm: baseline was taken with aarch64-linux-gnu-gcc 14, and this is aarch64-linux-gnu-gcc 12: counts are not compared' <<'END'
area,xrgb,strong,999.000,50
END
check 'a baseline of no known compiler' 'case,format' 1 \
    "bench-arm: baseline: its first line is 'case,format', expected '# ' and the compiler that it was taken with" <<'END'
area,xrgb,strong,100.000,50
END

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
