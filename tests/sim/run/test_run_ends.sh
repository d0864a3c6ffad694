#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# How runs begin and end: what an earlier run has left, a full disk behind stdout, lists without end, Ctrl-C, and bus
# addresses that are none.
# Usage, from the tree's root: tests/sim/run/test_run_ends.sh BUILD_FOLDER
set -u
build=${1:?usage: test_run_ends.sh BUILD_FOLDER}
. tests/sim/run/programs.sh

# Without gnuplot, so that every plot that is found is an earlier one.
run_without_plots() {
    "$build/wallwarp-sim" run "$scratch/fd.yaml" --video $picture --poses "$scratch/ten.csv" --frames 2 --judge 0 \
        --out "$1" >"$scratch/stdout" 2>"$scratch/stderr"
}

test_earlier_run() {
    out=$scratch/earlier
    run "$scratch/fd.yaml" --video $picture --poses "$scratch/ten.csv" --out "$out" \
        --original tests/images/studio_1920x1080.png
    check "the earlier run" $?
    # an eye that was seen late: the viewer's pictures do not begin at 0
    rm "$out/viewer_00000.png" "$out/uncompensated_00000.png"
    for name in notes.txt viewer.png front_1.png back_00000.png front_00099.png; do
        echo mine >"$out/$name"
    done
    echo "the earlier page" >"$out/index.html"
    (PATH=/nonexistent run_without_plots "$out")
    find "$out" -type f | sed 's|.*/||' | sort >"$scratch/found"
    sort >"$scratch/expected" <<END
back_00000.png
bus.log
frames.csv
front_00000.png
front_00001.png
front_00099.png
front_1.png
index.html
left_00000.png
left_00001.png
notes.txt
psnr.csv
timings.csv
uncompensated_00000.png
uncompensated_00001.png
viewer.png
viewer_00000.png
viewer_00001.png
END
    diff "$scratch/expected" "$scratch/found"
    check "a run deletes what an earlier one has left, and nothing else" $?
    [ "$(cat "$out/notes.txt" "$out/front_1.png" "$out/back_00000.png" "$out/front_00099.png" | sort -u)" = mine ]
    check "files that are not a run's are as they were" $?
    refuses 1 "missing.png" "$build/wallwarp-sim" run "$scratch/fd.yaml" --video "$scratch/missing.png" \
        --poses "$scratch/ten.csv" --out "$out"
    [ -e "$out/front_00001.png" ]
    check "a run that can't begin deletes nothing" $?
    rm "$out/viewer_00001.png" && mkdir "$out/viewer_00001.png"
    refuses 1 "viewer_00001.png: can't be deleted" "$build/wallwarp-sim" run "$scratch/fd.yaml" --video pattern \
        --poses "$scratch/one.csv" --out "$out"
}

# full PROGRAM ...: with stdout on a full disk it must end with 1 and say so.
full() {
    timeout 60 "$@" >/dev/full 2>"$scratch/stderr" </dev/null
    [ $? -eq 1 ] && grep -qF "stdout: cannot write the results" "$scratch/stderr"
    check "full disk: $*" $?
}

# What was made before a picture could not be written is told of.
test_failed_picture() {
    out=$scratch/failed
    mkdir -p "$out/front_00003.png"
    run "$scratch/fd.yaml" --video $picture --poses "$scratch/ten.csv" --out "$out"
    [ $? -eq 1 ] && grep -q 'wallwarp-sim run: .*front_00003.png: ' "$scratch/stderr"
    check "a picture that can't be written ends the run: $(cat "$scratch/stderr")" $?
    grep -q '^front ' "$scratch/stdout" && [ -s "$out/index.html" ] && grep -q '^2,.*,front,' "$out/frames.csv"
    check "the frames before it have their table and their page" $?
}

# A run must not delete the pictures that it is made of.
test_own_input() {
    out=$scratch/own
    mkdir "$out"
    cp $picture "$out/front_00000.png"
    refuses 1 "lies in the folder that the run writes to" "$build/wallwarp-sim" run "$scratch/fd.yaml" \
        --video "$out/front_%05d.png" --poses "$scratch/ten.csv" --out "$out"
    cmp -s $picture "$out/front_00000.png"
    check "the picture is still there" $?
}

