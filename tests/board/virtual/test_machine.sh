#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The virtual board itself: it has the devices that other tests use, it can be seen and heard from outside.
# shellcheck disable=SC2016 # the board expands what is in the commands
set -u
. tests/board/virtual/vm.sh
. tests/support/checks.sh

# has WHAT COMMAND EXPECTED: the command's output has a line with the words expected.
has() {
    local said
    said=$(vm_run "$2")
    [[ $said == *"$3"* ]]
    ok $? "$1: expected \"$3\", found \"$said\""
}

test_root() {
    has "kernel" 'uname -srm' 'Linux 6.1'
    vm_run 'for tool in ip cansend candump isotpsend gpioset gpiomon v4l2-ctl cam modprobe udevadm; do
        command -v $tool >/dev/null || { echo "$tool is missing"; exit 1; }; done'
    ok $? "tools of the root"
    has "memory and CPUs" 'nproc' 2
    vm_run 'touch /tree/x' >/dev/null
    [ $? = 1 ]
    ok $? "the tree can not be written to"
    vm_run 'echo changed >/usr/bin/changed' && [ ! -e build/sysroot/usr/bin/changed ]
    ok $? "the root can, and the sysroot stays as it is"
    vm_run 'rm /usr/bin/changed'
}

# wire FIRST SECOND OPTIONS FRAME: what one sends, the other receives.
wire() {
    has "$1 to $2" "
        ip link set $1 up type can bitrate 500000 $3 && ip link set $2 up type can bitrate 500000 $3
        candump -n 1 $2 >/tmp/heard & until grep -q $2 /proc/net/can/rcvlist_all; do sleep 0.1; done; cansend $1 $4; wait; cat /tmp/heard
        ip link set $1 down; ip link set $2 down" "$5"
}

test_devices() {
    wire can0 can1 '' 123#0102 '123   [2]  01 02'
    wire can3 can2 'dbitrate 2000000 fd on' '123##1000102030405060708090A0B' '123  [12]  00 01 02 03 04 05 06 07 08 09 0A 0B'
    has "lines" gpiodetect '[wallwarp] (8 lines)'
    has "a line driven from outside" '
        echo pull-up >/sys/devices/platform/gpio-sim.0/gpiochip1/sim_gpio2/pull; gpioget wallwarp 2
        echo pull-down >/sys/devices/platform/gpio-sim.0/gpiochip1/sim_gpio2/pull' 1
    has "vivid" 'v4l2-ctl -d /dev/video0 --info' 'vivid'
    has "vimc" 'cam -l' "'Sensor B'"
    has "display" 'cat /sys/class/drm/card0-Virtual-1/status' connected
    has "watchdog" 'cat /sys/class/watchdog/watchdog0/identity' 'i6300ESB'
}

test_outside() {
    rm -f "$VM/picture.ppm"
    vm_screenshot "$VM/picture.ppm" && [ "$(head -n 3 "$VM/picture.ppm" | tr '\n' ' ')" = 'P6 1280 800 255 ' ]
    ok $? "screenshot"
    vm_screenshot /no/such/folder/picture.ppm 2>/dev/null
    [ $? = 1 ]
    ok $? "a screenshot that can not be written is an error"
    [[ $(vm_monitor 'info status') == *'running'* ]]
    ok $? "monitor"
}

test_jobs() {
    local said status first
    said=$(vm_run 'echo out; echo error >&2; exit 7')
    status=$?
    [ "$status $said" = $'7 out\nerror' ]
    ok $? "output and exit status: found $status, \"$said\""
    vm_run -t 1 'sleep 1000000'
    [ $? = 124 ]
    ok $? "a command that takes too long"
    vm_run 'while [ ! -e /share/go ]; do sleep 0.1; done; echo first' >"$VM/first" &
    first=$!
    vm_run 'touch /share/go'
    wait $first
    [ "$(cat "$VM/first")" = first ]
    ok $? "two commands at a time"
    vm_run 'sleep 0 & sleep 1 & echo $! >/share/orphan'
    vm_run 'while [ -e /proc/$(cat /share/orphan) ]; do sleep 0.1; done'
    ok $? "a process that lost its parent is buried"
}

vm_use || exit 1
test_root
test_devices
test_outside
test_jobs
ok_end
