#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-pose's record, replay, monitor, check and fault on the bus of a running room.
# Usage, from the tree's root: tests/sim/pose/test_bus_tools.sh BUILD_FOLDER
set -u
build=${1:?usage: test_bus_tools.sh BUILD_FOLDER}
. tests/sim/run/programs.sh

# poses_in LOG: identifier and data of every pose frame, in order.
poses_in() {
    sed -n 's/^.* can0 \(11[012]#.*\)$/\1/p' "$1"
}

test_what_is_recorded_can_be_replayed() {
    start_room first
    "$build/wallwarp-pose" record --bus "$bus" "$scratch/walk.log" >/dev/null 2>"$scratch/recorder" &
    recorder=$!
    started="$started $recorder"
    for _ in $(seq 100); do
        [ -s "$scratch/walk.log" ] && break
        sleep 0.1
    done
    pose_tool send --bus "$bus" "$scratch/ten.csv"
    check "ten poses are sent" $?
    sleep 1
    kill -INT "$recorder"
    wait "$recorder"
    check "the recorder ends well" $?
    [ "$(poses_in "$scratch/walk.log" | wc -l)" -eq 30 ] && grep -q ' can0 701#' "$scratch/walk.log"
    check "it has the poses and the boards' reports" $?
    end_room
    poses_in "$scratch/first/bus.log" >"$scratch/sent"
    poses_in "$scratch/walk.log" | cmp -s - "$scratch/sent"
    check "byte for byte and in order" $?

    start_room second
    pose_tool replay --bus "$bus" "$scratch/walk.log"
    check "the log is replayed" $?
    grep -qx '30 frames sent' "$scratch/stdout"
    check "without the boards' reports" $?
    end_room
    poses_in "$scratch/second/bus.log" | cmp -s - "$scratch/sent"
    check "its poses are on the second bus as they were on the first" $?
}

test_health() {
    start_room healthy
    "$build/wallwarp-pose" send --bus "$bus" "$scratch/long.csv" >/dev/null 2>&1 &
    sender=$!
    started="$started $sender"
    sleep 0.5
    pose_tool monitor --bus "$bus" --seconds 2 &&
        grep -q '^     0  set  ' "$scratch/stdout" && grep -q '^     2  running ' "$scratch/stdout"
    check "monitor shows the viewer and the boards" $?
    pose_tool check --bus "$bus" --seconds 2 --room "$scratch/classic.yaml"
    grep -q ' viewer 0: ' "$scratch/stdout" && grep -q '^ok   load: ' "$scratch/stdout"
    check "check judges the poses and the load" $?
    sed 's/node: 2/node: 5/; s/^    border:/    viewer: 1\n&/' "$scratch/classic.yaml" >"$scratch/other.yaml"
    pose_tool check --bus "$bus" --seconds 2 --room "$scratch/other.yaml"
    grep -q '^BAD  board 5: "left" of the room is silent' "$scratch/stdout" &&
        grep -q '^BAD  board 2: is not of the room' "$scratch/stdout" &&
        grep -q '^BAD  viewer 1: no poses, but boards follow it' "$scratch/stdout"
    check "check compares the bus with the room" $?
    kill -INT "$sender"
    wait "$sender"
    sleep 0.3
    pose_tool check --bus "$bus" --seconds 2
    [ $? -eq 1 ] && grep -q '^BAD  no poses' "$scratch/stdout"
    check "check misses them, and says so by its status" $?
    pose_tool fault --bus "$bus" --corrupt 100 --speed 10 "$scratch/walk.log" &&
        grep -q '^30 frames sent of 30: 0 dropped, 0 duplicated, 30 corrupted, 0 delayed$' "$scratch/stdout"
    check "faults are counted" $?
    pose_tool fault --bus "$bus" --flood 0.5 &&
        [ "$(sed -n 's/ frames sent$//p' "$scratch/stdout")" -gt 100 ]
    check "the bus is flooded" $?
    refuses 1 "only a virtual interface can play bus-off: \`modprobe vcan" "$build/wallwarp-pose" fault --bus "$bus" --bus-off
    end_room
    grep -q ' can0 000#0000000000000000$' "$scratch/healthy/bus.log"
    check "the flood was on it" $?
}

test_bad_usage() {
    refuses 1 "missing.yaml" "$build/wallwarp-pose" check --bus can0 --room "$scratch/missing.yaml"
    refuses 2 "--room" "$build/wallwarp-pose" monitor --bus can0 --room "$scratch/classic.yaml"
    for command in record monitor check; do
        refuses 2 "--bus is missing" "$build/wallwarp-pose" $command
        refuses 2 "expected a number from" "$build/wallwarp-pose" $command --bus can0 --seconds x
        refuses 1 "no_such_can" "$build/wallwarp-pose" $command --bus no_such_can --seconds 1
    done
    refuses 2 "no such command: 'listen'" "$build/wallwarp-pose" listen
    refuses 2 "the log is missing" "$build/wallwarp-pose" replay --bus can0
    refuses 2 "--speed: found \"0\"" "$build/wallwarp-pose" replay --bus can0 --speed 0 "$scratch/walk.log"
    refuses 1 "missing.log" "$build/wallwarp-pose" replay --bus 127.0.0.1:1 "$scratch/missing.log"
    refuses 2 "expected one of LOG, --from, --flood and --bus-off, found 0" "$build/wallwarp-pose" fault --bus can0
    refuses 2 "found 2" "$build/wallwarp-pose" fault --bus can0 --flood 1 "$scratch/walk.log"
    refuses 2 "would hear itself" "$build/wallwarp-pose" fault --bus can0 --from can0
    refuses 2 "--drop: found \"101\", expected a number from 0 to 100" "$build/wallwarp-pose" fault --bus can0 --drop 101
    echo mine >"$scratch/mine.log"
    refuses 1 "mine.log: File exists; no log is overwritten" "$build/wallwarp-pose" record --bus 127.0.0.1:1 "$scratch/mine.log"
    [ "$(cat "$scratch/mine.log")" = mine ]
    check "a log that exists is kept" $?
    refuses 1 "no_such_can" "$build/wallwarp-pose" record --bus no_such_can "$scratch/none.log"
    [ ! -e "$scratch/none.log" ]
    check "a bus that is none leaves no log" $?
}

test_full_disk() {
    start_room full
    timeout 60 "$build/wallwarp-pose" record --bus "$bus" --seconds 1 >/dev/full 2>"$scratch/stderr"
    [ $? -eq 1 ] && grep -q 'stdout: cannot write on: is the disk full?' "$scratch/stderr"
    check "a full disk is said" $?
    ! grep -q recorded "$scratch/stderr"
    check "what is not on the disk is not said to be recorded" $?
    end_room
}

write_poses 300 >"$scratch/long.csv"
test_what_is_recorded_can_be_replayed
test_health
test_bad_usage
test_full_disk
finish
