# shellcheck shell=bash disable=SC2016,SC2154
# SPDX-License-Identifier: Apache-2.0
# The firmware on a virtual board and what is seen of it from outside, for scripts to source after vm.sh.
#
#   firmware_board FOLDER       a board whose buses are can0 and can1, with the firmware in its memory; its display has the
#                               room's size
#   start NAME COMMAND          on the board; what it says is in $VM/share/NAME
#   end NAME                    ends it, if it has not ended, and prints its exit status
#   start_firmware ROOM BUS [OPTIONS]   that of the folder $build, in /run, with a room file of /share; NAME is firmware
#   start_poses BUS POSE        NAME is poses
#   still_picture PATTERN       the camera's, of vivid's menu
#   heartbeats BUS              they are noted from now on
#   mark                        said, came and comes are about heartbeats from now on
#   comes STATE                 the newest heartbeat soon has this state
#   came STATE                  some heartbeat had it
#   said                        prints the faults that heartbeats named, as a number, but for late pictures: the emulated
#                               display answers in this machine's time, and the board's own runs ahead meanwhile
#   led                         prints what it does, in the words of STATES.md
#   wall NAME...                prints which of the pictures $VM/NAME.ppm the display shows
#   lamp                        prints the level of its line
firmware_deadline=64 # of Heartbeat's faults
firmware_states=(waiting running holding safe fault frozen pattern)
firmware_lines=/sys/devices/platform/gpio-sim.0/gpiochip1

firmware_board() {
    vm_start "$1" -append 'console=ttyAMA0 panic=-1 quiet vt.global_cursor_default=0 video=Virtual-1:320x240@24' || return 1
    vm_run "cp /tree/$build/wallwarp /run/
        for can in can0 can1; do ip link set \$can up type can bitrate 500000 restart-ms 100; done" || return 1
    vm_in_memory /run/wallwarp
}

start() {
    vm_run "rm -f /share/$1.*
        { $2 >/share/$1 2>&1 & echo \$! >/share/$1.pid; wait \$!; echo \$? >/share/$1.status; } >/dev/null 2>&1 &
        while [ ! -s /share/$1.pid ]; do sleep 0.05; done"
}

end() {
    vm_run "kill \$(cat /share/$1.pid) 2>/dev/null; while [ ! -s /share/$1.status ]; do sleep 0.05; done
        cat /share/$1.status"
}

start_firmware() {
    start firmware "/run/wallwarp /share/$1 --node 1 --can $2 ${3-}"
}

start_poses() {
    start poses "/tree/$build/wallwarp-pose send --bus $1 still --rate 30 --at '$2' --seconds 3600"
}

still_picture() {
    vm_run "v4l2-ctl -d /dev/video0 -c test_pattern=$1,osd_text_mode=2,show_border=1,show_square=1"
}

heartbeats() {
    start heartbeats "candump -L $1,701:7FF"
    mark
}

mark() {
    firmware_mark=$(wc -l <"$VM/share/heartbeats")
}

# The signals of Heartbeat in wallwarp.dbc: state in bits 12 to 15, faults from bit 32 on.
firmware_heard() {
    tail -n "+$((firmware_mark + 1))" "$VM/share/heartbeats" | sed -n 's/.*#//p' | grep -x '[0-9A-F]\{16\}'
}

comes() {
    local i state
    for ((i = 0; i < 1200; i++)); do
        state=$(firmware_heard | tail -n 1)
        [ -n "$state" ] && [ "${firmware_states[16#${state:2:1}]}" = "$1" ] && return
        sleep 0.1
    done
    echo "heartbeats since the mark:"
    firmware_heard | tail -n 5
    return 1
}

came() {
    local i
    for i in "${!firmware_states[@]}"; do
        [ "${firmware_states[i]}" = "$1" ] && firmware_heard | grep -q "^..$i" && return
    done
    return 1
}

said() {
    local heard faults=0
    for heard in $(firmware_heard); do
        faults=$((faults | 16#${heard:10:2}${heard:8:2}))
    done
    echo $((faults & ~firmware_deadline))
}

# The kernel notes each set of its line, which is one for each picture; the first line of the answer is its number.
led() {
    vm_run "mountpoint -q /sys/kernel/tracing || mount -t tracefs trace /sys/kernel/tracing
        cd /sys/kernel/tracing; cat \$(dirname \$(grep -lx wallwarp /sys/class/gpio/*/label))/base
        echo 1 >events/gpio/gpio_value/enable; echo >trace; sleep 1; cat trace" |
        awk 'NR == 1 { led = "gpio_value: " $1 " "; next }
            index($0, led) { edges += n++ && $NF != level; level = $NF }
            END { print !n ? "kept" : !edges ? level ? "on" : "off" : edges <= 2 ? "gaps" : edges <= 5 ? "slow" : "fast" }'
}

wall() {
    local name
    vm_screenshot "$VM/seen.ppm"
    for name in "$@"; do
        cmp -s "$VM/seen.ppm" "$VM/$name.ppm" && echo "$name" && return
    done
    echo other
}

lamp() {
    vm_run "cat $firmware_lines/sim_gpio3/value"
}
