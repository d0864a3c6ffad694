#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A board whose configuration, room or devices are wrong lights its wall with the reason, says it on the bus, and leaves
# every device as it was. The wall is the picture that this machine makes of the same words, byte for byte.
# Usage, from the tree's root: tests/board/virtual/test_config.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
# shellcheck disable=SC2016 # the board expands what is in the commands
set -u
build=${1:?usage: test_config.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/board/virtual/firmware.sh
. tests/support/checks.sh

config_fault=512 # of Heartbeat, wallwarp.dbc

# configure LINE...: the board's own file
configure() {
    printf '%s\n' "$@" >"$VM/share/wallwarp.yaml"
}

# begin [OPTION...]: the firmware, and heartbeats are heard on the other end of its wire.
begin() {
    heartbeats can3
    start firmware "/run/wallwarp --config /share/wallwarp.yaml $*"
}

# says REASON: it is on stderr, in a line of its own.
says() {
    local i
    for ((i = 0; i < 100; i++)); do
        grep -qxF "wallwarp: $1" "$VM/share/firmware" && break
        sleep 0.2
    done
    grep -qxF "wallwarp: $1" "$VM/share/firmware"
    ok $? "${FUNCNAME[1]}: expected \"$1\"; said: $(cat "$VM/share/firmware")"
}

# shows NODE BOARD REASON: the display does, soon.
shows() {
    local i size
    for ((i = 0; i < 50; i++)); do
        vm_screenshot "$VM/seen.ppm"
        size=$(sed -n 2p "$VM/seen.ppm")
        # shellcheck disable=SC2086 # width and height
        "$host/tests/board/picture_tool" safe $size "$1" "$2" "$3" >"$VM/wanted.ppm"
        cmp -s "$VM/seen.ppm" "$VM/wanted.ppm" && break
        sleep 0.2
    done
    cmp "$VM/seen.ppm" "$VM/wanted.ppm"
    ok $? "${FUNCNAME[1]}: the wall says \"$3\", at $size"
}

# has_ended STATUS FOUND: it did so, and every device is free.
has_ended() {
    [ "$1" = "$2" ]
    ok $? "${FUNCNAME[1]}: exit status $2, expected $1"
    vm_run '! gpioinfo wallwarp | grep -q wallwarp\" &&
        [ "$(cat /sys/class/watchdog/watchdog0/state)" = inactive ] &&
        ! ls -l /proc/[0-9]*/fd 2>/dev/null | grep -q " /dev/video0\$\| /dev/dri/card0\$"'
    ok $? "${FUNCNAME[1]}: devices are free"
}

test_broken_room() {
    sed s/corners_mm/corner_mm/ tests/board/virtual/picture_room.yaml >"$VM/share/broken.yaml"
    configure 'node: 1' 'room: broken.yaml'
    local line
    line=$(grep -n corner_mm "$VM/share/broken.yaml" | cut -d : -f 1)
    local reason="/share/broken.yaml:$line: boards[0].wall.corner_mm: unknown key, expected one of corners_mm"
    begin
    says "$reason"
    shows 1 qemu-virt "$reason"
    comes fault && [ "$(said)" = $config_fault ]
    ok $? "heartbeats: faults $(said), expected $config_fault"
    [ "$(led) $(lamp)" = 'fast 1' ]
    ok $? "the LED blinks fast, the lamp is on"
    vm_run "/tree/$build/wallwarp-pose command --bus can3 --node 1 hello" | grep -q '^board 1: wallwarp '
    ok $? "it answers an operator"
    vm_run 'sleep 3' && vm_alive
    ok $? "the watchdog is fed"
    has_ended 0 "$(end firmware)"
}

# Another display is taken, and without a node no bus.
test_missing_configuration() {
    rm -f "$VM/share/wallwarp.yaml"
    local reason="/share/wallwarp.yaml:1: file: cannot be opened (No such file or directory), expected a board's "
    reason+="configuration in YAML"
    begin --display HDMI-A-9
    says "$reason"
    shows 0 qemu-virt "$reason"
    ! came fault
    ok $? "no heartbeats without a node"
    has_ended 0 "$(end firmware)"
}

# As long as it is missing the firmware ends, to be started again.
test_missing_camera() {
    local reason
    cp tests/board/virtual/picture_room.yaml "$VM/share/room.yaml"
    configure 'node: 1' 'room: room.yaml' 'camera: v4l2:/dev/video99'
    begin
    comes fault && [ "$(said)" = $config_fault ]
    ok $? "heartbeats: faults $(said), expected $config_fault"
    reason=$(sed -n 's/^wallwarp: \(.*video99.*\)/\1/p' "$VM/share/firmware" | tail -n 1)
    shows 1 front "$reason"
    vm_run 'while [ ! -s /share/firmware.status ]; do sleep 0.2; done'
    has_ended 1 "$(cat "$VM/share/firmware.status")"
}

# The rates are those of the interface.
test_other_bit_rate() {
    vm_run 'for can in can2 can3; do
        ip link set $can down; ip link set $can up txqueuelen 64 type can bitrate 250000 fd off restart-ms 100; done'
    configure 'node: 1' 'room: none.yaml'
    begin
    says "/share/none.yaml:1: file: cannot be opened (No such file or directory), expected a room file in YAML"
    comes fault && [ "$(said)" = $config_fault ]
    ok $? "heartbeats at 250 kbit/s: faults $(said), expected $config_fault"
    has_ended 0 "$(end firmware)"
}

vm_use || exit 1
vm_run 'for can in can2 can3; do ip link set $can up txqueuelen 64 type can bitrate 500000 dbitrate 2000000 fd on restart-ms 100; done'
vm_run "cp /tree/$build/wallwarp /run/"
vm_in_memory /run/wallwarp
tests=${*:3}
for test in ${tests:-broken_room missing_configuration missing_camera other_bit_rate}; do
    "test_$test"
done
end heartbeats >/dev/null
vm_run 'ip link set can2 down; ip link set can3 down'
ok_end
