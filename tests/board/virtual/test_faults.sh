#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Faults of the running firmware on the virtual board: each ends in the state that firmware/STATES.md names, as LED, wall
# and heartbeats tell it, and afterwards all is as before. Then how the firmware ends, and what then ends the board.
# Usage, from the tree's root: tests/board/virtual/test_faults.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
# shellcheck disable=SC2016 # the board expands what is in the commands
set -u
build=${1:?usage: test_faults.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/board/virtual/firmware.sh
. tests/support/checks.sh

pose="0 -1200 -800 0.9375 0 0.34375 0"
bus_fault=1 bus_off=2 camera_fault=4 display_fault=8 # of Heartbeat, wallwarp.dbc

# is STATE LED WALL: the firmware, soon. Safe pictures are called by their reasons.
is() {
    local found
    comes "$1" && found="$(led) $(wall no_pose_yet no_pose no_video corrected before)" && [ "$found" = "$2 $3" ]
    ok $? "${FUNCNAME[1]}: $1; LED and wall: ${found-}, expected $2 $3"
}

# is_well FAULTS: it runs as before, its heartbeats have named these faults since the mark, and name none any more.
is_well() {
    local faults
    is running on corrected
    faults=$(said)
    [ "$faults" = "$1" ]
    ok $? "${FUNCNAME[1]}: said faults $faults, expected $1"
    mark
    vm_run 'sleep 1.5'
    comes running && [ "$(said)" = 0 ]
    ok $? "${FUNCNAME[1]}: well again"
}

# has_ended STATUS: it did so; every device is free, and wall and lamp are as before the start.
has_ended() {
    [ "$1" = "$2" ]
    ok $? "${FUNCNAME[1]}: exit status $2, expected $1"
    vm_run '! pgrep wallwarp$ && ! gpioinfo wallwarp | grep -q wallwarp\" &&
        [ "$(cat /sys/class/watchdog/watchdog0/state)" = inactive ] &&
        ! ls -l /proc/[0-9]*/fd 2>/dev/null | grep -q " /dev/video0\$\| /dev/dri/card0\$"'
    ok $? "${FUNCNAME[1]}: devices are free"
    [ "$(wall before) $(lamp)" = "before 0" ]
    ok $? "${FUNCNAME[1]}: wall and lamp are as before the start"
}

# refused ROOM WORDS: the firmware ends before it has begun, with one line that has these words.
refused() {
    local said
    said=$(vm_run "/run/wallwarp /share/$1 --node 1 --can can0; echo \$?" 2>&1)
    [ "$(wc -l <<<"$said")" = 2 ] && [[ $said == "wallwarp: "*"$2"* ]]
    ok $? "$1: said \"$said\", expected one line with $2"
    has_ended 1 "${said##*$'\n'}"
}

test_refused_rooms() {
    refused none.yaml none.yaml
    sed s/corners_mm/corner_mm/ "$VM/share/room.yaml" >"$VM/share/typo.yaml"
    refused typo.yaml corner_mm
}

test_start() {
    heartbeats can1
    start_firmware room.yaml can0
    is waiting slow no_pose_yet
    [ "$(lamp)" = 1 ]
    ok $? "the lamp is on"
    mark
    start_poses can1 "$pose"
    comes running
    vm_screenshot "$VM/corrected.ppm"
    cmp -s "$VM/corrected.ppm" "$VM/no_pose_yet.ppm" || cmp -s "$VM/corrected.ppm" "$VM/before.ppm"
    [ $? = 1 ]
    ok $? "a picture that is no other"
    is_well 0
}

test_no_poses() {
    end poses >/dev/null
    is safe slow no_pose
    came holding
    ok $? "the last pose was held before"
    start_poses can1 "$pose"
    is_well $bus_fault
}

test_link() {
    vm_run 'ip link set can0 down; sleep 1.2'
    [ "$(led) $(wall no_pose)" = "slow no_pose" ]
    ok $? "link down: safe"
    vm_run 'ip link set can0 up'
    is_well $bus_fault
}

# On this wire the identifier decides nothing and no frame takes time, so that some poses are lost, and the others come.
test_flood() {
    vm_run 'cangen can1 -g 0 -I 0 -L 8 -p 10 -n 20000'
    ! came safe
    ok $? "flood: poses come"
    is_well $bus_fault
}

test_camera() {
    vm_run 'echo vivid.0 >/sys/bus/platform/drivers/vivid/unbind
        for try in 1 2 3 4 5 6 7 8 9 10; do rmmod vivid 2>/dev/null && exit; sleep 0.2; done; rmmod vivid'
    ok $? "the camera's module is removed"
    is fault fast no_video
    vm_run 'modprobe vivid'
    still_picture 4
    is_well $camera_fault
}

# libcamera's, which a firmware that lost it can't have back: it ends when the sensor is here again.
test_sensor() {
    sed 's/width: 320, height: 180/width: 318, height: 180/' "$VM/share/room.yaml" >"$VM/share/sensor.yaml"
    end firmware >/dev/null
    start_firmware sensor.yaml can0 '--camera libcamera:0'
    mark
    comes running
    ok $? "it runs with libcamera"
    vm_run 'echo vimc.0 >/sys/bus/platform/drivers/vimc/unbind'
    is fault fast no_video
    vm_run 'sleep 3; echo vimc.0 >/sys/bus/platform/drivers/vimc/bind
        for try in $(seq 300); do [ -s /share/firmware.status ] && exit; sleep 0.1; done; exit 1'
    ok $? "it ends by itself when the sensor is back; it said: $(cat "$VM/share/firmware")"
    has_ended 0 "$(cat "$VM/share/firmware.status")"
    vm_run 'rmmod vimc && modprobe vimc && udevadm settle'
    start_firmware sensor.yaml can0 '--camera libcamera:0'
    mark
    comes running
    ok $? "a new one has the sensor, and runs"
    has_ended 0 "$(end firmware)"
    start_firmware room.yaml can0
    mark
    comes running
}

# plug: a USB camera into the board; `end usb` pulls it out.
plug() {
    start usb 'chrt -f 60 /run/usb_camera /dev/gadget'
    vm_run 'try=0; while [ $((try += 1)) -le 50 ]; do
            grep -lxs "UVC Camera.*" /sys/class/video4linux/*/name && exit; sleep 0.1; done; exit 1'
    ok $? "the board sees a USB camera"
}

test_usb_camera() {
    mv "$VM/corrected.ppm" "$VM/kept.ppm"
    end firmware >/dev/null
    vm_run "cp /tree/$build/tests/board/virtual/usb_camera /run/; modprobe -a dummy_hcd gadgetfs uvcvideo
        mkdir /dev/gadget; mount -t gadgetfs gadget /dev/gadget"
    plug >/dev/null
    start_firmware room.yaml can0 "--camera 'v4l2:UVC Camera (1d6b:0104)'"
    mark
    comes running
    vm_screenshot "$VM/corrected.ppm"
    [ "$(wall no_video before kept)" = other ]
    ok $? "the wall has the USB camera's picture"
    end usb >/dev/null
    is fault fast no_video
    plug >/dev/null
    is_well $camera_fault
    end firmware >/dev/null
    end usb >/dev/null
    mv "$VM/kept.ppm" "$VM/corrected.ppm"
    start_firmware room.yaml can0
    mark
    comes running
}

# The wall is dark; a screenshot is then of what was last shown.
test_display() {
    local status='/sys/class/drm/card0-Virtual-1/status'
    vm_run "echo off >$status"
    is fault fast corrected
    vm_run "echo on >$status"
    is_well $display_fault
}

test_end() {
    has_ended 0 "$(end firmware)"
}

# SIGTERM while the strobe's line is high, which it is while a picture is made, by a method that takes long for it.
test_end_in_mid_frame() {
    start_firmware slow.yaml can0 '--kernels scalar'
    mark
    comes running
    cat >"$VM/share/mid_frame" <<'SCRIPT'
read -r firmware </share/firmware.pid
for try in {1..20000}; do
    read -r strobe <"$1"
    [ "$strobe" = 1 ] || continue
    kill -STOP "$firmware"
    read -r strobe <"$1"
    [ "$strobe" = 0 ] || kill -TERM "$firmware"
    kill -CONT "$firmware"
    [ "$strobe" = 0 ] || exit 0
done
exit 1
SCRIPT
    vm_run "taskset -c 0 bash /share/mid_frame $firmware_lines/sim_gpio1/value"
    ok $? "SIGTERM in mid-frame"
    has_ended 0 "$(end firmware)"
    end poses >/dev/null
    end heartbeats >/dev/null
}

# Nothing can be written to what the firmware says, and the controller is told to be bus-off, on a bus that has none.
test_full_disk_and_bus_off() {
    vm_run 'mkdir -p /full; mount -t tmpfs -o size=4k full /full; head -c 4096 /dev/zero >/full/log
        modprobe vcan; ip link add dev vcan0 type vcan; ip link set vcan0 up'
    heartbeats vcan0
    start firmware "exec 2>>/full/log; /run/wallwarp /share/room.yaml --node 1 --can vcan0"
    start_poses vcan0 "$pose"
    comes running
    mark
    vm_run 'cansend vcan0 20000040#0000000000000000; sleep 0.6; cansend vcan0 20000100#0000000000000000'
    is_well $((bus_fault | bus_off))
    test_camera
    [ "$(vm_run 'wc -c </full/log')" = 4096 ]
    ok $? "the disk is full"
    has_ended 0 "$(end firmware)"
    end poses >/dev/null
    end heartbeats >/dev/null
}

# watchdog ACTION: what it does to the board from now on.
watchdog() {
    vm_qmp set-action "{\"watchdog\": \"$1\"}" | grep -q '"return"'
}

# With a watchdog that only tells when it would have reset the board: how long a start takes here says nothing.
test_killed() {
    local off
    off=$(sed -n 's|^ExecStopPost=/usr/local/bin/wallwarp ||p' board/service/wallwarp.service)
    watchdog none
    ok $? "a watchdog that does nothing"
    heartbeats can1
    start_firmware room.yaml can0
    start_poses can1 "$pose"
    comes running
    vm_run 'kill -STOP $(cat /share/firmware.pid)'
    [ "$(wall corrected)" = corrected ]
    ok $? "a firmware that stands still keeps its picture"
    # Its pull in place of a board that keeps a line's level when its program has gone; the kernel notes what is set.
    vm_run "echo pull-up >$firmware_lines/sim_gpio3/pull; kill -KILL \$(cat /share/firmware.pid)"
    [ "$(end firmware) $(lamp)" = "137 1" ]
    ok $? "killed with the lamp on"
    vm_run 'sleep 3'
    vm_has_event WATCHDOG
    ok $? "the watchdog would reset the board"
    vm_run "cd /sys/kernel/tracing; echo >trace; /run/wallwarp $off
        lamp=\$((\$(cat \$(dirname \$(grep -lx wallwarp /sys/class/gpio/*/label))/base) + 3))
        grep -q \"gpio_value: \$lamp set 0\" trace && ! grep -q \"gpio_value: \$lamp set 1\" trace
        status=\$?; echo pull-down >$firmware_lines/sim_gpio3/pull; exit \$status"
    ok $? "$off drives the lamp's line low"
    start_firmware room.yaml can0
    mark
    is running on corrected
    has_ended 0 "$(end firmware)"
}

test_stopped() {
    watchdog reset
    ok $? "a watchdog that resets the board"
    start_firmware room.yaml can0
    mark
    comes running
    vm_run 'kill -STOP $(cat /share/firmware.pid); sleep 1000'
    [ $? = 125 ] && vm_has_event SHUTDOWN
    ok $? "a firmware that stands still is ended with its board by the watchdog"
}

trap vm_stop EXIT
firmware_board build/vm-faults || exit 1
sed 's/method: .*/method: none+nearest/' tests/board/virtual/picture_room.yaml >"$VM/share/room.yaml"
cp tests/board/virtual/picture_room.yaml "$VM/share/slow.yaml"
for reason in 'no pose yet' 'no pose' 'no video'; do
    "$host/tests/board/picture_tool" safe 320 240 1 front "$reason" >"$VM/${reason// /_}.ppm"
done
still_picture 4
vm_screenshot "$VM/before.ppm"
tests=${*:3}
for test in ${tests:-refused_rooms start no_poses link flood camera sensor usb_camera display end end_in_mid_frame full_disk_and_bus_off killed stopped}; do
    "test_$test"
done
ok_end
