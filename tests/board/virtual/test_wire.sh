#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The firmware on an emulated wire, seen from its second controller, classic and CAN FD: poses from wallwarp-pose and
# from can-utils give the simulator's picture, bus time is on the wire, and the operator's tools and the kernel's own
# ISO-TP reach the board. Usage, from the tree's root: test_wire.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
set -u
build=${1:?usage: test_wire.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/support/checks.sh
. tests/board/virtual/picture.sh

pattern=10
method=none+nearest
pose_of_tool="300.25 -1500.5 -200 0.998046875 0.03125 -0.046875 0.015625"
pose_of_cansend="-700 -1700 1000.75 0.984375 0 0.125 0.0625"

# wanted_is_shown BUS KIND SENDER POSE
wanted_is_shown() {
    want $pattern "$4" "$2"
    shows "$1" $method
    ok $? "$2, $3: $differences"
}

# test_tool BUS KIND SEND_OPTION...: `wallwarp-pose send`, and what it says of time.
test_tool() {
    local bus=$1 kind=$2
    shift 2
    vm_run "/tree/$build/wallwarp-pose send --bus $bus $* still --at '$pose_of_tool' --seconds 600 \
        >/share/send 2>&1 & echo \$! >/share/sender"
    wanted_is_shown "$bus" "$kind" wallwarp-pose "$pose_of_tool"
    heard=$(vm_run "candump -n 8 -T 3000 $bus,040:7FF,080:7FF" | awk '{ printf "%s ", $2 }')
    [[ $heard == *'040 080 040 080 040 080 '* ]]
    ok $? "$kind: pairs of Sync and FollowUp, heard $heard"
    # vivid does not keep the display's rate, so that the board can't be in step; all else is well.
    said=$(vm_run "/tree/$build/wallwarp-pose check --bus $bus --room /share/room.yaml --seconds 3")
    grep -q '^ok   bus time: given by number 0' <<<"$said" && grep -q '^ok   latency: ' <<<"$said" &&
        [ "$(grep -v '^ok' <<<"$said" | grep -vc 'in step in')" = 0 ]
    ok $? "$kind: wallwarp-pose check: $said"
    said=$(monitor "$bus")
    grep -Eq '^ *0  (fd|set) .* tracked ' <<<"$said" && grep -q '^ *1  running .* 0x000 ' <<<"$said"
    ok $? "$kind: wallwarp-pose monitor: $said"
    end sender
}

# test_cansend BUS KIND: one process of can-utils for each frame.
test_cansend() {
    "$host/tests/board/wire_tool" frames "$pose_of_cansend" "$2" >"$VM/share/frames"
    vm_run "sed 's/^/cansend $1 /; / 1\(00\|12\)#/s/\$/; sleep 0.03/' /share/frames >/run/cansends
        { while true; do . /run/cansends; done; } >/share/send 2>&1 & echo \$! >/share/sender"
    wanted_is_shown "$1" "$2" cansend "$pose_of_cansend"
    end sender
}

# test_requests BUS KIND: hello, from our tool and from the kernel's ISO-TP; a method that the board is ready for, and one
# that it is not.
test_requests() {
    said=$(vm_run "/tree/$build/wallwarp-pose command hello --bus $1 --node 1")
    ok $? "$2, command hello: $said"
    reply=$(vm_run "isotprecv -s 601 -d 641 $1 >/share/reply & sleep 0.2; echo 01 | isotpsend -s 601 -d 7FF -p CC:CC $1
        for i in 1 2 3 4 5 6 7 8 9 10; do [ -s /share/reply ] && break; sleep 0.2; done; kill \$! 2>/dev/null; cat /share/reply")
    text=$(printf %b "$(sed 's/ *$//; s/ *\(..\)/\\x\1/g' <<<"${reply:21}")")
    [[ $reply == '81 00 01 '* && -n $text && $said == *"$text"* ]]
    ok $? "$2, hello over the kernel's ISO-TP: heard $reply, $text; the tool heard: $said"
    said=$(vm_run "/tree/$build/wallwarp-pose command method mean+cubic --bus $1 --node 1 && sleep 1.2") &&
        said=$(monitor "$1") && grep -q '^ *1  .* mean+cubic, step 0$' <<<"$said"
    ok $? "$2, command method: $said"
    said=$(vm_run "/tree/$build/wallwarp-pose command method gauss+linear --bus $1 --node 1")
    [ "$?" = 1 ] && [[ $said == *'board 1 is not ready for this method; put it into the room file'* ]]
    ok $? "$2, command method, not ready: $said"
}

# test_wire KIND OF_BOARD OTHER SEND_OPTION...
test_wire() {
    local kind=$1 bus=$3
    start_firmware "s/method: .*/method: $method/; s/refresh_hz: 24/&, pose_delay_ms: 10/; s/fd: .*/fd: $([ "$kind" = fd ] && echo true || echo false)}/" --can "$2"
    shift 3
    test_tool "$bus" "$kind" "$@"
    test_cansend "$bus" "$kind"
    test_requests "$bus" "$kind"
    end_firmware
    ended=$?
    ok "$ended" "$kind: the firmware ends with status $ended; it said: $(cat "$VM/share/firmware")"
}

trap vm_stop EXIT
picture_board build/vm-wire 320x240@24 || exit 1
vm_in_memory /usr/bin/cansend
record_frame $pattern
ok $? "the camera's picture stands still"
test_wire classic can0 can1
test_wire fd can2 can3 --fd
ok_end
