#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-sim, wallwarp and wallwarp-pose from end to end: what they write, and every bad command line.
# Usage, from the tree's root: tests/sim/run/test_programs.sh BUILD_FOLDER
set -u
build=${1:?usage: test_programs.sh BUILD_FOLDER}
. tests/sim/run/programs.sh

# same_as_warp DIR FRAME BOARD [OPTION ...]: the run's picture is the one wallwarp-sim warp makes for the pose used.
same_as_warp() {
    dir=$1
    frame=$2
    board=$3
    shift 3
    pose=$(awk -F, -v n="$frame" -v b="$board" '$1 == n && $3 == b { print $5 }' "$dir/frames.csv")
    [ -n "$pose" ] && "$build/wallwarp-sim" warp "$scratch/fd.yaml" --board "$board" --pose "$pose" --in $picture \
        --out "$scratch/warp.png" "$@" && cmp "$scratch/warp.png" "$dir/${board}_$(printf %05d "$frame").png"
}

test_virtual_runs() {
    for kind in fd classic; do
        out=$scratch/$kind
        run "$scratch/$kind.yaml" --video $picture --poses "$scratch/ten.csv" --out "$out"
        check "$kind run" $?
        set -- "$out"/front_0000?.png "$out"/left_0000?.png "$out"/viewer_0000?.png "$out"/uncompensated_0000?.png
        [ $# -eq 40 ]
        check "$kind run writes every picture" $?
        [ "$(grep -c ,running, "$out/frames.csv")" -eq 20 ]
        check "$kind run is running in every frame" $?
        awk -F, 'NR > 1 { split($5, p, " "); if (p[1] != -900 + 37.25 * $1) bad = 1 } END { exit bad || NR != 21 }' \
            "$out/frames.csv"
        check "$kind run: frame n uses pose n" $?
        for frame in 0 4 9; do
            same_as_warp "$out" "$frame" front && same_as_warp "$out" "$frame" left --kernels scalar
            check "$kind run: frame $frame is what warp makes" $?
        done
        awk -F, 'NR > 1 && !($3 > 15 && $3 <= $4 && $4 < 60 && $5 == "") { bad = 1 } END { exit bad || NR < 9 }' \
            "$out/psnr.csv"
        check "$kind run: PSNR is below its limit" $?
        for file in index.html psnr.svg step.svg time.svg bus.svg; do
            [ -s "$out/$file" ]
            check "$kind run writes $file" $?
        done
        grep -q "^page: $out/index.html" "$scratch/stdout"
        check "$kind run prints the page's path" $?
    done
    [ "$(grep -c ' can0 100##1' "$scratch/fd/bus.log")" -eq 10 ]
    check "the log has a pose frame for each pose" $?
    [ "$(grep -c ' can0 11[012]#' "$scratch/classic/bus.log")" -eq 30 ]
    check "the log has three frames for each pose set" $?
}

test_repeated_run() {
    run "$scratch/fd.yaml" --video $picture --poses "$scratch/ten.csv" --out "$scratch/again"
    same=0
    for path in "$scratch"/fd/*.png "$scratch"/fd/frames.csv "$scratch"/fd/psnr.csv "$scratch"/fd/bus.log; do
        cmp "$path" "$scratch/again/${path##*/}" || same=1
    done
    check "two runs write the same bytes" $same
    run "$scratch/fd.yaml" --video pattern --poses "$scratch/ten.csv" --out "$scratch/again/" --frames 2
    cmp -s "$scratch/fd/front_00000.png" "$scratch/again/front_00000.png"
    [ $? -eq 1 ] && [ "$(wc -l <"$scratch/again/frames.csv")" -eq 5 ]
    check "a folder that is not empty is written over" $?
}

