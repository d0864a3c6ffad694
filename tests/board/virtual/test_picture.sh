#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The firmware on the virtual board: what its display shows, seen from outside, is the simulator's picture for the same
# frame and pose, byte for byte. The frame is a still one of vivid, recorded before the firmware takes the camera.
# Usage, from the tree's root: tests/board/virtual/test_picture.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
set -u
build=${1:?usage: test_picture.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/board/virtual/checks.sh

poses=("0 -1200 -800 0.9375 0 0.34375 0"
    "300.25 -1500.5 -200 0.998046875 0.03125 -0.046875 0.015625"
    "-700 -1700 1000.75 0.984375 0 0.125 0.0625"
    "0 -1200 0 0.96875 0.0625 0 0.21875")
patterns=(4 20 10 2) # of vivid: colour squares, gray ramp, 16x16 checkers, colour bars

set_pattern() {
    vm_run "v4l2-ctl -d /dev/video0 -c test_pattern=$1,osd_text_mode=2,show_border=1,show_square=1"
}

# Two frames of each pattern, which must be the same: it stands still.
record_frames() {
    local pattern
    for pattern in "${patterns[@]}"; do
        set_pattern "$pattern"
        vm_run "for i in 1 2; do v4l2-ctl -d /dev/video0 --set-fmt-video=width=320,height=180,pixelformat=XR24 \
            --stream-mmap --stream-count=1 --stream-to=/share/$pattern.\$i >/dev/null 2>&1; done"
        cmp "$VM/share/$pattern.1" "$VM/share/$pattern.2" &&
            "$host/tests/board/picture_tool" png 320 180 "$VM/share/$pattern.1" "$VM/$pattern.png"
        ok "pattern $pattern stands still" $?
    done
}

# start_firmware METHOD: with a room of that method.
start_firmware() {
    sed "s/method: .*/method: $1/" tests/board/virtual/picture_room.yaml >"$VM/share/room.yaml"
    vm_run "/tree/$build/wallwarp /share/room.yaml --node 1 >/share/firmware 2>&1 & echo \$! >/share/pid"
}

# end PID_FILE: a program that was started.
end() {
    vm_run "kill \"\$(cat /share/$1)\"; while [ -e \"/proc/\$(cat /share/$1)\" ]; do sleep 0.1; done"
}

# uses METHOD: the firmware says that it corrects with it, and not with a cheaper one.
uses() {
    vm_run "/tree/$build/wallwarp-pose monitor --bus can1 --seconds 1.2" | grep -q "^ *1  running .* $1, step 0\$"
}

# shows PNG METHOD: soon the display does, and again after the firmware has said that this is its method.
shows() {
    local i before=
    for ((i = 0; i < 20; i++)); do
        vm_screenshot "$VM/seen.ppm"
        if ! differences=$("$host/tests/board/picture_tool" differ "$VM/seen.ppm" "$1"); then
            before=
        elif [ -n "$before" ]; then
            return 0
        else
            before=same
        fi
        uses "$2" || before=
    done
    vm_run "/tree/$build/wallwarp-pose monitor --bus can1 --seconds 1.2"
    return 1
}

# compare METHOD: the display with the simulator, for each pose and its pattern.
compare() {
    local i pose
    for i in "${!poses[@]}"; do
        pose=$("$host/tests/board/picture_tool" pose "${poses[i]}")
        set_pattern "${patterns[i]}"
        vm_run "/tree/$build/wallwarp-pose send --bus can1 still --rate 30 --at '${poses[i]}' --seconds 600 \
            >/dev/null 2>&1 & echo \$! >/share/sender"
        "$host/wallwarp-sim" warp "$VM/share/room.yaml" --board front --pose "$pose" --in "$VM/${patterns[i]}.png" \
            --out "$VM/wanted.png"
        shows "$VM/wanted.png" "$1"
        ok "pose $i, $1: $differences" $?
        end sender
    done
}

# Time on this board is told by its instructions, so that it is as fast as a real one however slow this machine is, and
# the firmware has no reason for a cheaper method.
trap vm_stop EXIT
VM_ACCEL=tcg,thread=single vm_start build/vm-picture -icount shift=0,sleep=off \
    -append 'console=ttyAMA0 panic=-1 quiet video=Virtual-1:320x240@24' || exit 1
vm_run 'ip link set can0 up type can bitrate 500000 restart-ms 100; ip link set can1 up type can bitrate 500000'
record_frames
for method in mean+cubic gauss+linear none+nearest; do
    start_firmware $method
    compare $method
    end pid
    ok "$method: the firmware ends: $(cat "$VM/share/firmware")" $?
done
ok_end
