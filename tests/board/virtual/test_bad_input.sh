#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# What people get wrong: each ends with status 1 and one line that says what and how to mend it, and leaves every device
# as it was, so that the firmware starts as soon as it is right. --check says the same beforehand, and changes nothing.
# usage: test_bad_input.sh BUILD
# shellcheck disable=SC2016 # the board expands what is in the commands
set -u
. tests/board/virtual/vm.sh
. tests/support/checks.sh
wallwarp=/run/wallwarp
wallwarp_of_rpi4=/tree/$1/tests/board/virtual/wallwarp_of_rpi4

# taken COMMAND CONDITION: another program takes a device; CONDITION is true when it has it. Its number is in /share/taker.
taken() {
    vm_run "$1 & echo \$! >/share/taker; until $2; do sleep 0.1; done"
    ok $? "\"$1\" has its device"
}

given_back() {
    vm_run 'kill $(cat /share/taker); while [ -e /proc/$(cat /share/taker) ]; do sleep 0.1; done'
}

# write_room NAME PICTURE_WIDTH PICTURE_HEIGHT PANEL_WIDTH PANEL_HEIGHT BUS
write_room() {
    cat >"$VM/share/$1" <<ROOM
camera: {width: $2, height: $3, focal_px: [600, 600], principal_px: [320, 180]}
boards:
  - name: wall
    node: 1
    method: none+nearest
    projector: {width: $4, height: $5}
    wall: {corners_mm: [[-2000, -1125, 0], [2000, -1125, 0], [2000, 1125, 0], [-2000, 1125, 0]]}
can: $6
ROOM
}

# Is every device as if nobody had had it? To be run on the board, where each program that starts takes its time.
free='case $(gpioinfo wallwarp) in *wallwarp\"*) false ;; *) read -r state </sys/class/watchdog/watchdog0/state &&
    [ "$state" = inactive ] ;; esac'

# said COMMAND: what it said on the board into $said, the last line but for those of this test into $last, its exit
# status into $status, and whether devices are free afterwards into $freed.
said() {
    said=$(vm_run "$1; echo \"status \$?\"; { $free; } && echo free" 2>&1)
    status=$(sed -n 's/^status //p' <<<"$said")
    freed=$(grep -cx free <<<"$said")
    last=$(grep -v '^status [0-9]*$\|^free$' <<<"$said" | tail -n 1)
}

# refused WHAT COMMAND WORDS...: it ends with status 1, its last line has these words, and devices are free.
refused() {
    local what=$1 command=$2 word said status freed last
    shift 2
    said "$command"
    [ "$status $freed" = '1 1' ]
    ok $? "$what: status $status, expected 1; devices free: $freed, expected 1; said: $said"
    for word in 'wallwarp: ' "$@"; do
        [[ $last == *"$word"* ]]
        ok $? "$what: said \"$last\", expected \"$word\" in it"
    done
}

# checked WHAT COMMAND WORDS...: --check says each in a line that begins with "missing", ends with 1, and frees all.
checked() {
    local what=$1 command=$2 word said status freed last
    shift 2
    said "$command"
    [ "$status $freed" = '1 1' ]
    ok $? "--check, $what: status $status, expected 1; devices free: $freed, expected 1; said: $said"
    for word in "$@"; do
        grep '^missing ' <<<"$said" | grep -qF -- "$word"
        ok $? "--check, $what: expected a missing thing with \"$word\"; said: $said"
    done
}

run="$wallwarp /share/room.yaml --node 1"

# Seen from the other end of the wire, the firmware says that it lives; then it is ended.
test_start() {
    local said status freed last
    said "$run >/share/run 2>&1 & firmware=\$!
        candump -n 1 can3,701:7FF >/share/heard; kill \$firmware; wait \$firmware"
    [ "$status $freed" = '0 1' ] && [ -s "$VM/share/heard" ]
    ok $? "$1: the firmware lives and ends on SIGTERM; status $status, free $freed; said: $(cat "$VM/share/run")"
}

# From when it says what it opens on, SIGTERM ends it as at any time. It comes while devices are opened when no heartbeat
# has been heard: soon, whatever this machine does meanwhile.
test_end_while_opening() {
    local said status freed last try
    for try in 1 2 3 4 5; do
        said "rm -f /run/said; mkfifo /run/said; candump -n 1 can3,701:7FF >/share/heard & candump=\$!
            $run 2>/run/said & firmware=\$!; exec 3</run/said; read -r line <&3; kill \$firmware; echo \"\$line\"
            cat <&3; wait \$firmware; ended=\$?; kill \$candump; (exit \$ended)"
        [ "$status $freed" = '0 1' ] || break
        [ -s "$VM/share/heard" ] || break
    done
    [ "$status $freed" = '0 1' ] && [[ $said == *'board "wall" on qemu-virt'* ]] && [ ! -s "$VM/share/heard" ]
    ok $? "SIGTERM while devices are opened: status $status, free $freed, $try tries; said: $said"
}