test_options() {
    run "$scratch/fd.yaml" --video $picture --poses "$scratch/one.csv" --out "$scratch/one/deep" --judge 0 &&
        [ -e "$scratch/one/deep/front_00000.png" ] && [ ! -e "$scratch/one/deep/front_00001.png" ] &&
        [ "$(wc -l <"$scratch/one/deep/psnr.csv")" -eq 1 ]
    check "a single pose makes one frame, --judge 0 judges none" $?
    run "$scratch/fd.yaml" --video $picture --poses "$scratch/ten.csv" --out "$scratch/fast" --rate 60 --frames 84 \
        --method none+nearest --original tests/images/studio_1920x1080.png --judge 9
    check "rate, frames, method, original, judge" $?
    same_as_warp "$scratch/fast" 8 front --method none+nearest --kernels neon
    check "--method is every board's" $?
    awk -F, '$1 == 83 { print $4 }' "$scratch/fast/frames.csv" | grep -q safe &&
        awk -F, '$1 == 40 { print $4 }' "$scratch/fast/frames.csv" | grep -q holding
    check "a run beyond the list holds, then goes safe" $?
    awk -F, 'NR > 1 && !($5 > 10 && $5 <= $6) { bad = 1 } END { exit bad || NR < 5 }' "$scratch/fast/psnr.csv"
    check "PSNR against the original is below its limit" $?
    for format in nv12 yuyv; do
        for display in xrgb8888 $format; do
            run "$scratch/fd.yaml" --video $picture --poses "$scratch/one.csv" --out "$scratch/$format-$display" \
                --camera "$format" --display "$display"
            check "a camera of $format, a display of $display" $?
            awk -F, 'NR > 1 && !($3 > 15 && $3 <= $4) { bad = 1 } END { exit bad || NR < 2 }' \
                "$scratch/$format-$display/psnr.csv"
            check "they show the picture" $?
        done
        cmp "$scratch/$format-xrgb8888/front_00000.png" "$scratch/$format-$format/front_00000.png"
        check "luma and chroma of $format become the same on the way to the display, and in it" $?
        cmp -s "$scratch/fd/front_00000.png" "$scratch/$format-$format/front_00000.png"
        [ $? -eq 1 ]
        check "but not what a camera of xrgb8888 shows" $?
    done
    (PATH=/nonexistent run_without_path)
    check "without gnuplot: an error that names its package, and the page all the same" $?
}

run_without_path() {
    "$build/wallwarp-sim" run "$scratch/fd.yaml" --video $picture --poses "$scratch/one.csv" --out "$scratch/bare" \
        >"$scratch/stdout" 2>"$scratch/stderr"
    found=$?
    [ $found -eq 1 ] && [ -s "$scratch/bare/index.html" ] &&
        while read -r line; do case $line in *gnuplot-nox*) return 0 ;; esac; done <"$scratch/stderr"
    return 1
}

# The list has 30 Hz and lasts 0.3 s.
test_refresh_rate() {
    { cat "$scratch/classic.yaml" && echo "frames: {refresh_hz: 59.94}"; } >"$scratch/video.yaml"
    run "$scratch/video.yaml" --video pattern --poses "$scratch/ten.csv" --out "$scratch/rate" &&
        grep -q "^18 frames at 59.94 Hz in virtual time" "$scratch/stdout"
    check "a run has the room's refresh rate" $?
    run "$scratch/video.yaml" --video pattern --poses "$scratch/ten.csv" --out "$scratch/rate" --rate 50 &&
        grep -q "^16 frames at 50 Hz in virtual time" "$scratch/stdout"
    check "--rate is in its place" $?
    run "$scratch/video.yaml" --video pattern --poses "$scratch/ten.csv" --out "$scratch/rate" --genlock -50,2 &&
        grep -q "^house signal: nobody leads at the end; no board that led had it" "$scratch/stdout"
    check "a run too short for a leader says so of its house signal" $?
    run "$scratch/video.yaml" --video pattern --bus 0 --frames 2 --out "$scratch/rate" &&
        grep -q "^2 frames at 59.94 Hz in real time" "$scratch/stdout"
    check "a live run has the room's refresh rate" $?
}

