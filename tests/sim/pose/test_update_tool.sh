#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-pose update, of a running room: install, switch, and back.
# Usage, from the tree's root: tests/sim/pose/test_update_tool.sh BUILD_FOLDER
set -u
build=${1:?usage: test_update_tool.sh BUILD_FOLDER}
. tests/sim/run/programs.sh
bundle=/media/wallwarp-host-0.6.raucb

# update STATUS OPTION ...: of the room; the program must end with this status.
update() {
    expected=$1
    shift
    timeout 120 "$build/wallwarp-pose" update --bus "$bus" "$scratch/classic.yaml" "$@" >"$scratch/stdout" \
        2>"$scratch/stderr" </dev/null
    found=$?
    [ $found -eq "$expected" ] || cat "$scratch/stdout" "$scratch/stderr"
    check "update $* ends with status $expected" $((found != expected))
}

# says TEXT: on stdout, a whole line.
says() {
    grep -qxF -- "$1" "$scratch/stdout"
    check "it says: $1" $?
}

test_update() {
    start_room updated
    update 0 --status
    says "   1  A     front: runs 0.5, idle"
    says "   2  A     left: runs 0.5, idle"
    update 1 --switch
    says "   1  A     front: runs 0.5, idle; has not the version that the room is to have"
    says "nothing was begun"
    update 1 --install /no.bundle
    says "   2  A     left: runs 0.5, failed: /no.bundle: not a bundle"
    says "not all boards have the same version: none will switch"
    update 0 --install $bundle
    says "all 2 boards have 0.6: --switch starts them in it"
    grep -q ' s  left: runs 0.5, installing [1-9]0 %$' "$scratch/stderr"
    check "its progress is told" $?
    "$build/wallwarp-pose" monitor --bus "$bus" --seconds 4 >"$scratch/stdout"
    grep -q '^     2  ready  *100%  A  ' "$scratch/stdout"
    check "monitor shows that the bundle waits" $?
    # On a busy machine boards know bus time late; a switch that is refused has changed nothing.
    tries=0
    while [ $tries -lt 20 ] && ! "$build/wallwarp-pose" update --bus "$bus" "$scratch/classic.yaml" --switch --in 5 \
        >"$scratch/stdout" 2>"$scratch/stderr" && grep -q 'know bus time' "$scratch/stdout"; do
        tries=$((tries + 1))
    done
    says "   2  B     left: runs 0.6, idle"
    says "all 2 boards run 0.6, and have marked it good"
    pose_tool command --bus "$bus" --node 2 log && grep -q 'update    idle$' "$scratch/stdout"
    check "the log has it" $?
    update 0 --switch --version 0.5
    says "   1  A     front: runs 0.5, idle"
    end_room
}

test_board_that_is_not_there() {
    start_room alone
    sed 's/node: 2/node: 9/' "$scratch/classic.yaml" >"$scratch/other.yaml"
    timeout 60 "$build/wallwarp-pose" update --bus "$bus" "$scratch/other.yaml" --install $bundle >"$scratch/stdout" 2>&1
    check "a board that is not there is in the way of an install" $(($? != 1))
    says "   9  ?     left: is silent; power, cable, bit rate?"
    says "nothing was begun"
    update 0 --status
    says "   1  A     front: runs 0.5, idle"
    end_room
}

test_room_with_a_key() {
    (umask 077 && echo 000102030405060708090a0b0c0d0e0f >"$scratch/key")
    start_room keyed --key "$scratch/key"
    update 1 --status
    says "   1  ?     front: has another key than this program (--key FILE), or none"
    update 0 --status --key "$scratch/key"
    says "   1  A     front: runs 0.5, idle"
    end_room
}

test_bad_usage() {
    set -- "$build/wallwarp-pose" update
    refuses 2 "--bus is missing" "$@" "$scratch/classic.yaml" --status
    refuses 2 "ROOM is missing" "$@" --bus can0 --status
    refuses 2 "expected --status, --cancel, or --install" "$@" --bus can0 "$scratch/classic.yaml"
    refuses 2 "expected --status, --cancel, or --install" "$@" --bus can0 "$scratch/classic.yaml" --status --switch
    refuses 2 "--version and --in are for --switch" "$@" --bus can0 "$scratch/classic.yaml" --status --in 6
    refuses 2 '--in: found "4"' "$@" --bus can0 "$scratch/classic.yaml" --switch --in 4
    refuses 2 '--install: found "b.raucb", expected usb, an absolute path' "$@" --bus can0 "$scratch/classic.yaml" \
        --install b.raucb
    refuses 2 '--version: found "a b"' "$@" --bus can0 "$scratch/classic.yaml" --switch --version "a b"
    refuses 1 "$scratch/no.yaml" "$@" --bus can0 "$scratch/no.yaml" --status
}

test_bad_usage
test_update
test_board_that_is_not_there
test_room_with_a_key
finish
