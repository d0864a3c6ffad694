#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fails when a count of instructions is more than 2 % above the baseline's, or either has a row that the other has not;
# says which.
#
# usage: compare_counts.sh BASELINE COUNTS COMPILER     CSV of bench_arm.sh; that COUNTS are made with, "NAME MAJOR"
# BASELINE's first line is "# COMPILER". When that is another one nothing is compared: it says so and does not fail.
set -eu
baseline=$1
counts=$2
compiler=$3

read -r first <"$baseline"
case $first in
"# $compiler") ;;
'# '*)
    echo "bench-arm: $baseline was taken with ${first#\# }, and this is $compiler: counts are not compared" >&2
    exit 0
    ;;
*)
    echo "bench-arm: $baseline: its first line is '$first', expected '# ' and the compiler that it was taken with" >&2
    exit 1
    ;;
esac
awk -F, '
    function fail(text) {
        gsub(",", " ", key)
        print "bench-arm: " key ": " text >"/dev/stderr"
        failed = 1
    }
    /^#/ || $1 == "case" { next }
    { key = $1 "," $2 "," $3 }
    FILENAME == ARGV[1] { old[key] = $4; next }
    { counted[key] = 1 }
    !(key in old) { fail("not in the baseline"); next }
    $4 > 1.02 * old[key] {
        fail(sprintf("%.3f instructions per pixel, %.1f %% above the baseline, %.3f", $4, 100 * ($4 / old[key] - 1),
            old[key]))
    }
    END {
        for (key in old)
            if (!(key in counted))
                fail("in the baseline, but not counted")
        if (failed)
            print "bench-arm: if that is meant, take the new counts: make bench-arm BASELINE=new" >"/dev/stderr"
        exit failed
    }' "$baseline" "$counts"
