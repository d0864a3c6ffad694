#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints instructions and static Cortex-A72 cycles of a run: two numbers on one line.
#
# usage: a72_cycles.sh DISASSEMBLY COUNTS SCRATCH     by llvm-objdump; by count_plugin.c; a folder of this call's own
#
# What the cycles are: llvm-mca's, with LLVM's scheduling model for -mcpu=cortex-a72 (that of the Cortex-A57).
#   An innermost loop costs its cycles per turn when it runs for ever: ports, dispatch and the chains of values that one
#   turn hands to the next.
#   Other code is taken to overlap with what is around it: a straight block costs what its busiest port, or dispatch at
#   3 micro-operations a cycle, needs.
#   The rest, rarely run, costs as much per instruction as all that.
# What they are not: there are no cache or TLB misses in them, no mispredicted branches, no fetch, no start and end of
# loops, no chain through an outer loop, no wait of a load for the store that it reads, no other core on the memory.
set -eu
disassembly=$1
counts=$2
scratch=$3
mkdir -p "$scratch"
: >"$scratch/loops.s"
: >"$scratch/blocks.s"
awk -v loops="$scratch/loops.s" -v blocks="$scratch/blocks.s" -f tests/bench/hot_code.awk "$disassembly" "$counts" \
    >"$scratch/weights"

# Lines "REGION CYCLES", CYCLES being the number named; in llvm-mca's JSON each has a line of its own.
ask() { # FILE ITERATIONS NUMBER
    [ -s "$1" ] || return 0
    llvm-mca -mtriple=aarch64 -mcpu=cortex-a72 -instruction-info=0 -resource-pressure=0 -json -iterations="$2" "$1" \
        2>"$scratch/llvm-mca.log" >"$scratch/llvm-mca.json" || { cat "$scratch/llvm-mca.log" >&2; exit 1; }
    awk -v wanted="\"$3\":" '
        $1 == "\"Name\":" { gsub(/[",]/, "", $2); region = $2 }
        $1 == wanted { print region, $2 + 0 }' "$scratch/llvm-mca.json"
}
ask "$scratch/blocks.s" 1 BlockRThroughput >"$scratch/blocks"
ask "$scratch/loops.s" 100 TotalCycles >"$scratch/turns_100"
ask "$scratch/loops.s" 300 TotalCycles >"$scratch/turns_300"

awk '
    FILENAME ~ /turns_100$/ { cycles["loop " $1] -= $2 / 200 }
    FILENAME ~ /turns_300$/ { cycles["loop " $1] += $2 / 200 }
    FILENAME ~ /blocks$/ { cycles["block " $1] = $2 }
    FILENAME ~ /weights$/ && $1 != "all" {
        if (!(($1 " " $2) in cycles)) {
            print "a72_cycles: llvm-mca says nothing about " $1 " " $2 >"/dev/stderr"
            exit 1
        }
        sum += $3 * cycles[$1 " " $2]
    }
    $1 == "all" { printf "%.0f %.0f\n", $2, sum * $2 / $3 }
' "$scratch/turns_100" "$scratch/turns_300" "$scratch/blocks" "$scratch/weights"
