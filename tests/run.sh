#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Run test programs side by side, one on each core, and add up their results.
#
# usage: tests/run.sh LOG_FOLDER COMMAND... [alone COMMAND...]
#
# Each COMMAND is one word list, run from the tree's root; those after "alone" run one after the other, with nothing
# beside them. A command's results are cmocka's summary ("[  PASSED  ] N test(s)") or a line "N passed, N failed". One that
# prints neither, or that says nothing failed and yet exits non-zero, counts as one failure.
set -u
logs=$1
shift
mkdir -p "$logs"
results=$(mktemp "$logs/results.XXXXXX") || exit 1
# What runs in the background does not hear the terminal's interrupt.
trap 'rm -f "$results"' EXIT
trap 'trap - TERM; kill 0' INT TERM

# counts_in LOG: how many passed and failed.
counts_in() {
    sed -n -E 's/^\[  PASSED  \] ([0-9]+) test.*/\1 0/p; s/^.*\[  FAILED  \] ([0-9]+) test.*/0 \1/p;
        s/^([0-9]+) passed, ([0-9]+) failed$/\1 \2/p; s/^.*\[  PASSED  \] ([0-9]+) test.*/\1 0/p' "$1" |
        awk '{p += $1; f += $2} END {print p + 0, f + 0}'
}

# run COMMAND: prints its line, and on failure the end of its log, at once; its counts go to $results.
run() {
    local name log begin status p f said
    name=$(echo "$1" | tr -c 'A-Za-z0-9._\n' '_')
    log=$logs/$name.log
    begin=$(date +%s)
    $1 </dev/null >"$log" 2>&1
    status=$?
    read -r p f <<<"$(counts_in "$log")"
    if [ "$f" = 0 ] && { [ "$status" != 0 ] || [ "$p" = 0 ]; }; then
        f=1
        echo "(exit status $status, $p passed)" >>"$log"
    fi
    echo "$p $f" >>"$results"
    said=$(printf '%-64s %4d passed %3d failed %4d s' "$1" "$p" "$f" $(($(date +%s) - begin)))
    [ "$f" = 0 ] || said+=$'\n'"--- $log"$'\n'"$(tail -n 40 "$log")"$'\n---'
    printf '%s\n' "$said"
}

lanes=$(nproc)
commands=0
for command in "$@"; do
    if [ "$command" = alone ]; then
        lanes=1
        continue
    fi
    while [ "$(jobs -rp | wc -l)" -ge "$lanes" ]; do wait -n; done
    run "$command" &
    commands=$((commands + 1))
done
wait
awk -v commands=$commands '{ passed += $1; failed += $2 }
    END { failed += commands - NR; print passed + 0 " passed, " failed + 0 " failed"; exit failed > 0 || passed == 0 }' \
    "$results"
