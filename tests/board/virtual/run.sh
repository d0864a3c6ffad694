#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs tests on virtual boards in two lanes side by side, as a board keeps one core busy. Those of a lane that call vm_use
# share a board; what they and the boards say is kept in LOGS.
#
# usage: tests/board/virtual/run.sh LOGS BUILD TEST...     BUILD: the programs of BOARD=qemu-virt. From the tree's root
set -u
logs=$1
build=$2
shift 2
. tests/board/virtual/vm.sh

# These first, the longest before the others. All but the last have boards of their own, beside which a shared one would
# run idle, and that keeps a core busy, too.
first=(measures faults camera wire picture bad_input)

# in_order TEST...: each once, one a line.
in_order() {
    local name
    {
        for name in "${first[@]}"; do
            printf '%s\n' "$@" | grep "/test_$name\.sh\$"
        done
        printf '%s\n' "$@"
    } | awk '!seen[$0]++'
}

# lane NUMBER TEST...: those that the other lane has not begun. Prints what tests/run.sh does but for its last lines, which
# are left in LOGS/sumNUMBER.
lane() {
    local sum=$logs/sum$1 test
    export VM_SHARED=$logs/board$1
    trap 'VM=$VM_SHARED; vm_stop' EXIT
    trap - INT TERM
    shift
    for test in "$@"; do
        mkdir "$logs/begun/${test##*/}" 2>/dev/null || continue
        tests/run.sh "$logs" "$test $build" | tee "$sum.all" | sed -u '$d'
        tail -n 1 "$sum.all" >>"$sum"
    done
}

rm -rf "$logs"/{begun,sum1,sum2}
mkdir -p "$logs/begun"
mapfile -t tests < <(in_order "$@")
# What runs in the background does not hear the terminal's interrupt.
trap 'trap - TERM; kill 0' INT TERM
for number in 1 2; do
    lane $number "${tests[@]}" &
done
wait
awk -v tests=${#tests[@]} '{ passed += $1; failed += $3; if (!/^[0-9]+ passed, [0-9]+ failed$/) failed++ }
    END { failed += tests > NR ? tests - NR : 0
        print passed + 0 " passed, " failed + 0 " failed"; exit failed > 0 || passed == 0 }' "$logs"/sum[12]