test_check_finds_all() {
    local said status freed last word
    said "$run --check"
    [ "$status $freed" = '0 1' ] && ! grep -q '^missing' <<<"$said"
    ok $? "--check of what is right: status $status, free $freed; said: $said"
    for word in 'room: /share/room.yaml' 'can can2: 500000 bit/s FD, data 2000000' 'vivid' 'Virtual-1' \
        'line 0 (LED)' 'line 3 (lamp)' 'i6300ESB' 'real-time priority' 'locked memory' 'CAP_NET_ADMIN' 'arch_sys_counter' \
        'machine: linux,dummy-virt'; do
        grep '^found\|^advice' <<<"$said" | grep -qF "$word"
        ok $? "--check finds $word; said: $said"
    done
}

test_board() {
    refused "another board's firmware" "$wallwarp_of_rpi4 /share/room.yaml --node 1" linux,dummy-virt \
        'board rpi4, expected brcm,bcm2711' 'install the firmware of this board'
    checked "another board's firmware" "$wallwarp_of_rpi4 --check" 'machine: found linux,dummy-virt'
    said=$(vm_run "$wallwarp --help" | tr -s ' \n' '  ')
    [[ $said == *'The bus is a CAN interface'*'v4l2:/dev/video0'*'HDMI-A-1'*', 2 bad usage.'* && $said != *127.0.0.1* ]]
    ok $? "--help tells of this board's devices: $said"
}

test_room() {
    refused "no room file" "$wallwarp /share/none.yaml --node 1" /share/none.yaml
    vm_run 'sed s/corners_mm/corner_mm/ /share/room.yaml >/share/typo.yaml'
    refused "a wrong room file" "$wallwarp /share/typo.yaml --node 1" /share/typo.yaml corner_mm
    refused "a wrong node" "$wallwarp /share/room.yaml --node 9" 'no board has node 9'
}

test_bus() {
    refused "no such bus" "$run --can can9" can9 'ip link'
    refused "a bus that is none" "$run --can lo" lo CAN
    vm_run 'ip link set can2 down'
    refused "a bus that is down" "$run" can2 'is down' 'ip link set can2 up'
    checked "a bus that is down" "$run --check" 'is down'
    vm_run 'ip link set can2 up txqueuelen 64 type can bitrate 250000 dbitrate 2000000 fd on restart-ms 100'
    refused "another bit rate" "$run" can2 250000 500000 'ip link set can2'
    checked "another bit rate" "$run --check" 250000
    vm_run 'ip link set can2 down; ip link set can2 up txqueuelen 64 type can bitrate 500000 fd off restart-ms 100'
    refused "a classic bus in a room with FD" "$run" can2 FD 'fd on'
    vm_run 'ip link set can2 down
        ip link set can2 up txqueuelen 64 type can bitrate 500000 dbitrate 2000000 fd on restart-ms 100'
}

test_camera() {
    refused "no such video device" "$run --camera v4l2:/dev/video99" video99
    checked "no such video device" "$run --check --camera v4l2:/dev/video99" video99
    refused "no such video name" "$run --camera v4l2:nonsense" nonsense
    refused "no source of video" "$run --camera nonsense" nonsense v4l2:
    refused "no such sensor" "$run --camera libcamera:nonsense" nonsense
    refused "a size that the camera has not" "$wallwarp /share/size.yaml --node 1" 642x362
    checked "a size that the camera has not" "$wallwarp --check /share/size.yaml --node 1" 642x362
    vm_run 'v4l2-ctl -d vivid --set-fmt-video=width=640,height=360 >/dev/null 2>&1
        rm -f /tmp/taken'
    taken 'v4l2-ctl -d /dev/video0 --stream-mmap --stream-to=/dev/null >/tmp/taken 2>&1' '[ -s /tmp/taken ]'
    refused "a camera that another program has" "$run --camera v4l2:/dev/video0" video0
    given_back
}

