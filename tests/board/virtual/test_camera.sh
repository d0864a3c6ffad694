#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Cameras through hal_camera.h: webcams and HDMI receivers (vivid), and libcamera (vimc), with all that goes wrong.
# usage: tests/board/virtual/test_camera.sh BUILD, from the tree's root
# shellcheck disable=SC2016 # the board expands what is in the commands
set -u
build=${1:?usage: test_camera.sh BUILD}
. tests/board/virtual/vm.sh
. tests/support/checks.sh
probe=/run/probe_camera
single=/dev/video20
multi=/dev/video21
hdmi=/dev/video22
# Sizes are small, as every instruction is emulated. Numbers of its menu of signals: 640x480p59 and 1280x720p24.
vga=0
hd=5

# A board of its own: others would miss their devices. Three of vivid's: a webcam, one with planes apart, an HDMI input.
load_vivid='modprobe vivid n_devs=3 num_inputs=1,1,1 input_types=0,0,3 node_types=0x1,0x1,0x1 multiplanar=1,2,1 \
    vid_cap_nr=20,21,22'

# control DEVICE NAME=VALUE...
control() {
    vm_run "v4l2-ctl -d $1 -c $2" >/dev/null
}

# start LOG NAME WIDTH HEIGHT RATE PICTURES [hold [SECONDS]]: the probe beside, with what it says in a file.
start() {
    local log=$1
    shift
    : >"$VM/share/$log"
    vm_run "{ $probe $(printf "'%s' " "${@:1:5}") ${7-1000000} ${6-}; echo status \$?; } >/share/$log 2>&1 &"
}

# awaits LOG TEXT [TIMES]: until the file has so many lines with it; false after two minutes.
awaits() {
    local i
    for ((i = 0; i < 1200; i++)); do
        [ "$(grep -cF -- "$2" "$VM/share/$1")" -ge "${3-1}" ] && return
        sleep 0.1
    done
    echo "$1 has not $2:"
    grep -v ^picture "$VM/share/$1"
    return 1
}

# said LOG TEXT TIMES: so many lines, no more and no less.
said() {
    local count
    count=$(grep -cF -- "$2" "$VM/share/$1")
    [ "$count" = "$3" ]
    ok $? "$1: \"$2\" $3 times, found $count"
}

# refused TEXT NAME WIDTH HEIGHT [RATE]: it can't be opened, for this reason, and that is said in one line.
refused() {
    local out
    out=$(vm_run "$probe '$2' $3 $4 ${5-60} 1 5; echo status \$?")
    [[ $out == *"camera $2: "*"$1"*$'\n'"status 2" ]] # libcamera may say its own before
    ok $? "$2 at $3x$4: expected \"$1\", found \"$out\""
}

