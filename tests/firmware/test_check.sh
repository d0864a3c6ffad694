#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# `wallwarp --check` and `--off` on the simulator's devices: what is said of each, exit status, nothing left behind.
# usage: test_check.sh BUILD, from the tree's root
set -u
. tests/support/checks.sh
wallwarp=$1/wallwarp
room=sim/demo/room.yaml
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ok_files=$folder/out

# expect STATUS TEXT ARGUMENTS...: the program ends with the status, and prints a line that begins with the text
expect() {
    status=$1
    text=$2
    shift 2
    "$wallwarp" "$@" >"$folder/out" 2>&1
    found=$?
    [ "$found" = "$status" ] && awk -v text="$text" 'index($0, text) == 1 {n++} END {exit n == 0}' "$folder/out"
    ok $? "wallwarp $*: status $found, expected $status and a line that begins with: $text"
}

expect 0 'found    room: none was named' --check
expect 0 'found    can: port 29536 of 127.0.0.1' --check
expect 0 "found    room: $room, node 1, \"front\"" --check $room --node 1
expect 0 'found    camera: pattern, 960x540' --check $room --node 1
expect 0 'found    camera: sim/demo/studio_960x540.png' --check --camera nv12:sim/demo/studio_960x540.png
expect 1 'missing  room: nowhere.yaml' --check nowhere.yaml --node 1
expect 1 "missing  room: $room: no board has node 7, expected one of 1, 2, 3, 4" --check $room --node 7
expect 1 'missing  can: found "can0", expected a port' --check --can can0
expect 1 'missing  camera: nowhere.png' --check --camera nowhere.png
expect 1 'missing  camera: tests/images/studio_480x270.png' --check $room --node 1 --camera tests/images/studio_480x270.png
expect 1 'missing  display: Makefile is no folder' --check --display Makefile
expect 0 "found    display: $folder/new" --check --display "$folder/new"
[ ! -e "$folder/new" ]
ok $? "--check made a folder"
# configured FILE LINE...: that file in the folder
configured() {
    file=$folder/$1
    shift
    printf '%s\n' "$@" >"$file"
}
(umask 077 && echo 00112233445566778899aabbccddeeff >"$folder/room.key")
cp $room "$folder/room.yaml"
configured good 'node: 2' 'room: room.yaml' 'key: room.key' 'can: 29537' "display: $folder/wall"
expect 0 "found    config: $folder/good" --check --config "$folder/good"
expect 0 "found    room: $folder/room.yaml, node 2, \"left\"" --check --config "$folder/good"
expect 0 "found    key: $folder/room.key" --check --config "$folder/good"
expect 0 'found    can: port 29537 of 127.0.0.1' --check --config "$folder/good"
expect 0 "found    display: $folder/wall" --check --config "$folder/good"
expect 0 "found    room: $folder/room.yaml, node 1, \"front\"" --check --config "$folder/good" --node 1
expect 0 'found    can: port 29538 of 127.0.0.1' --check --config "$folder/good" --can 29538
expect 1 'missing  room: nowhere.yaml:1: file: cannot be opened' --check --config "$folder/good" nowhere.yaml
configured bad 'node: 2' 'room: room.yaml' 'can: can0' 'workers: 9'
expect 1 "missing  config: $folder/bad:4: workers: found 9, expected 1 to 4" --check --config "$folder/bad"
! grep -q room: "$folder/out"
ok $? "--check of a wrong configuration says something of a room"
configured keyless 'node: 2' 'room: room.yaml' 'key: none.key'
expect 1 "missing  key: $folder/none.key: " --check --config "$folder/keyless"
expect 1 'missing  config: nowhere.yaml:1: file: cannot be opened' --check --config nowhere.yaml
expect 2 'wallwarp: expected ROOM and --node N' --check $room
expect 2 'wallwarp: expected ROOM and --node N' --check --node 1
expect 2 'wallwarp: expected ROOM and --node N'
"$wallwarp" --off >"$folder/out" 2>&1
ok $? "--off"
[ ! -s "$folder/out" ]
ok $? "--off said something"
"$wallwarp" --help | tr -s ' \n' '  ' >"$folder/out"
for text in 'The bus is a port of 127.0.0.1' 'the display a folder' 'not XRGB. Ends on SIGINT or SIGTERM.' ', 2 bad usage.'; do
    grep -qF "$text" "$folder/out"
    ok $? "--help has no: $text"
done

ok_end
