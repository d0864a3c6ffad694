# shellcheck shell=bash
# shellcheck disable=SC2016,SC2154 # the board expands what is in commands; variables of the script that sources this
# SPDX-License-Identifier: Apache-2.0
# What the firmware takes on a virtual board, for test_measures.sh to source after picture.sh.
table=$(mktemp)

# row WHAT VALUE UNIT: a line of the table that measures_end prints.
row() {
    printf '%-58s %12s %s\n' "$1" "$2" "$3" >>"$table"
}

# at_most WHAT VALUE UNIT LIMIT: the same, and a test.
at_most() {
    row "$1" "$2" "$3"
    awk -v value="$2" -v limit="$4" 'BEGIN { exit !(value != "" && value + 0 <= limit) }'
    ok $? "$1: $2 $3, expected at most $4"
}

# measured OPTION...: the firmware, its takings from the heap and the pictures that it takes from its camera counted, with
# poses from can1 and a log of what it says. Returns when all is settled: some pictures have been taken.
measured() {
    vm_run 'mountpoint -q /sys/kernel/tracing || mount -t tracefs trace /sys/kernel/tracing
        cd /sys/kernel/tracing/events/v4l2/v4l2_dqbuf
        echo !hist:keys=minor >trigger 2>/dev/null; echo hist:keys=minor >trigger'
    vm_run "candump -L can1,400:700,540:7C0,700:7C0 >/share/log & echo \$! >/share/logger
        /tree/$build/wallwarp-pose send --bus can1 still --rate 60 --at '0 -1200 -800 0.9375 0 0.34375 0' \
            --seconds 3600 >/dev/null 2>&1 & echo \$! >/share/sender
        sleep 0.5; date +%s%6N >/share/started
        HEAP_COUNTS=/tmp/heap LD_PRELOAD=/run/count_heap.so \
            /run/wallwarp /share/room.yaml --node 1 --can can0 $* >/share/firmware 2>&1 & echo \$! >/share/pid"
    vm_run 'try=0; while [ $((try += 1)) -le 300 ] &&
            [ "$(sed -n "s/^ *Hits: //p" /sys/kernel/tracing/events/v4l2/v4l2_dqbuf/hist)" -lt 50 ]; do
            sleep 0.2
        done
        sleep 5'
}

measured_end() {
    end pid
    end sender
    end logger
    "$host/tests/board/wire_tool" reports <"$VM/share/log" >"$VM/reports"
}

# reported NAME: of the last run.
reported() {
    sed -n "s/^$1 //p" "$VM/reports"
}

# snapshot NAME: memory, threads and heap of the firmware now, and the camera's pictures until now.
snapshot() {
    vm_run "process=/proc/\$(cat /share/pid); cat \$process/task/*/status >/share/$1.tasks
        tr '\\0' '\\n' </tmp/heap | grep . | sort -k2n >/share/$1.heap; cat \$process/smaps_rollup >/share/$1.memory
        sed -n 's/^ *Hits: /taken /p' /sys/kernel/tracing/events/v4l2/v4l2_dqbuf/hist >/share/$1.camera"
}

# grown FILE_ENDING KEY: of the process between snapshots before and after, summed over its lines.
grown() {
    awk -v key="$2" '$1 == key { sum += FILENAME ~ /after/ ? $2 : -$2 } END { print sum + 0 }' \
        "$VM/share/before.$1" "$VM/share/after.$1"
}

# heap_grown: calls between the snapshots for each thread and object that had any: CALLS THREAD OBJECT.
heap_grown() {
    awk 'FILENAME ~ /before/ { before[$2 $NF] = $1; next }
        $1 - before[$2 $NF] > 0 { print $1 - before[$2 $NF], $3 " (" $2 ")", $NF }' \
        "$VM/share/before.heap" "$VM/share/after.heap"
}

# switches FRAMES: for each thread, how often it waited and how often it was pushed aside, a frame.
switches() {
    awk -v frames="$1" '$1 == "Name:" { name = $2 } $1 == "Pid:" { name = name " (" $2 ")" }
        /^voluntary/ { waits[name] += FILENAME ~ /after/ ? $2 : -$2 }
        /^nonvoluntary/ { pushed[name] += FILENAME ~ /after/ ? $2 : -$2 }
        END { for (n in waits) printf "%s|%.2f|%.3f\n", n, waits[n] / frames, pushed[n] / frames }' \
        "$VM/share/before.tasks" "$VM/share/after.tasks" | sort
}

# trace SECONDS: the kernel's events of the sender's frames, of the strobe, and of flips that are done.
trace() {
    vm_run "mountpoint -q /sys/kernel/debug || mount -t debugfs debug /sys/kernel/debug
        cd /sys/kernel/tracing && echo mono >trace_clock && echo 'name == \"can1\"' >events/net/net_dev_xmit/filter
        sed -n 's/.*GPIOs \\([0-9]*\\)-.* wallwarp,.*/\\1/p' /sys/kernel/debug/gpio >/share/first_line
        for event in net/net_dev_xmit gpio/gpio_value drm/drm_vblank_event_delivered; do echo 1 >events/\$event/enable; done
        sleep $1
        for event in net/net_dev_xmit gpio/gpio_value drm/drm_vblank_event_delivered; do echo 0 >events/\$event/enable; done
        cat trace >/share/trace; echo >trace"
}

# latencies: of the trace's pictures, from the newest frame on the wire before the strobe went up, ms: until the flip is
# done, mean and worst; and of that from the strobe on, mean.
latencies() {
    awk -v strobe="$(($(cat "$VM/share/first_line") + 1))" '
        match($0, / [0-9]+\.[0-9]+: /) { time = substr($0, RSTART + 1, RLENGTH - 3) * 1000 }
        / net_dev_xmit: / { sent = time }
        / gpio_value: / && $0 ~ " " strobe " set 1$" { began = time; newest = sent }
        / drm_vblank_event_delivered: / && newest > 0 {
            took = time - newest; sum += took; made += time - began; count++
            if (took > worst) worst = took
            newest = 0
        }
        END { if (count > 0) printf "%.2f %.2f %.2f %d\n", sum / count, worst, made / count, count }' "$VM/share/trace"
}

# moves WHAT: does the wall's picture change with the camera's?
moves() {
    vm_screenshot "$VM/first.ppm"
    vm_run 'sleep 0.3'
    vm_screenshot "$VM/second.ppm"
    ! cmp -s "$VM/first.ppm" "$VM/second.ppm"
    ok $? "$1: the wall's picture changes with the camera's"
}

# The table, on stdout and in FILE.
measures_end() {
    mkdir -p "$(dirname "$1")"
    mv "$table" "$1"
    cat "$1"
}
