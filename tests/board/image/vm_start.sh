#!/bin/bash
# shellcheck disable=SC2016 # the board expands what is in commands
# SPDX-License-Identifier: Apache-2.0
# An image on the virtual board, from power-on through U-Boot to a wall that is lit: the safe picture, and with poses the
# simulator's corrected one, byte for byte and in time.
# Usage, from the tree's root: tests/board/image/vm_start.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
set -u
build=${1:?usage: vm_start.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/support/checks.sh
pose='0 -1200 -800 0.9375 0 0.34375 0'
most_seconds=20

# The camera's picture, which stands still, into $VM/frame.png: over the serial line, as the image has no other way out.
record_frame() {
    card_run 'systemctl stop wallwarp
        v4l2-ctl -d /dev/video0 -c test_pattern=4,osd_text_mode=2,show_border=1,show_square=1
        v4l2-ctl -d /dev/video0 --set-fmt-video=width=320,height=180,pixelformat=XR24 --stream-mmap --stream-count=1 \
            --stream-to=/tmp/frame >/dev/null 2>&1
        gzip -9 </tmp/frame | base64' >"$VM/frame.base64"
    base64 -d "$VM/frame.base64" | gzip -d >"$VM/frame" &&
        "$host/tests/board/picture_tool" png 320 180 "$VM/frame" "$VM/frame.png"
}

# Seconds of the board's own clock, which its instructions make, from power-on to the start of its kernel: its RTC counts
# from power-on, and one step of it is waited for.
before_kernel() {
    card_run 'at=$(cat /sys/class/rtc/rtc0/since_epoch)
        until now=$(cat /sys/class/rtc/rtc0/since_epoch) && [ "$now" != "$at" ]; do :; done
        read -r up _ </proc/uptime; echo "$now $up"' | awk '{ print $1 - $2 }'
}

# From the firmware's start to its first corrected picture, when poses come already.
to_corrected() {
    card_run 'read -r began _ </proc/uptime; systemctl start wallwarp
        until systemctl show wallwarp -p StatusText | grep -q running; do :; done
        read -r up _ </proc/uptime; echo "$began $up"' | awk '{ print $2 - $1 }'
}

trap vm_stop EXIT
card_delay=2
card_insert build/vm-start "$build/wallwarp-qemu-virt.img" || exit 1
card_power -rtc base=1970-01-01,clock=vm
if ! card_up 300; then
    tail -n 20 "$VM/console" "$VM/qemu"
    ok 1 "the image does not start"
    ok_end
    exit
fi
"$host/tests/board/picture_tool" safe 320 240 1 front "no pose yet" >"$VM/safe.ppm"
card_shows cmp -s "$VM/seen.ppm" "$VM/safe.ppm"
ok $? "the wall does not show the safe picture"
kernel=$(before_kernel)
firmware=$(card_run 'systemctl show wallwarp -p ExecMainStartTimestampMonotonic --value' | awk '{ print $1 / 1000000 }')

record_frame
ok $? "no picture of the camera"
card_run "ip link set can1 up txqueuelen 64 type can bitrate 500000
    wallwarp-pose send --bus can1 still --rate 30 --at '$pose' --seconds 3600 >/dev/null 2>&1 &"
picture=$(to_corrected)
"$host/wallwarp-sim" warp board/qemu-virt/room.yaml --board front --in "$VM/frame.png" --out "$VM/wanted.png" \
    --pose "$("$host/tests/board/picture_tool" pose "$pose" classic)"
card_shows "$host/tests/board/picture_tool" differ "$VM/seen.ppm" "$VM/wanted.png" >"$VM/differ"
ok $? "the wall does not show the simulator's picture: $(tail -n 1 "$VM/differ")"
echo "power-on to the kernel $kernel s, to the firmware's start $firmware s more, to the corrected picture $picture s more"
awk "BEGIN { exit !($kernel > 0 && $firmware > 0 && $picture > 0 && $kernel + $firmware + $picture <= $most_seconds) }"
ok $? "that is more than $most_seconds s"
ok_end