# pixels DEVICE WIDTH HEIGHT [NAME=EXPECTED...]: format, matrix, row and middle of its pictures.
pixels() {
    local device=$1 size="$2 $3" out each i=0
    shift 3
    out=$(vm_run "v4l2-ctl -d $device -c test_pattern=7,osd_text_mode=2
        for name in ${*%%=*}; do $probe \$name $size 60 1 20 | tail -n 2 | sed -n 's/^picture .* age [0-9]* //p'; done")
    mapfile -t out <<<"$out"
    for each in "$@"; do
        [ "${out[i]-}" = "${each#*=}" ]
        ok $? "${each%%=*}: expected \"${each#*=}\", found \"${out[i]-}\""
        i=$((i + 1))
    done
}

# Pure red, which no two formats hold in the same bytes; vivid rounds its Y, U and V down.
test_formats() {
    local device
    for device in $single $multi; do
        pixels "$device" 320 180 "xrgb8888:v4l2:$device=xrgb8888 bt601 stride 1280 pixel 0000ff00" \
            "rgb888:v4l2:$device=rgb888 bt601 stride 960 pixel 0000ff" \
            "bgr888:v4l2:$device=bgr888 bt601 stride 960 pixel ff0000" \
            "yuyv:v4l2:$device=yuyv bt601 stride 640 pixel 515a51ef" \
            "uyvy:v4l2:$device=uyvy bt601 stride 640 pixel 5a51ef51" \
            "nv12:v4l2:$device=nv12 bt601 stride 320 pixel 51 5aef"
    done
    pixels $hdmi 1280 720 "v4l2:$hdmi=xrgb8888 bt709 stride 5120 pixel 0000ff00" \
        "yuyv:v4l2:$hdmi=yuyv bt709 stride 2560 pixel 3e663eef"
}

# even LOG KB BYTES: from the 20th picture on to the last all memory grew by KB at most, and the heap by BYTES.
even() {
    local end
    end=$(grep '^end' "$VM/share/$1")
    echo "$1: $end"
    awk -v kb="$2" -v bytes="$3" '/^end/ { even = $9 > 0 && $11 - $9 <= kb && $15 - $13 <= bytes } END { exit !even }' \
        <<<"$end"
    ok $? "memory of $1 grew"
}

# check_says ROOM TEXT...: wallwarp --check does, of the first camera of libcamera's.
check_says() {
    local out text
    out=$(vm_run "/tree/$build/wallwarp --check $1 --node 1 --camera libcamera:0")
    shift
    for text in "$@"; do
        [[ $out == *"$text"* ]]
        ok $? "--check: expected \"$text\", found \"$out\""
    done
}

test_many_pictures() {
    vm_run "$probe v4l2:$single 320 180 60 500 1000000 hold >/tmp/many; status=\$?; cp /tmp/many /share/; exit \$status"
    ok $? "500 pictures, four held at a time"
    even many 0 0
    [ "$(sed -n 's/^end .* full \([0-9]*\) .*/\1/p' "$VM/share/many")" -gt 400 ]
    ok $? "a fifth one is not given"
    awk '/^picture/ { if (n++ && ($2 <= before || $4 <= time)) exit 1; before = $2; time = $4 }' "$VM/share/many"
    ok $? "sequence and time grow"
    awk '/^picture/ && ($6 < 0 || $6 > 1000000) { exit 1 }' "$VM/share/many"
    ok $? "time is that of the picture"
}

test_refusals() {
    refused 'no capture device of that name is here' v4l2:nothing 640 360
    refused "can't open /dev/video63: No such file or directory; plug it in" v4l2:/dev/video63 640 360
    refused 'is no video device' v4l2:/dev/null 640 360
    refused '640x360 at nearest, expected 640x361 as the room file states' v4l2:$single 640 361
    refused 'is no HDMI receiver' v4l2:$single+/dev/v4l-subdev0 640 360
    refused 'no EDID can offer 1280x720 at 600/1 Hz' v4l2:$hdmi 1280 720 600
    vm_run "v4l2-ctl -d $single --stream-mmap >/share/other 2>&1 & while [ ! -s /share/other ]; do sleep 0.1; done"
    refused 'is used by another program' v4l2:$single 640 360
    vm_run 'kill $(pidof v4l2-ctl)'
    control $single quantization=1
    refused 'gives yuyv of full range, expected limited range' yuyv:v4l2:$single 640 360
    control $single quantization=0
}

# The source of an HDMI receiver: its EDID, no signal, unsteady, another size, right again, unplugged.
test_hdmi() {
    control $hdmi dv_timings_signal_mode=4
    control $hdmi dv_timings=$vga
    start hdmi v4l2:$hdmi 640 480 60 1000000
    awaits hdmi picture 10
    ok $? "pictures of the right signal"
    vm_run "v4l2-ctl -d $hdmi --get-edid=format=raw,file=/share/edid >/dev/null 2>&1"
    build/host/tests/hal/linux/print_edid 640 480 60 1 | cmp -n 128 - "$VM/share/edid" # the rest has vivid's address
    ok $? "the receiver shows the room's EDID"
    control $hdmi dv_timings_signal_mode=1
    awaits hdmi 'no HDMI signal'
    ok $? "no signal is told"
    control $hdmi dv_timings_signal_mode=2
    awaits hdmi 'the HDMI signal is unsteady'
    ok $? "an unsteady signal is told"
    control $hdmi dv_timings_signal_mode=0
    awaits hdmi 'delivers pictures again'
    ok $? "the same signal again"
    control $hdmi dv_timings_signal_mode=4
    control $hdmi dv_timings=$hd
    awaits hdmi 'the HDMI source sends 1280x720p, expected 640x480p as the room file states'
    ok $? "another size is told"
    sleep 2
    control $hdmi dv_timings=$vga
    awaits hdmi 'delivers pictures again' 2
    ok $? "right again"
    said hdmi 'the HDMI source sends' 1
    control $hdmi disconnect=1
    awaits hdmi 'is gone; plug it in again'
    ok $? "unplugged"
    awaits hdmi 'delivers pictures again' 3
    ok $? "back"
    said hdmi 'status io' 4 # and before the first picture
    vm_run 'kill $(pidof probe_camera)'
}

test_no_signal_at_start() {
    control $hdmi dv_timings_signal_mode=1
    start late v4l2:$hdmi 640 480 60 20
    awaits late 'no HDMI signal'
    ok $? "it opens without a signal"
    control $hdmi dv_timings_signal_mode=4
    control $hdmi dv_timings=$vga
    awaits late 'status 0'
    ok $? "pictures come with it"
    said late 'end pictures 20 ' 1
}

# The device goes while some of its pictures are held, and its module too; it comes back by its name with another number.
test_module_back() {
    start module v4l2:vivid-000-vid-cap 320 180 60 1000000 hold
    awaits module picture 40
    ok $? "found by its name"
    vm_run 'for i in 0 1 2; do echo vivid.$i >/sys/bus/platform/drivers/vivid/unbind; done 2>/dev/null; true'
    awaits module 'is gone; plug it in again'
    ok $? "gone"
    vm_run 'for i in 1 2 3 4 5 6 7 8 9 10; do rmmod vivid 2>/dev/null && exit; sleep 0.5; done; rmmod vivid'
    ok $? "nothing of the device is held, though pictures are"
    awaits module 'no capture device of that name is here'
    ok $? "absent"
    vm_run "${load_vivid/=20,21,22/=30,31,32}"
    awaits module 'delivers pictures again'
    ok $? "back under another number"
    said module 'is gone' 1
    said module 'no capture device' 1
    vm_run 'kill $(pidof probe_camera); while pidof probe_camera; do sleep 0.1; done; rmmod vivid'
    vm_run "$load_vivid"
}

test_libcamera() {
    start vimc libcamera:0 48 48 30 100 hold # the smallest of its sizes
    awaits vimc 'status 0'
    ok $? "100 pictures of vimc"
    even vimc 64 4096 # the library's own heap breathes
    said vimc ' rgb888 bt601 stride 144 ' 100
    refused 'of 636x480 at nearest, expected 640x480 as the room file states' libcamera:0 640 480
    refused 'is not among the 1 cameras here' libcamera:1 48 48
    refused 'gives none of the formats that are wanted' nv12:libcamera:0 48 48
    check_says /tree/tests/board/virtual/picture_room.yaml 'found    camera: libcamera:0, Sensor B, "platform/vimc.0 Sensor B"' \
        'missing  camera: libcamera:0 gives bgr888 of 318x180 at nearest, expected 320x180'
    sed 's/320, height: 180/318, height: 180/' tests/board/virtual/picture_room.yaml >"$VM/share/room.yaml"
    check_says /share/room.yaml 'found    camera: libcamera:0 gives rgb888 of 318x180'
    : >"$VM/share/cam"
    vm_run 'cam -c 1 -C1000000 -s width=48,height=48 >/share/cam 2>&1 &'
    awaits cam fps
    # libcamera does not list a camera whose links another program holds.
    refused 'is not among the 0 cameras here; plug it in, end other programs' 'libcamera:platform/vimc.0 Sensor B' 48 48
    check_says /share/room.yaml 'is held by cam (process '
    vm_run 'kill -KILL $(pidof cam)'
}

# What libcamera can't have back in one process, a new one has; the old one ends in order when it is here again.
test_libcamera_gone() {
    start gone libcamera:0 48 48 30 1000000 hold
    awaits gone picture 20
    ok $? "pictures before"
    vm_run 'echo vimc.0 >/sys/bus/platform/drivers/vimc/unbind'
    awaits gone "is gone, and libcamera can't have it back"
    ok $? "gone is told"
    vm_run 'sleep 2; pidof probe_camera >/dev/null'
    ok $? "the program waits"
    vm_run 'echo vimc.0 >/sys/bus/platform/drivers/vimc/bind; udevadm settle'
    awaits gone 'is back; this program ends'
    ok $? "back is told"
    awaits gone 'status 143'
    ok $? "the program ends by SIGTERM, and not by libcamera"
    said gone 'is gone' 1
    said gone 'is back' 1
    vm_run 'rmmod vimc && modprobe vimc && udevadm settle && sleep 1'
    ok $? "it holds nothing of the camera's"
    start again libcamera:0 48 48 30 10
    awaits again 'status 0'
    ok $? "a new program has it again"
}

vm_start "${VM_SHARED:-build/vm}-camera" || exit 1
trap vm_stop EXIT
vm_run "cp /tree/$build/tests/board/virtual/probe_camera $probe; rmmod vivid; $load_vivid" && vm_in_memory $probe || exit 1
tests=${*:2}
for test in ${tests:-formats many_pictures refusals hdmi no_signal_at_start module_back libcamera libcamera_gone}; do
    "test_$test"
done
ok_end
