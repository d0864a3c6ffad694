#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints the README's table of speeds: what bench-arm counted and bench timed. Two figures are of poses strong and mild.
#
# usage: table.sh ARM_CSV X86_CSV FORMAT...     the CSV of `make bench-arm` and `make bench`; /dev/null for neither
set -eu
arm=$1
x86=$2
shift 2
awk -F, -v formats="$*" '
    function both(figures, row, digits) {
        if (!((row, "strong") in figures))
            return "-"
        return sprintf("%." digits "f / %." digits "f", figures[row, "strong"], figures[row, "mild"])
    }
    /^#/ || $1 == "case" { next }
    FILENAME == ARGV[1] {
        if (!(($1, $2) in seen))
            row[++rows] = $1 SUBSEP $2
        seen[$1, $2] = 1
        instructions[$1, $2, $3] = $4
        cycles[$1, $2, $3] = $5
        next
    }
    $4 == 1 {
        ns[$1, $2, $3] = $5
        opencv[$1, $2, $3] = $8
        ratio[$1, $2, $3] = $10
        name[$1, $2] = $7
    }
    END {
        print "| work | format | AArch64 instructions | A72 cycles | x86 ns, whole frame | OpenCV there, ns | times as fast |"
        print "|---|---|---|---|---|---|---|"
        count = split(formats, format, " ")
        for (f = 1; f <= count; f++) {
            for (r = 1; r <= rows; r++) {
                split(row[r], part, SUBSEP)
                if (part[2] != format[f])
                    continue
                beside = both(opencv, row[r], 1)
                printf "| `%s` | %s | %s | %s | %s | %s | %s |\n", part[1], part[2], both(instructions, row[r], 1),
                    both(cycles, row[r], 1), both(ns, row[r], 1), beside == "-" ? beside : name[row[r]] " " beside,
                    both(ratio, row[r], 1)
            }
        }
    }' "$arm" "$x86"
