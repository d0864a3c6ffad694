#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# What the firmware takes on the virtual board: time to its first picture, memory, heap, CPU of each stage, switches
# between threads, and from a pose on the wire to the flip. Ends with a table, also in build/test-board/measures.
# Usage, from the tree's root: test_measures.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
#
# shellcheck disable=SC2016 # the board expands what is in the commands
#
# Guest time: this board takes 1 ns for each instruction, whatever it is.
set -u
build=${1:?usage: test_measures.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/support/checks.sh
. tests/board/virtual/picture.sh
. tests/board/virtual/measure.sh

# write_room CAMERA_WIDTH CAMERA_HEIGHT PANEL_WIDTH PANEL_HEIGHT HZ METHOD
write_room() {
    sed "s/width: 320, height: 180/width: $1, height: $2/; s/width: 320, height: 240/width: $3, height: $4/
        s/method: .*/method: $6/; s/refresh_hz: .*/refresh_hz: $5}/" $room >"$VM/share/room.yaml"
}

# no_faults WHAT: not one of the board itself. Poses of a sender that was there before are no fault, nor are late pictures:
# the emulated display answers in this machine's time, and the board's own runs ahead meanwhile.
no_faults() {
    local flags said
    said=$(cat "$VM/share/firmware")
    flags=$(reported fault_flags)
    [ -n "$flags" ] && [ $((flags & ~(1 | 64))) = 0 ]
    ok $? "$1: fault flags $flags, expected none but 1 and 64; the firmware said: $said"
}

# heap_rows WHAT: our code took nothing; who else took what.
heap_rows() {
    local calls who object own=0
    while read -r calls who object; do
        row "$1: heap, ${who} ${object}" "$calls" calls
    done < <(heap_grown | sed 's/ (/_(/')
    own=$(heap_grown | awk '$NF == "wallwarp" { sum += $1 } END { print sum + 0 }')
    at_most "$1: heap, our code" "$own" calls 0
    grep -q ' wallwarp *$' "$VM/share/before.heap"
    ok $? "$1: what our code took at the start was counted"
}

memory_rows() {
    at_most "$1: growth of resident memory" "$(grown memory Rss:)" KB "$2"
    row "$1: resident memory" "$(awk '$1 == "Rss:" { print $2 }' "$VM/share/after.memory")" KB
    [ -s "$VM/share/before.memory" ] && [ -s "$VM/share/after.memory" ]
    ok $? "$1: memory was measured"
}

switch_rows() {
    local name waits pushed
    while IFS='|' read -r name waits pushed; do
        row "$1: $name waits" "$waits" "a frame"
        row "$1: $name is pushed aside" "$pushed" "a frame"
    done < <(switches "$2")
}

# 640x480, from start on.
test_start() {
    local what="640x480" mean worst made count stage
    write_room 640 360 640 480 60 gauss+linear
    measured --display Virtual-1
    trace 2
    moves "vivid, $what"
    measured_end
    at_most "$what: start to first corrected picture" \
        "$((($(reported corrected_us) - $(cat "$VM/share/started")) / 1000))" ms 2000
    for stage in pose warp show wait; do
        row "$what: stage $stage, mean" "$(reported ${stage}_mean_us)" us
        row "$what: stage $stage, worst" "$(reported ${stage}_worst_us)" us
    done
    at_most "$what: stages pose and warp, worst" "$(($(reported pose_worst_us) + $(reported warp_worst_us)))" us 16667
    row "$what: late pictures" "$(reported late)" ""
    row "$what: capture of pose to photon, as the board says" "$(reported photon_us)" us
    read -r mean worst made count < <(latencies)
    [ "${count:-0}" -gt 60 ]
    ok $? "$what: pictures traced: ${count:-0}, expected more than 60"
    row "$what: newest pose on the wire to flip done, mean" "$mean" ms
    row "$what: newest pose on the wire to flip done, worst" "$worst" ms
    row "$what: begin of step to flip done, mean" "$made" ms
    no_faults "$what"
}

# many WHAT SECONDS FRAMES KB OPTION...: so long, in which there must be so many frames and the camera's 500 pictures, and
# memory grows by KB at most.
many() {
    local what=$1 seconds=$2 expected=$3 kb=$4 frames pictures
    shift 4
    measured "$@"
    snapshot before
    vm_run 'kill $(cat /share/logger); candump -L can1,400:700,540:7C0,700:7C0 >/share/log & echo $! >/share/logger'
    vm_run -t 600 "sleep $seconds"
    snapshot after
    measured_end
    frames=$(reported frames)
    [ "${frames:-0}" -ge "$expected" ]
    ok $? "$what: $frames frames, expected $expected"
    row "$what: frames" "$frames" ""
    pictures=$(grown camera taken)
    [ "$pictures" -ge 500 ]
    ok $? "$what: $pictures pictures of the camera, expected 500"
    row "$what: pictures of the camera" "$pictures" ""
    memory_rows "$what" "$kb"
    heap_rows "$what"
    switch_rows "$what" "${frames:-1}"
    no_faults "$what"
}

test_many_frames() {
    write_room 320 180 64 48 121 none+nearest
    many "64x48, vivid" 90 10000 0
}

test_libcamera() {
    write_room 156 120 64 48 121 none+nearest
    many "64x48, libcamera" 20 1000 0 --camera libcamera:0
}

trap vm_stop EXIT
picture_board build/vm-measures 64x48@120 || exit 1 # which is made 121.06 Hz
vm_run "cp /tree/$build/tests/board/virtual/count_heap.so /run/"
tests=${*:3}
for test in ${tests:-start many_frames libcamera}; do
    "test_$test"
done
row "kernel" "$(vm_run 'uname -r')" ""
row "compiler" "$(aarch64-linux-gnu-gcc -dumpfullversion)" gcc
measures_end build/test-board/measures
ok_end