test_live_run() {
    "$build/wallwarp-sim" run "$scratch/classic.yaml" --video $picture --bus 0 --out "$scratch/live" \
        >"$scratch/live.out" 2>"$scratch/live.err" &
    id=$!
    started="$started $id"
    port=$(port_in "$scratch/live.out")
    check "a live run tells its port" $?
    refuses 1 "$port" "$build/wallwarp-sim" run "$scratch/fd.yaml" --video pattern --bus "$port" --out "$scratch/no"
    timeout 60 "$build/wallwarp-pose" send --bus "127.0.0.1:$port" "$scratch/ten.csv"
    check "poses are sent into it" $?
    sleep 0.3
    kill -INT "$id"
    wait "$id"
    check "it ends well on SIGINT" $?
    frame=$(awk -F, '$4 == "running" { n = $1 } END { print n }' "$scratch/live/frames.csv")
    awk -F, -v n="$frame" '$1 == n { print $5 }' "$scratch/live/frames.csv" | grep -q '^-564\.75'
    check "the boards have used the last pose" $?
    same_as_warp "$scratch/live" "$frame" front && same_as_warp "$scratch/live" "$frame" left
    check "they show it" $?
    [ -s "$scratch/live/index.html" ] && grep -q ',waiting,,' "$scratch/live/frames.csv"
    check "the page is written, and the boards have waited before" $?
    run "$scratch/classic.yaml" --video pattern --bus 0 --frames 5 --out "$scratch/five" &&
        [ "$(wc -l <"$scratch/five/frames.csv")" -eq 11 ]
    check "a live run ends after its frames" $?
}

test_firmware() {
    "$build/wallwarp" "$scratch/classic.yaml" --node 1 --can 0 --camera nv12:$picture --display "nv12:$scratch/display" \
        --workers 2 2>"$scratch/wallwarp.err" &
    id=$!
    started="$started $id"
    port=$(port_in "$scratch/wallwarp.err")
    check "wallwarp opens its bus" $?
    refuses 1 "$port" "$build/wallwarp" "$scratch/classic.yaml" --node 2 --can "$port"
    timeout 60 "$build/wallwarp-pose" send --bus "127.0.0.1:$port" "$scratch/one.csv"
    check "it takes a pose" $?
    sleep 1.5
    kill -TERM "$id"
    wait "$id"
    check "it ends well on SIGTERM" $?
    [ -s "$scratch/display/display.png" ]
    check "it writes what it shows" $?
    refuses 2 "ROOM" "$build/wallwarp"
    refuses 2 "--node" "$build/wallwarp" "$scratch/fd.yaml"
    refuses 2 "1 to 63" "$build/wallwarp" "$scratch/fd.yaml" --node 64
    refuses 2 "1 to 63" "$build/wallwarp" "$scratch/fd.yaml" --node 1x
    refuses 2 "scalar or neon" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --kernels sse
    refuses 2 "1 to 4" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --workers 5
    refuses 2 "one room file" "$build/wallwarp" "$scratch/fd.yaml" "$scratch/fd.yaml" --node 1
    refuses 1 "no board has node 9, expected one of 1, 2" "$build/wallwarp" "$scratch/fd.yaml" --node 9
    refuses 1 "missing.yaml" "$build/wallwarp" "$scratch/missing.yaml" --node 1
    refuses 1 "missing.png" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --can 0 --camera "$scratch/missing.png"
    refuses 1 "port" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --can vcan0
    refuses 1 "folder" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --can 0 --display "$scratch/fd.yaml/x"
    refuses 1 "is not a folder" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --can 0 --display "$scratch/fd.yaml"
    refuses 1 "expected xrgb8888, nv12 or yuyv" "$build/wallwarp" "$scratch/fd.yaml" --node 1 --can 0 --display uyvy:none
}

