#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# `wallwarp --config` on the simulator's devices: whatever is wrong with configuration, room, key or devices is on the
# wall, on stderr and on the bus; what is right runs as without.
# usage: test_config.sh BUILD, from the tree's root
set -u
build=${1:?usage: test_config.sh BUILD}
. tests/sim/run/programs.sh
scratch=$(realpath "$scratch")
room=sim/demo/room.yaml

# configure LINE...: the board's own file, of a bus on any free port and a display that is the folder wall
configure() {
    printf '%s\n' 'can: 0' 'display: wall' "$@" >"$scratch/wallwarp.yaml"
}

# start OPTION...: the firmware, with the folder $scratch as its own
start() {
    rm -rf "$scratch/wall" "$scratch/said"
    program=$(realpath "$build")/wallwarp
    (cd "$scratch" && exec "$program" "$@" 2>said) &
    firmware=$!
    started="$started $firmware"
}

# opened: it has done so with its devices, and said the reason and where it has its bus.
opened() {
    for _ in $(seq 100); do
        grep -q '^display: ' "$scratch/said" 2>/dev/null && break
        sleep 0.1
    done
    reason=$(sed -n 's/^wallwarp: //p' "$scratch/said" | tail -n 1)
    bus=$(sed -n 's/^can: bus on \([0-9.:]*\).*/\1/p' "$scratch/said" | tail -n 1)
}

# end NAME STATUS: SIGTERM, and it must end with that status.
end() {
    kill "$firmware"
    wait "$firmware"
    found=$?
    [ "$found" -eq "$2" ]
    check "$1: exit status $found, expected $2" $?
}

# wall_shows NAME WIDTH HEIGHT NODE BOARD REASON: soon, and every byte of it
wall_shows() {
    "$build/tests/board/picture_tool" safe "$2" "$3" "$4" "$5" "$6" >"$scratch/wanted.ppm"
    for _ in $(seq 100); do
        "$build/tests/board/picture_tool" differ "$scratch/wanted.ppm" "$scratch/wall/display.png" >/dev/null 2>&1 && break
        sleep 0.1
    done
    "$build/tests/board/picture_tool" differ "$scratch/wanted.ppm" "$scratch/wall/display.png" >"$scratch/differs" 2>&1
    check "$1: the wall does not say \"$6\": $(cat "$scratch/differs")" $?
}

# says NAME LINE: on stderr
says() {
    grep -qxF "wallwarp: $2" "$scratch/said"
    check "$1: expected on stderr: $2; said: $(cat "$scratch/said")" $?
}

# heard NAME TEXT: in what the monitor shows of the bus
heard() {
    opened && timeout 20 "$build/wallwarp-pose" monitor --bus "$bus" --seconds 1.2 >"$scratch/monitor" 2>&1
    grep -q -- "$2" "$scratch/monitor"
    check "$1: the bus does not say \"$2\"" $?
}

# command NAME STATUS WHAT: what becomes of it
command() {
    opened && timeout 20 "$build/wallwarp-pose" command --bus "$bus" --node 1 "$3" >"$scratch/stdout" 2>&1
    found=$?
    [ "$found" -eq "$2" ]
    check "$1: $3: status $found, expected $2: $(cat "$scratch/stdout")" $?
}

test_broken_room() {
    sed s/corners_mm/corner_mm/ $room >"$scratch/room.yaml"
    configure 'node: 1' 'room: room.yaml'
    reason="$scratch/room.yaml:9: boards[0].wall.corner_mm: unknown key, expected one of corners_mm"
    start --config wallwarp.yaml
    wall_shows "broken room" 1280 800 1 host "$reason"
    says "broken room" "$reason"
    heard "broken room" '^ *1  fault .* 0x200 '
    command "broken room" 0 hello
    end "broken room" 0
}

test_wrong_node() {
    cp $room "$scratch/room.yaml"
    configure 'node: 9' 'room: room.yaml'
    start --config wallwarp.yaml
    wall_shows "wrong node" 1280 800 9 host "$scratch/room.yaml: no board has node 9, expected one of 1, 2, 3, 4"
    heard "wrong node" '^ *9  fault .* 0x200 '
    end "wrong node" 0
}

