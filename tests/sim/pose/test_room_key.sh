#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A room with a key believes and obeys who has the same one, and nobody else.
# Usage, from the tree's root: tests/sim/pose/test_room_key.sh BUILD_FOLDER
set -u
build=${1:?usage: test_room_key.sh BUILD_FOLDER}
. tests/sim/run/programs.sh

# The command of the README beside wallwarp-pose.
new_key() {
    (umask 077; od -An -N16 -tx1 /dev/urandom | tr -d ' ' >"$1")
}
key=$scratch/key
wrong=$scratch/wrong
new_key "$key"
new_key "$wrong"

# boards_in_last_report STATE FLAGS: how many boards say that they are in this state, with these fault flags.
boards_in_last_report() {
    awk -v line="^ +[$boards]  $1 .* $2 " '/^ board  state / { n = 0 } $0 ~ line { n++ } END { print n + 0 }' \
        "$scratch/stdout"
}

# boards_are STATE FLAGS NAME: both boards say that they are in this state, with these fault flags (a pattern), at last:
# on a busy machine poses come late, and sessions too.
boards_are() {
    tries=0
    until pose_tool monitor --bus "$bus" --seconds 1.2 && [ "$(boards_in_last_report "$1" "$2")" -eq ${#boards} ]; do
        [ $((tries += 1)) -lt 30 ] || break
    done
    [ $tries -lt 30 ]
    result=$?
    [ $result -eq 0 ] || cat "$scratch/stdout"
    check "$3" $result
}

# start_sender OPTION ...: poses until stop_sender.
start_sender() {
    "$build/wallwarp-pose" send --bus "$bus" still --seconds 600 "$@" >/dev/null 2>&1 &
    sender=$!
    started="$started $sender"
}

stop_sender() {
    kill -INT "$sender"
    wait "$sender"
}

# A tracker's packets at about 50 Hz, until it is killed. usage: packets PORT
packets() {
    n=0
    while :; do
        printf 'fr %d\r\n6d 1 [0 1.000][300 1600 %d 0 0 0][1 0 0 0 1 0 0 0 1]\r\n' $n $((n % 100)) >"$scratch/packet"
        cat "$scratch/packet" >"/dev/udp/127.0.0.1/$1"
        n=$((n + 1))
        sleep 0.02
    done
}

# start_bridge OPTION ...: a tracker's packets and the bridge that sends their poses, until stop_bridge.
start_bridge() {
    "$build/wallwarp-pose" bridge dtrack --bus "$bus" --transform sim/trackers/examples/dtrack.yaml \
        --listen 127.0.0.1:0 "$@" >/dev/null 2>"$scratch/bridge" &
    sender=$!
    tries=0
    until grep -q ' on 127.0.0.1:' "$scratch/bridge" || [ $((tries += 1)) -gt 200 ]; do sleep 0.05; done
    packets "$(sed -n 's/.* on 127.0.0.1:\([0-9]*\)$/\1/p' "$scratch/bridge")" 2>/dev/null &
    packets=$!
    started="$started $sender $packets"
}

stop_bridge() {
    stop_sender
    kill "$packets"
}

test_bridge() {
    start_room bridged --key "$key"
    start_bridge --key "$wrong"
    boards_are waiting '0x18[01]' "a bridge with another key is not believed"
    stop_bridge
    start_bridge --key "$key"
    boards_are running '0x0[048C][01]' "a bridge with the key is"
    stop_bridge
    end_room
}

test_poses() {
    boards_are waiting 0x100 "boards with a key want a session"
    start_sender
    boards_are waiting 0x100 "nobody is believed without a key"
    stop_sender
    start_sender --key "$wrong"
    boards_are waiting '0x18[01]' "nor with another one"
    stop_sender
    start_sender --key "$key"
    boards_are running '0x0[048C][01]' "who has the key is"
    pose_tool check --bus "$bus" --seconds 2
    grep -q 'load: ' "$scratch/stdout" && ! grep -q 'none of wallwarp.dbc' "$scratch/stdout"
    check "and check knows every frame" $?
    start_sender_pid=$sender
    start_sender --rate 20 --no-sync
    boards_are running '0x0[8C]1' "poses without a code move nothing, and are noticed"
    stop_sender
    sender=$start_sender_pid
    stop_sender
    start_sender --key "$key"
    boards_are running '0x0[048C][01]' "a tracker that starts anew is believed again"
}

# tell KEY_OPTIONS NODE COMMAND ...
tell() {
    pose_tool command --bus "$bus" --node "$@"
}

test_commands() {
    refuses 1 "board 1 refuses: it has a key" "$build/wallwarp-pose" command --bus "$bus" --node 1 freeze on
    refuses 1 "board 1 refuses: it has a key" "$build/wallwarp-pose" command --bus "$bus" --node 1 freeze on \
        --key "$wrong"
    refuses 1 "board 2 refuses" "$build/wallwarp-pose" command --bus "$bus" --node 2 hello
    boards_are running '0x0[048C][01]' "a command without the key does nothing"
    tell all hello --key "$key" && [ "$(grep -c '^board [12]: wallwarp [0-9.]*, ' "$scratch/stdout")" -eq 2 ]
    check "boards say hello to who has the key" $?
    tell all freeze on --key "$key" && [ "$(grep -c '^board [12]: done$' "$scratch/stdout")" -eq 2 ]
    check "and do what it says" $?
    boards_are frozen '0x0[048C][01]' "all of them"
    tell 1 log --key "$key" --all && grep -q 'command   freeze: refused' "$scratch/stdout" &&
        grep -q 'faults .*refused' "$scratch/stdout" && grep -q 'faults .*no session' "$scratch/stdout" &&
        grep -q 'command   session: done' "$scratch/stdout"
    check "what was refused is in the log" $?
}

test_rooms_without() {
    start_room open
    refuses 1 "board 1 has no key; leave --key out" "$build/wallwarp-pose" command --bus "$bus" --node 1 hello \
        --key "$key"
    refuses 1 "has mode 0644" "$build/wallwarp-pose" send --bus "$bus" still --key "$scratch/open_key"
    refuses 1 "No such file" "$build/wallwarp-pose" command --bus "$bus" --node 1 hello --key "$scratch/none"
    end_room
    refuses 1 "has mode 0644" "$build/wallwarp-sim" run "$scratch/fd.yaml" --video $picture --poses "$scratch/ten.csv" \
        --out "$scratch/refused" --key "$scratch/open_key"
    refuses 1 "has mode 0644" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --key "$scratch/open_key"
    refuses 2 "--no-sync: boards with a key believe" "$build/wallwarp-pose" send --bus can0 still --key "$key" --no-sync
}

test_firmware() {
    "$build/wallwarp" "$scratch/classic.yaml" --node 1 --can 0 --camera $picture --display none --key "$key" \
        2>"$scratch/firmware.err" >/dev/null &
    firmware=$!
    started="$started $firmware"
    bus=127.0.0.1:$(port_in "$scratch/firmware.err")
    start_sender --key "$key"
    boards=1
    boards_are running '0x0[048C][01]' "the firmware by itself believes who has the key"
    stop_sender
    kill -INT "$firmware"
    wait "$firmware"
    check "and ends well" $?
}

cp "$key" "$scratch/open_key"
chmod 644 "$scratch/open_key"
boards=12
start_room keyed --key "$key"
test_poses
test_commands
stop_sender
end_room
test_bridge
test_rooms_without
test_firmware
finish