test_full_stdout() {
    [ -w /dev/full ] || return 0
    full "$build/wallwarp-sim" run "$scratch/fd.yaml" --video pattern --poses "$scratch/one.csv" --out "$scratch/full"
    [ -s "$scratch/full/index.html" ] && [ -s "$scratch/full/bus.svg" ]
    check "the files are written all the same" $?
    full "$build/wallwarp-sim" run "$scratch/fd.yaml" --video pattern --bus 0 --frames 2 --out "$scratch/full"
    full "$build/wallwarp-sim" --help
}

test_endless_list() {
    printf 'time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.01,0,0,0,1,0,0,0\n10000000000,0,0,0,1,0,0,0\n' \
        >"$scratch/endless.csv"
    set -- "$build/wallwarp-sim" run "$scratch/fd.yaml" --video pattern --poses "$scratch/endless.csv"
    refuses 1 "endless.csv: lasts 10000000001 frames at 1 Hz, expected at most 1000000" "$@" --out "$scratch/never"
    refuses 1 "endless.csv: lasts" "$@" --rate 240 --out "$scratch/never"
    [ ! -e "$scratch/never" ]
    check "nothing is written for it" $?
    timeout 60 "$@" --frames 2 --out "$scratch/begun" >/dev/null 2>&1
    check "its beginning is made with --frames" $?
}

# Wait until a process catches SIGTERM; one that never does is killed.
wait_for_handler() {
    tries=0
    while [ $tries -lt 200 ]; do
        caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null)
        [ $((0x${caught:-0} >> 14 & 1)) -eq 1 ] && return 0
        sleep 0.05
        tries=$((tries + 1))
    done
    kill -KILL "$1"
    return 1
}

test_interrupted_run() {
    for signal in INT TERM; do
        out=$scratch/stopped_$signal
        "$build/wallwarp-sim" run "$scratch/fd.yaml" --video $picture --poses "$scratch/ten.csv" --frames 1000000 \
            --out "$out" >"$scratch/stdout" 2>"$scratch/stderr" &
        id=$!
        started="$started $id"
        wait_for_handler "$id" && sleep 0.3 && kill -$signal "$id"
        wait "$id"
        [ $? -eq 1 ]
        check "a run that is ended by SIG$signal has the status 1" $?
        frames=$(sed -n 's/^wallwarp-sim run: interrupted after \([0-9]*\) of 1000000 frames$/\1/p' "$scratch/stderr")
        [ -n "$frames" ] && [ "$(wc -l <"$out/frames.csv")" -eq $((1 + 2 * frames)) ]
        check "it says after how many frames" $?
        [ -s "$out/index.html" ] && grep -q "^page: $out/index.html" "$scratch/stdout"
        check "what was made is finished" $?
    done
}

test_interrupted_send() {
    printf 'time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0,9,0,0,1,0,0,0\n3600,0,0,0,1,0,0,0\n' \
        >"$scratch/slow.csv"
    "$build/wallwarp-sim" run "$scratch/classic.yaml" --video $picture --bus 0 --out "$scratch/live" \
        >"$scratch/live.out" 2>/dev/null &
    room=$!
    started="$started $room"
    port=$(port_in "$scratch/live.out")
    for signal in INT TERM; do
        "$build/wallwarp-pose" send --bus "127.0.0.1:$port" "$scratch/slow.csv" >"$scratch/stdout" \
            2>"$scratch/stderr" &
        id=$!
        started="$started $id"
        wait_for_handler "$id" && sleep 0.3 && kill -$signal "$id"
        wait "$id"
        [ $? -eq 1 ] && grep -q '^wallwarp-pose send: interrupted after [0-2] of 3 poses$' "$scratch/stderr"
        check "a sender that is ended by SIG$signal says so, and has the status 1" $?
    done
    kill -INT "$room"
    wait "$room"
    check "the live room ends with 0" $?
}

test_bad_addresses() {
    for bus in 127.0.0.1:99999 127.0.0.1:65536 127.0.0.1:0 127.0.0.1: :29536 127.0.0.1:x ::1:29536; do
        refuses 2 "1 to 65535" "$build/wallwarp-pose" send --bus "$bus" "$scratch/one.csv"
    done
    refuses 2 "can0" "$build/wallwarp-pose" send --bus "" "$scratch/one.csv"
    refuses 1 "no_such_can" "$build/wallwarp-pose" send --bus no_such_can "$scratch/one.csv"
}

test_earlier_run
test_failed_picture
test_own_input
test_full_stdout
test_endless_list
test_interrupted_run
test_interrupted_send
test_bad_addresses
finish
