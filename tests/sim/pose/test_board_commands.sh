#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-pose command, to the boards of a running room.
# Usage, from the tree's root: tests/sim/pose/test_board_commands.sh BUILD_FOLDER
set -u
build=${1:?usage: test_board_commands.sh BUILD_FOLDER}
. tests/sim/run/programs.sh

# tell NODE COMMAND ...: to the room's boards.
tell() {
    node=$1
    shift
    pose_tool command --bus "$bus" --node "$node" "$@"
}

# shows NAME TEXT: monitor has a line with it.
shows() {
    pose_tool monitor --bus "$bus" --seconds 1.5
    grep -q -- "$2" "$scratch/stdout"
    check "$1" $?
}

test_commands() {
    start_room told
    "$build/wallwarp-pose" send --bus "$bus" still --seconds 600 >/dev/null 2>&1 &
    sender=$!
    started="$started $sender"
    tell all hello && [ "$(grep -c '^board [12]: wallwarp [0-9.]*, [0-9]* events$' "$scratch/stdout")" -eq 2 ] &&
        [ "$(wc -l <"$scratch/stdout")" -eq 2 ]
    check "every board says hello" $?
    tell 2 hello && grep -q '^board 2: wallwarp ' "$scratch/stdout" && [ "$(wc -l <"$scratch/stdout")" -eq 1 ]
    check "one board says hello" $?
    tell 1 freeze on && grep -qx 'board 1: done' "$scratch/stdout"
    check "a picture is frozen" $?
    shows "and the board says so" '^     1  frozen '
    shows "and no other one does" '^     2  running '
    pose_tool check --bus "$bus" --seconds 2
    grep -q '^BAD  board 1: an operator has frozen its picture' "$scratch/stdout"
    check "check says it too" $?
    tell 1 freeze off
    check "a freeze ends" $?
    tell 1 method none+nearest
    check "another method is taken" $?
    shows "and used" '^     1  running .* none+nearest, step 0$'
    refuses_command 1 "board 1 is not ready for this method" --bus "$bus" --node 1 method ls
    tell 1 method room
    check "the room's method is taken again" $?
    tell all pattern grid && [ "$(grep -c '^board [12]: done$' "$scratch/stdout")" -eq 2 ]
    check "all boards are told" $?
    shows "and show the pattern" '^     2  pattern '
    tell all pattern none
    tell 2 latency 40.5 && grep -qE '^board 2: pose to photon will be (4[1-9]|5[0-9])\.[0-9] ms$' "$scratch/stdout"
    check "latency is wanted, and whole refreshes come of it" $?
    refuses_command 1 "board 9 is silent, without a heartbeat; power, cable, bit rate?" --bus "$bus" --node 9 hello
    tell 2 reboot
    check "a board is told to start anew" $?
    test_log
    kill -INT "$sender"
    wait "$sender"
    end_room
}

test_log() {
    tell 1 log && head -n 1 "$scratch/stdout" | grep -q '^board 1:       0\.000 s  start     node 1$'
    check "the log begins with the start" $?
    sed -n 's/^board 1: *[0-9.]* s  //p' "$scratch/stdout" |
        grep -v '^faults\|^bus time\|^update\|^method\|running\|holding\|safe' >"$scratch/log"
    cat >"$scratch/expected" <<END
start     node 1
command   freeze on: done
state     frozen
command   freeze off: done
command   method none+nearest: done
command   method ls: impossible
command   method room: done
command   pattern grid: done
state     pattern
command   pattern none: done
END
    diff "$scratch/expected" "$scratch/log"
    check "and has what was asked and done" $?
    i=0
    while [ $i -lt 27 ]; do
        tell 1 freeze on || break
        tell 1 freeze off || break
        i=$((i + 1))
    done
    check "a board is told much" $((27 - i))
    tell 1 log
    lines=$(wc -l <"$scratch/stdout") # more than 50 when some come meanwhile
    [ "$lines" -ge 50 ] && [ "$lines" -lt 60 ] && grep ' command ' "$scratch/stdout" | tail -n 1 | grep -q 'freeze off: done'
    check "the newest 50 events are read" $?
    tell all log --all && [ "$(grep -c '^board 1: .*freeze on: done' "$scratch/stdout")" -eq 28 ] &&
        grep -q '^board 2: .*latency 40 ms: done' "$scratch/stdout" &&
        grep -q '^board 2: .*reboot: done' "$scratch/stdout"
    check "or all of them, of all boards" $?
}

# refuses_command STATUS TEXT OPTION ...: as refuses, of `wallwarp-pose command`.
refuses_command() {
    status=$1
    text=$2
    shift 2
    refuses "$status" "$text" "$build/wallwarp-pose" command "$@"
}

test_bad_usage() {
    refuses_command 2 "--bus is missing" --node 1 hello
    refuses_command 2 "--node is missing: 1 to 63, or all" --bus can0 hello
    refuses_command 2 '--node: found "64", expected a whole number from 1 to 63' --bus can0 --node 64 hello
    refuses_command 2 '--node: found "0"' --bus can0 --node 0 hello
    refuses_command 2 "what to tell the board is missing" --bus can0 --node 1
    refuses_command 2 'found "stop", expected hello, method, freeze,' --bus can0 --node 1 stop
    refuses_command 2 "hello takes no value, found \"1\"" --bus can0 --node 1 hello 1
    refuses_command 2 "freeze: a value is missing" --bus can0 --node 1 freeze
    refuses_command 2 'freeze: found "yes", expected on or off' --bus can0 --node 1 freeze yes
    refuses_command 2 'pattern: found "red", expected none, grid, white or black' --bus can0 --node 1 pattern red
    refuses_command 2 'latency: found "201", expected milliseconds, 0 to 200' --bus can0 --node 1 latency 201
    refuses_command 2 'latency: found "nan"' --bus can0 --node 1 latency nan
    refuses_command 2 'method: found "best", expected "room" or one of none+nearest, ' --bus can0 --node 1 method best
    refuses_command 2 "found also 'now'" --bus can0 --node 1 freeze on now
    refuses_command 2 "--all is for log only" --bus can0 --node 1 --all hello
    refuses_command 1 "no_such_can" --bus no_such_can --node 1 hello
}

test_commands
test_bad_usage
finish
