# shellcheck shell=bash
# shellcheck disable=SC2016,SC2034,SC2154 # the board expands what is in commands; variables of the script that sources this
# SPDX-License-Identifier: Apache-2.0
# The firmware on a virtual board of its own, and its display beside the simulator's picture, for tests to source after
# vm.sh. They set build and host, the folders of programs.
room=tests/board/virtual/picture_room.yaml

# picture_board FOLDER WIDTHxHEIGHT: a board with that display, the firmware in its memory, and both wires up: can0 and
# can1 classic, can2 and can3 with CAN FD.
picture_board() {
    vm_start "$1" -append "console=ttyAMA0 panic=-1 quiet video=Virtual-1:$2" || return
    vm_run "cp /tree/$build/wallwarp /run/
        for can in can0 can1; do ip link set \$can up txqueuelen 64 type can bitrate 500000 restart-ms 100; done
        for can in can2 can3; do
            ip link set \$can up txqueuelen 64 type can bitrate 500000 dbitrate 2000000 fd on restart-ms 100
        done"
    vm_in_memory /run/wallwarp
}

# set_pattern NUMBER: what vivid shows, standing still.
set_pattern() {
    vm_run "v4l2-ctl -d /dev/video0 -c test_pattern=$1,osd_text_mode=2,show_border=1,show_square=1"
}

# record_frame PATTERN: the camera's picture of it into $VM/PATTERN.png. False when it does not stand still.
record_frame() {
    set_pattern "$1"
    vm_run "for i in 1 2; do v4l2-ctl -d /dev/video0 --set-fmt-video=width=320,height=180,pixelformat=XR24 \
        --stream-mmap --stream-count=1 --stream-to=/share/$1.\$i >/dev/null 2>&1; done"
    cmp "$VM/share/$1.1" "$VM/share/$1.2" &&
        "$host/tests/board/picture_tool" png 320 180 "$VM/share/$1.1" "$VM/$1.png"
}

# set_vimc_pattern NUMBER: the same of the camera that libcamera has.
set_vimc_pattern() {
    vm_run 'sensor=$(dirname $(grep -lx "Sensor B" /sys/class/video4linux/v4l-subdev*/name))
        v4l2-ctl -d "/dev/${sensor##*/}" -c "test_pattern='"$1"',show_information=2"'
}

# record_vimc_frame PATTERN: as record_frame, into $VM/vimc-PATTERN.png, 318x180: vimc's widths are multiples of 6.
record_vimc_frame() {
    local recorded=$VM/share/vimc-$1.cam0-stream0-00000
    set_vimc_pattern "$1"
    vm_run "cam -c 1 -C2 -s width=318,height=180,pixelformat=RGB888 --file=/share/vimc-$1.# >/dev/null 2>&1"
    cmp "${recorded}0" "${recorded}1" &&
        "$host/tests/board/picture_tool" png 318 180 "${recorded}0" "$VM/vimc-$1.png"
}

# start_firmware SED_SCRIPT OPTION...: with the room as the script changes it.
start_firmware() {
    sed "$1" $room >"$VM/share/room.yaml"
    shift
    vm_run "rm -f /share/pid /share/status
        { /run/wallwarp /share/room.yaml --node 1 $* & echo \$! >/share/pid
            wait \$!; echo \$? >/share/status; } >/share/firmware 2>&1 &
        until [ -s /share/pid ]; do sleep 0.1; done"
}

# end_firmware: with SIGTERM. Its exit status is the firmware's.
end_firmware() {
    vm_run "kill \"\$(cat /share/pid)\"; until [ -s /share/status ]; do sleep 0.1; done; exit \"\$(cat /share/status)\""
}

# end PID_FILE: a program that was started.
end() {
    vm_run "kill \"\$(cat /share/$1)\"; while [ -e \"/proc/\$(cat /share/$1)\" ]; do sleep 0.1; done"
}

# want FRAME POSE fd|classic: the simulator's picture of that frame and of the pose as such frames carry it, into
# $VM/wanted.png. FRAME is as recorded: a pattern of vivid, or vimc-PATTERN.
want() {
    "$host/wallwarp-sim" warp "$VM/share/room.yaml" --board front --in "$VM/$1.png" --out "$VM/wanted.png" \
        --pose "$("$host/tests/board/picture_tool" pose "$2" "$3")"
}

# monitor BUS: what the firmware and the sender say on it.
monitor() {
    vm_run "/tree/$build/wallwarp-pose monitor --bus $1 --seconds 1.2"
}

# shows BUS METHOD: soon the display shows what is wanted, and again after the firmware has said that this is its method,
# and not a cheaper one. Says into $differences how much differs.
shows() {
    local i before=
    for ((i = 0; i < 20; i++)); do
        vm_screenshot "$VM/seen.ppm"
        if ! differences=$("$host/tests/board/picture_tool" differ "$VM/seen.ppm" "$VM/wanted.png"); then
            before=
        elif [ -n "$before" ]; then
            return 0
        else
            before=same
        fi
        monitor "$1" | grep -q "^ *1  running .* $2, step 0\$" || before=
    done
    monitor "$1"
    return 1
}
