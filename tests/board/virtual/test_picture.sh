#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The firmware on the virtual board: what its display shows, seen from outside, is the simulator's picture for the same
# frame and pose, byte for byte. The frame is a still one of vivid (V4L2) or of vimc (libcamera), recorded before the
# firmware takes the camera, and changes while it runs.
# Usage, from the tree's root: tests/board/virtual/test_picture.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
set -u
build=${1:?usage: test_picture.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/support/checks.sh
. tests/board/virtual/picture.sh

poses=("0 -1200 -800 0.9375 0 0.34375 0"
    "300.25 -1500.5 -200 0.998046875 0.03125 -0.046875 0.015625"
    "-700 -1700 1000.75 0.984375 0 0.125 0.0625"
    "0 -1200 0 0.96875 0.0625 0 0.21875")
patterns=(4 20 10 2) # of vivid: colour squares, gray ramp, 16x16 checkers, colour bars

# compare METHOD: the display with the simulator, for each pose and its pattern.
compare() {
    local i
    for i in "${!poses[@]}"; do
        set_pattern "${patterns[i]}"
        vm_run "/tree/$build/wallwarp-pose send --bus can1 still --rate 30 --at '${poses[i]}' --seconds 600 \
            >/dev/null 2>&1 & echo \$! >/share/sender"
        want "${patterns[i]}" "${poses[i]}" classic
        shows can1 "$1"
        ok $? "pose $i, $1: $differences"
        end sender
    done
}

# With libcamera: the wall follows each change of the camera's picture.
test_libcamera() {
    local pattern
    for pattern in 4 2; do
        record_vimc_frame $pattern
        ok $? "vimc's pattern $pattern stands still"
    done
    start_firmware "s/width: 320, height: 180/width: 318, height: 180/; s/method: .*/method: mean+cubic/" --can can0 \
        --camera libcamera:0
    vm_run "/tree/$build/wallwarp-pose send --bus can1 still --rate 30 --at '${poses[0]}' --seconds 600 \
        >/dev/null 2>&1 & echo \$! >/share/sender"
    for pattern in 2 4; do
        set_vimc_pattern $pattern
        want vimc-$pattern "${poses[0]}" classic
        shows can1 mean+cubic
        ok $? "vimc's pattern $pattern, libcamera: $differences"
    done
    end sender
    end_firmware
    ended=$?
    ok "$ended" "libcamera: the firmware ends with status $ended; it said: $(cat "$VM/share/firmware")"
}

trap vm_stop EXIT
picture_board build/vm-picture 320x240@24 || exit 1
for pattern in "${patterns[@]}"; do
    record_frame "$pattern"
    ok $? "pattern $pattern stands still"
done
for method in mean+cubic gauss+linear none+nearest; do
    start_firmware "s/method: .*/method: $method/" --can can0
    compare $method
    end_firmware
    ended=$?
    ok "$ended" "$method: the firmware ends with status $ended; it said: $(cat "$VM/share/firmware")"
done
test_libcamera
ok_end
