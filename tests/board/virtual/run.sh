#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs tests on virtual boards in two lanes side by side, as a board keeps one core busy at most times. Those of a lane
# that call vm_use share a board; what they and the boards say is kept in LOGS.
#
# usage: tests/board/virtual/run.sh LOGS BUILD TEST...     BUILD: the programs of BOARD=qemu-virt. From the tree's root
set -u
logs=$1
build=$2
shift 2
. tests/board/virtual/vm.sh

# lane NUMBER TEST...: prints what tests/run.sh does but for its last line, which is left in LOGS/sumNUMBER.
lane() {
    local sum=$logs/sum$1
    export VM_SHARED=$logs/board$1
    trap 'VM=$VM_SHARED; vm_stop' EXIT
    trap - INT TERM
    shift
    tests/run.sh "$logs" "${@/%/ $build}" | tee "$sum.all" | sed -u '$d'
    tail -n 1 "$sum.all" >"$sum"
}

lanes=('' '')
for test in "$@"; do
    lanes=("${lanes[1]}" "${lanes[0]} $test")
done
mkdir -p "$logs"
# What runs in the background does not hear the terminal's interrupt.
trap 'trap - TERM; kill 0' INT TERM
for number in 1 2; do
    # shellcheck disable=SC2086 # one word for each test
    lane $number ${lanes[number - 1]} &
done
wait
awk '{ passed += $1; failed += $3; if (!/^[0-9]+ passed, [0-9]+ failed$/) failed++ }
    END { print passed + 0 " passed, " failed + 0 " failed"; exit failed > 0 || passed == 0 }' "$logs"/sum[12]