test_bad_runs() {
    set -- "$build/wallwarp-sim" run "$scratch/fd.yaml" --out "$scratch/bad"
    refuses 2 "expected run, update or warp" "$build/wallwarp-sim" runs
    refuses 2 "Usage" "$build/wallwarp-sim"
    refuses 2 "scalar or neon" "$@" --kernels NEON
    refuses 2 "--video" "$@" --poses "$scratch/ten.csv"
    refuses 2 "either --poses CSV or --bus PORT" "$@" --video pattern
    refuses 2 "either --poses CSV or --bus PORT" "$@" --video pattern --poses "$scratch/ten.csv" --bus 0
    refuses 2 "0 to 65535" "$@" --video pattern --bus 65536
    refuses 2 "--frames" "$@" --video pattern --poses "$scratch/ten.csv" --frames 0
    refuses 2 "--frames" "$@" --video pattern --poses "$scratch/ten.csv" --frames 3.5
    refuses 2 "mean+cubic" "$@" --video pattern --poses "$scratch/ten.csv" --method best
    for rate in nan 0.999 240.1; do
        refuses 2 "--rate: found \"$rate\", expected 1 to 240 Hz" "$@" --video pattern --poses "$scratch/ten.csv" \
            --rate $rate
    done
    for genlock in x 1001 '0,' 0,64 0,1x; do
        refuses 2 "--genlock: found \"$genlock\"" "$@" --video pattern --poses "$scratch/ten.csv" --genlock "$genlock"
    done
    refuses 1 "no board has node 9" "$@" --video pattern --poses "$scratch/ten.csv" --genlock 0,9
    refuses 2 "one room file" "$@" "$scratch/fd.yaml" --video pattern --poses "$scratch/ten.csv"
    refuses 2 "--nonsense" "$@" --nonsense
    refuses 2 "--camera: found \"gray8\"" "$@" --video pattern --poses "$scratch/ten.csv" --camera gray8
    refuses 2 "--display: found \"nv\"" "$@" --video pattern --poses "$scratch/ten.csv" --display nv
    refuses 1 "expected xrgb8888, nv12 or yuyv" "$@" --video pattern --poses "$scratch/one.csv" --display rgb888
    refuses 1 "missing.csv" "$@" --video pattern --poses "$scratch/missing.csv"
    refuses 1 "missing.png" "$@" --video "$scratch/missing.png" --poses "$scratch/ten.csv"
    refuses 1 "480" "$@" --video tests/images/coffee_510x290.png --poses "$scratch/ten.csv"
    refuses 1 "ten.csv" "$@" --video "$scratch/ten.csv" --poses "$scratch/ten.csv"
    refuses 1 "multiple" "$@" --video pattern --poses "$scratch/one.csv" --original tests/images/coffee_510x290.png
    refuses 1 "qw qx qy qz" "$@" --video pattern --poses "$scratch/zero.csv"
    refuses 1 "folder" "$build/wallwarp-sim" run "$scratch/fd.yaml" --video pattern --poses "$scratch/one.csv" \
        --out "$scratch/fd.yaml"
    refuses 1 "folder" "$build/wallwarp-sim" run "$scratch/fd.yaml" --video pattern --poses "$scratch/one.csv" \
        --out "$scratch/fd.yaml/deeper"
    refuses 1 "missing.yaml" "$build/wallwarp-sim" run "$scratch/missing.yaml" --video pattern \
        --poses "$scratch/one.csv" --out "$scratch/bad"
    [ ! -e "$scratch/bad" ]
    check "nothing is written for a run that can't begin" $?
}

test_bad_warps() {
    set -- "$build/wallwarp-sim" warp "$scratch/fd.yaml" --out "$scratch/bad.png"
    refuses 2 "--board" "$@" --pose "0 0 0 1 0 0 0" --in $picture
    refuses 2 "left" "$@" --board back --pose "0 0 0 1 0 0 0" --in $picture
    refuses 2 "pose" "$@" --board front --pose "0 0 0 1 0 0" --in $picture
    refuses 2 "nan" "$@" --board front --pose "0 0 nan 1 0 0 0" --in $picture
    refuses 2 "mean+cubic" "$@" --board front --pose "0 0 0 1 0 0 0" --in $picture --method x
    refuses 1 "480" "$@" --board front --pose "0 0 0 1 0 0 0" --in tests/images/coffee_510x290.png
    refuses 1 "missing.png" "$@" --board front --pose "0 0 0 1 0 0 0" --in "$scratch/missing.png"
    [ ! -e "$scratch/bad.png" ]
    check "no picture is written after an error" $?
    "$build/wallwarp-sim" warp "$scratch/fd.yaml" --board front --pose "-50 0 -100 1 0 0 0" --in $picture \
        --out "$scratch/minus.png"
    check "a pose may begin with a minus sign" $?
    for program in "wallwarp" "wallwarp-sim" "wallwarp-sim run" "wallwarp-sim warp"; do
        # shellcheck disable=SC2086 # a program and its command are two words
        "$build"/$program --help >"$scratch/stdout" && grep -q Usage "$scratch/stdout"
        check "$program --help" $?
    done
}

printf 'time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n0,0,0,0,0,0,0,0\n' >"$scratch/zero.csv"
test_virtual_runs
test_repeated_run
test_options
test_refresh_rate
test_live_run
test_firmware
test_bad_runs
test_bad_warps
finish
