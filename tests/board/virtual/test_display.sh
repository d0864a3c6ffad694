#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The display's contract on three drivers of the virtual board: virtio-gpu and bochs, which have no vertical blanks and
# are seen from outside, and vkms, which has them and is seen through its framebuffer. When blanks come and what is done
# between them is judged by the board's own time.
# Usage, from the tree's root: tests/board/virtual/test_display.sh BUILD_FOLDER_OF_THE_BOARD
set -u
build=${1:?usage: test_display.sh BUILD_FOLDER_OF_THE_BOARD}
. tests/board/virtual/vm.sh
. tests/support/checks.sh
probe=/run/probe_display
scanout=/run/probe_scanout

# see CARD FILE: what the card shows.
see() {
    case $1 in
    card0) vm_screenshot "$2" gpu ;;
    card1) vm_screenshot "$2" bochs ;;
    *) vm_run "$scanout /dev/dri/$1" >"$2" ;;
    esac
}

# said TEXT: the probe's output has such a last line, now or within two minutes.
said() {
    for ((i = 0; i < 1200; i++)); do
        [ "$(tail -n 1 "$VM/share/said")" = "$1" ] && return 0
        sleep 0.1
    done
    cat "$VM/share/said"
    return 1
}

# hold CARD SEED: show a picture until release.
hold() {
    vm_run "$probe hold $1:auto 640 480 60 $2 >/share/said 2>&1 & echo \$! >/share/probe" && said shown
}

release() {
    vm_run 'kill "$(cat /share/probe)"; while [ -e "/proc/$(cat /share/probe)" ]; do sleep 0.1; done'
}

# The kernel lights a display for its console, if it has one, when the first program has gone.
test_picture() {
    local seed
    hold "$1" 0
    release
    see "$1" "$VM/before.ppm"
    for seed in 1 2; do
        hold "$1" $seed
        ok $? "$1: a picture is shown"
        see "$1" "$VM/seen.ppm"
        vm_run "$probe picture 640 480 $seed" >"$VM/drawn.ppm"
        cmp "$VM/drawn.ppm" "$VM/seen.ppm"
        ok $? "$1: what is seen is what was drawn, byte for byte"
        release
    done
    see "$1" "$VM/after.ppm"
    cmp "$VM/before.ppm" "$VM/after.ppm"
    ok $? "$1: afterwards the display is as it was"
}

test_frames() {
    vm_run "$probe frames $1:auto 640 480 60 60"
    ok $? "$1: calls and blanks are as the contract says"
}

# Another program, no such mode, a wrong name: one line, exit status 1.
refuses() {
    local line
    line=$(vm_run "$probe hold $2 $3 60 1")
    [ $? -eq 1 ] && [[ $line =~ $4 ]] && [ "$(wc -l <<<"$line")" -eq 1 ]
    ok $? "$1: $line"
}

test_refusals() {
    hold card0 1
    refuses "the display is in use" card0:auto "640 480" 'card0 is in use by probe_display \(process [0-9]+\); end'
    release
    refuses "no such mode" card0:auto "1234 480" 'card0:Virtual-1: the projector offers no 1234x480 at 60.00 Hz; expected .*640x480|\.\.\.$'
    refuses "no such connector" HDMI-A-1 "640 480" 'no projector at HDMI-A-1 \(card0:Virtual-1 on, .*\); check cable'
    refuses "no such card" card9:auto "640 480" 'no /dev/dri/card9 with a connector'
    refuses "a wrong name" card1/x "640 480" 'found "card1/x", expected a connector'
}

test_cable() {
    local status="/sys/class/drm/$1-Virtual-*/status"
    hold "$1" 3
    vm_run "echo off >\$(echo $status)" && said dark
    ok $? "$1: a pulled cable is noticed"
    refuses "nothing is connected" "$1:auto" "640 480" 'no projector at any connector'
    vm_run "echo on >\$(echo $status)" && said lit
    ok $? "$1: the display comes back"
    see "$1" "$VM/seen.ppm"
    vm_run "$probe picture 640 480 3" >"$VM/drawn.ppm"
    cmp "$VM/drawn.ppm" "$VM/seen.ppm"
    ok $? "$1: with its picture"
    release
    vm_run "echo detect >\$(echo $status)"
}

vm_use || exit 1
vm_run "cp /tree/$build/tests/board/virtual/probe_display /tree/$build/tests/board/virtual/probe_scanout /run/"
vm_in_memory $probe $scanout
vm_run 'echo 0 >/sys/class/graphics/fbcon/cursor_blink; modprobe bochs; modprobe vkms; udevadm settle; ls /dev/dri/card0 /dev/dri/card1 /dev/dri/card2' >/dev/null
ok $? "there are three displays"
for card in card0 card1 card2; do
    test_picture $card
    test_frames $card
    test_cable $card
done
test_refusals
vm_run 'modprobe -r vkms && modprobe -r bochs && [ "$(ls -d /dev/dri/card*)" = /dev/dri/card0 ]'
ok $? "the others can be taken away again"
ok_end