# No configuration, no node: no bus, and the display is that of the command line.
test_wrong_configuration() {
    rm "$scratch/wallwarp.yaml"
    start --config wallwarp.yaml --display wall
    reason="wallwarp.yaml:1: file: cannot be opened (No such file or directory), expected a board's configuration in YAML"
    wall_shows "no configuration" 1280 800 0 host "$reason"
    says "no configuration" "$reason"
    ! grep -q '^can: ' "$scratch/said"
    check "no configuration: a bus without a node" $?
    end "no configuration" 0

    printf 'room: room.yaml\n' >"$scratch/wallwarp.yaml"
    start --config wallwarp.yaml --display wall --node 1 --can 0
    wall_shows "no node" 1280 800 1 host "wallwarp.yaml:1: node: missing, expected a whole number"
    heard "no node" '^ *1  fault .* 0x200 '
    command "no node" 1 hello # there may be a key
    end "no node" 0
}

test_wrong_key() {
    configure 'node: 1' 'room: room.yaml' 'key: room.key'
    (umask 022 && echo 00112233445566778899aabbccddeeff >"$scratch/room.key")
    start --config wallwarp.yaml
    heard "open key" '^ *1  fault .* 0x200 '
    expr "$reason" : "key: $scratch/room.key: has mode 0644" >/dev/null
    check "open key: said \"$reason\"" $?
    wall_shows "open key" 1280 800 1 host "$reason"
    command "open key" 1 hello
    end "open key" 0
}

# It ends by itself, so that whoever started it may try again.
test_missing_camera() {
    configure 'node: 1' 'room: room.yaml' 'camera: none.png'
    start --config wallwarp.yaml
    heard "no camera" '^ *1  fault .* 0x200 '
    expr "$reason" : 'none.png: ' >/dev/null
    check "no camera: said \"$reason\"" $?
    wall_shows "no camera" 1280 800 1 front "$reason"
    wait "$firmware"
    found=$?
    [ "$found" -eq 1 ]
    check "no camera: ended with status $found, expected 1" $?
}

test_all_is_right() {
    configure 'node: 2' 'room: room.yaml' 'camera: pattern'
    start --config wallwarp.yaml
    heard "good" '^ *2  waiting .* 0 *'
    grep -q '^wallwarp: board "left" on host' "$scratch/said"
    check "good: said $(cat "$scratch/said")" $?
    wall_shows "good" 960 540 2 left "no pose yet"
    cp "$scratch/wall/display.png" "$scratch/with_config.png"
    end "good" 0
    start room.yaml --node 2 --can 0 --display wall
    wall_shows "without a configuration" 960 540 2 left "no pose yet"
    cmp -s "$scratch/wall/display.png" "$scratch/with_config.png"
    check "the same picture with and without a configuration" $?
    end "without a configuration" 0
    start --config wallwarp.yaml --node 1
    wall_shows "the command line wins" 960 540 1 front "no pose yet"
    end "the command line wins" 0
}

# Lines have their priority where stderr is the journal that systemd names, and nowhere else.
test_journal() {
    : >"$scratch/journal"
    sed 's/\[-2400, -2700, 2400\], \[2400, -2700/[-2400, -2700, 2200], [2400, -2700/' $room >"$scratch/odd.yaml"
    for journal in "$(stat -c %d:%i "$scratch/journal")" 1:2; do
        JOURNAL_STREAM=$journal "$build/wallwarp" "$scratch/odd.yaml" --node 9 2>>"$scratch/journal"
    done
    "$build/wallwarp" "$scratch/odd.yaml" --node 9 2>>"$scratch/journal"
    sed 's/: .*//' "$scratch/journal" >"$scratch/begins"
    printf '%s\n' '<4>warning' '<3>wallwarp' warning wallwarp warning wallwarp | cmp -s - "$scratch/begins"
    check "journal: $(cat "$scratch/journal")" $?
}

test_journal
test_broken_room
test_wrong_node
test_wrong_configuration
test_wrong_key
test_missing_camera
test_all_is_right
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
