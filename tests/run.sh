#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Run test programs one after the other and add up their results.
#
# usage: tests/run.sh LOG_FOLDER COMMAND...     each COMMAND is one word list, run from the tree's root
#
# A command's results are cmocka's summary ("[  PASSED  ] N test(s)") or a line "N passed, N failed". One that prints
# neither, or that says nothing failed and yet exits non-zero, counts as one failure.
set -u
logs=$1
shift
mkdir -p "$logs"
passed=0 failed=0
for command in "$@"; do
    name=$(echo "$command" | tr -c 'A-Za-z0-9._\n' '_')
    log=$logs/$name.log
    begin=$(date +%s)
    $command </dev/null >"$log" 2>&1
    status=$?
    counts=$(sed -n -E 's/^\[  PASSED  \] ([0-9]+) test.*/\1 0/p; s/^.*\[  FAILED  \] ([0-9]+) test.*/0 \1/p;
        s/^([0-9]+) passed, ([0-9]+) failed$/\1 \2/p; s/^.*\[  PASSED  \] ([0-9]+) test.*/\1 0/p' "$log" |
        awk '{p += $1; f += $2} END {print p + 0, f + 0}')
    p=${counts% *} f=${counts#* }
    if [ "$f" = 0 ] && { [ "$status" != 0 ] || [ "$p" = 0 ]; }; then
        f=1
        echo "(exit status $status, $p passed)" >>"$log"
    fi
    passed=$((passed + p)) failed=$((failed + f))
    printf '%-64s %4d passed %3d failed %4d s\n' "$command" "$p" "$f" $(($(date +%s) - begin))
    if [ "$f" != 0 ]; then
        echo "--- $log"
        tail -n 40 "$log"
        echo "---"
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
