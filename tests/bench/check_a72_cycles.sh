#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# a72_cycles.sh finds the loops and blocks of small programs, and their cycles. usage: check_a72_cycles.sh BUILD
set -u
plugin=$1/count_plugin.so
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0

check() { # PROGRAM CYCLES
    program=$scratch/$1
    aarch64-linux-gnu-gcc -nostdlib -static -Wl,-e,"$1" tests/bench/priced.S -o "$program" || exit 1
    aarch64-linux-gnu-nm "$program" >"$program.symbols"
    begin=$(awk '$3 == "bench_begin" { print $1 }' "$program.symbols")
    end=$(awk '$3 == "bench_end" { print $1 }' "$program.symbols")
    qemu-aarch64 -plugin "$plugin,out=$program.counts,begin=$begin,end=$end" "$program" || exit 1
    llvm-objdump -d --no-show-raw-insn --mcpu=cortex-a72 "$program" >"$program.disassembly"
    found=$(tests/bench/a72_cycles.sh "$program.disassembly" "$program.counts" "$program.scratch") || exit 1
    # What comes before and after the loop is a thousandth of it.
    if echo "${found#* } $2" | awk '{ exit !($1 >= 0.998 * $2 && $1 <= 1.002 * $2) }'; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $1 takes ${found#* } cycles, expected $2"
        cat "$program.scratch/weights" "$program.scratch/turns_300" "$program.scratch/blocks"
    fi
}

check chain 40000
check loads 50000
check condition 70625
check returns 40000
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