# The firmware goes on: it says what comes and what it expects, once, and takes pictures again when they are right.
test_camera_that_changes() {
    local said status freed last
    vm_run 'v4l2-ctl -d /dev/video0 -i 3 >/dev/null; v4l2-ctl -d /dev/video0 -c dv_timings_signal_mode=4
        v4l2-ctl -d /dev/video0 -c dv_timings=0'
    said "$wallwarp /share/hdmi.yaml --node 1 >/share/run 2>&1 & firmware=\$!
        says() { for try in \$(seq 100); do grep -q \"\$1\" /share/run && break; sleep 0.2; done; }
        candump -n 1 can3,701:7FF >/dev/null
        v4l2-ctl -d /dev/video0 -c dv_timings=2; says 720x480p
        v4l2-ctl -d /dev/video0 -c dv_timings=0; says again; kill \$firmware; wait \$firmware"
    [ "$status $freed" = '0 1' ] && [ "$(grep -c 'sends 720x480p, expected 640x480p' "$VM/share/run")" = 1 ] &&
        [ "$(grep -c 'delivers pictures again' "$VM/share/run")" = 1 ]
    ok $? "a camera that changes its size: status $status, free $freed; said: $(cat "$VM/share/run")"
    vm_run 'v4l2-ctl -d /dev/video0 -c dv_timings_signal_mode=0; v4l2-ctl -d /dev/video0 -i 0 >/dev/null'
}

test_display() {
    refused "no such connector" "$run --display HDMI-A-9" HDMI-A-9 Virtual-1
    checked "no such connector" "$run --check --display HDMI-A-9" HDMI-A-9
    refused "a mode that the projector has not" "$wallwarp /share/mode.yaml --node 1" 1234x568 1280x800
    checked "a mode that the projector has not" "$wallwarp --check /share/mode.yaml --node 1" 1234x568
    vm_run 'mountpoint -q /sys/kernel/debug || mount -t debugfs debug /sys/kernel/debug; mkfifo /tmp/enter'
    taken 'modetest -M virtio_gpu -s Virtual-1:640x480 <>/tmp/enter >/dev/null 2>&1' \
        'grep -q "^ *modetest .* y  *y " /sys/kernel/debug/dri/0/clients'
    refused "a display that another program has" "$run" card0 modetest
    checked "a display that another program has" "$run --check" modetest
    given_back
}

test_lines() {
    taken 'gpiomon wallwarp 2 >/dev/null 2>&1' 'gpioinfo wallwarp | grep -q gpiomon'
    refused "a line that another program has" "$run" wallwarp gpiomon
    checked "a line that another program has" "$run --check" gpiomon
    refused "outputs off while a line is taken" "$wallwarp --off" gpiomon
    given_back
    vm_run "$wallwarp --off"
    ok $? "--off"
}

# While another program has the watchdog, it is not free, whatever the firmware does.
test_watchdog() {
    local free=true
    taken 'busybox watchdog -F -T 60 -t 5 /dev/watchdog0 >/dev/null 2>&1' \
        'grep -qx active /sys/class/watchdog/watchdog0/state'
    refused "a watchdog that another program has" "$run" watchdog0
    checked "a watchdog that another program has" "$run --check" busybox
    given_back
}

test_rights() {
    local nobody='setpriv --reuid=65534 --regid=65534 --clear-groups --bounding-set=-all --inh-caps=-all'
    refused "no rights" "$nobody $run" realtime LimitRTPRIO
    checked "no rights" "$nobody $run --check" LimitRTPRIO LimitMEMLOCK 'usermod -aG video' 'usermod -aG gpio'
}

vm_use || exit 1
vm_run "cp /tree/$1/wallwarp /run/"
vm_in_memory $wallwarp
write_room room.yaml 640 360 640 480 '{bitrate: 500000, data_bitrate: 2000000, fd: true}'
write_room size.yaml 642 362 640 480 '{bitrate: 500000, data_bitrate: 2000000, fd: true}'
write_room hdmi.yaml 640 480 640 480 '{bitrate: 500000, data_bitrate: 2000000, fd: true}'
write_room mode.yaml 640 360 1234 568 '{bitrate: 500000, data_bitrate: 2000000, fd: true}'
vm_run 'ip link set can2 up txqueuelen 64 type can bitrate 500000 dbitrate 2000000 fd on restart-ms 100
    ip link set can3 up txqueuelen 64 type can bitrate 500000 dbitrate 2000000 fd on restart-ms 100'
test_start "at first"
test_check_finds_all
test_end_while_opening
test_board
test_room
test_bus
test_camera
test_camera_that_changes
test_display
test_lines
test_watchdog
test_rights
test_start "after all that was wrong"
vm_run 'ip link set can2 down; ip link set can3 down'
ok_end
