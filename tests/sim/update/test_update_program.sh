#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-sim update: what it prints and writes, and what it refuses.
# Usage, from the tree's root: tests/sim/update/test_update_program.sh BUILD_FOLDER
set -u
build=${1:?usage: test_update_program.sh BUILD_FOLDER}
. tests/sim/run/programs.sh
set -- "$build/wallwarp-sim" update "$scratch/classic.yaml" --out "$scratch/played" --install 2 --reboot 2

# plays TEXT COMMAND ...: it ends well, and a line of stdout begins with TEXT.
plays() {
    text=$1
    shift
    timeout 120 "$@" >"$scratch/stdout" 2>"$scratch/stderr"
    found=$?
    grep -qF -- "$text" "$scratch/stdout" && [ $found -eq 0 ]
    good=$?
    [ $good -eq 0 ] || cat "$scratch/stdout" "$scratch/stderr"
    check "plays: $* ($text)" $good
}

plays "all 2 boards run 0.6, and have marked it good" "$@"
cp "$scratch/played/update.csv" "$scratch/first.csv"
[ "$(head -n 1 "$scratch/first.csv")" = time_s,board,node,state ] &&
    [ "$(grep -c ',left,2,new$' "$scratch/first.csv")" -eq 1 ]
check "the table has the boards' states" $?
[ "$(grep ',down$' "$scratch/first.csv" | cut -d, -f1 | sort -u | wc -l)" -eq 1 ]
check "both boards switch at one moment" $?
grep -q '<svg' "$scratch/played/update.svg" && grep -q 'front' "$scratch/played/update.svg"
check "the drawing has the boards" $?
plays "all 2 boards run 0.6" "$@"
cmp -s "$scratch/first.csv" "$scratch/played/update.csv"
check "the same again is the same, byte by byte" $?
plays "not all boards have the same version: none will switch" "$@" --fail left=install
plays "cancelled: no board has switched" "$@" --fail left=silent
! grep -q ',down$' "$scratch/played/update.csv"
check "no board is down then" $?
plays "to have all run 0.5 again: --switch --version 0.5" "$@" --fail left=crash
plays "all 2 boards run 0.6" "$@" --fail left=lost --fail front=lost
plays "left: runs 0.5, 0.6 waits; is silent" "$@" --fail left=deaf
plays "all 2 boards run 0.6" "$@" --lose 1 --seed 3 --in 9
refuses 1 '--fail: found "up=crash", expected a board of the room' "$@" --fail up=crash
refuses 1 '--fail: found "left", expected' "$@" --fail left
refuses 1 '--fail: found "left=well", expected' "$@" --fail left=well
refuses 2 "expected ROOM and --out DIR" "$build/wallwarp-sim" update "$scratch/classic.yaml"
refuses 2 '--in: found "60", expected a whole number from 5 to 59' "$@" --in 60
refuses 1 "no.yaml" "$build/wallwarp-sim" update "$scratch/no.yaml" --out "$scratch/played"
finish
