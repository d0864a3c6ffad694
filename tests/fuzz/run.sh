#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Run the fuzzers one after the other and say what they found; what they learn is kept for the next run.
#
# usage: tests/fuzz/run.sh BUILD SECONDS [TARGET...]     from the tree's root; each target runs that long
#
# BUILD/corpus/TARGET has the inputs that are worth keeping, BUILD/crashes those that broke something. To see one again:
# BUILD/tests/fuzz/TARGET BUILD/crashes/FILE
set -u
build=$1 seconds=$2
shift 2
if [ $# = 0 ]; then
    set -- tests/fuzz/fuzz_*.c
    set -- "${@#tests/fuzz/}"
    set -- "${@%.c}"
fi

# A picture turned by 45 degrees: the numbers of a homography.
turned='\47\0\0\0\0\152\251\0\0\0\0\152\1\0\51\0\0\0\0\152\1\47\0\0\0\0\152\256\0\0\0\0\0\72'

# The tree's own files to begin with; few formats have none here.
seed() {
    case $1 in
    fuzz_room)
        cp sim/demo/room.yaml tests/oracle/*.yaml tests/firmware/room/bad_rooms/*.yaml "$2"
        options='method: area\n    border: [1, 2, 3]\n    step: all\n    markers: [{px: [5, 6], mm: [0, 0, 0]}]'
        sed "s/^    node: 1$/&\n    $options\n    ls_weights: {x: [1], y: [1, 2]}/; s/\[-2400, 0, 2400\]/null/" \
            sim/demo/room.yaml >"$2/options.yaml"
        ;;
    fuzz_board_config)
        cp board/service/wallwarp.yaml "$2"
        printf 'node: 1\nroom: r\nkey: /k\ncan: can1\ncamera: "v4l2:A b"\ndisplay: auto\nworkers: 4\n' >"$2/each.yaml"
        ;;
    fuzz_png)
        for picture in tests/images/*.png; do
            head -c 3000 "$picture" >"$2/$(basename "$picture")"
        done
        ;;
    fuzz_y4m)
        for space in mono 420jpeg 422 444; do
            printf 'YUV4MPEG2 W2 H2 F25:1 Ip A1:1 C%s XCOLORRANGE=FULL\nFRAME\nabcdefghijkl' "$space" >"$2/$space.y4m"
        done
        printf 'YUV4MPEG2 W3 H1\nFRAME\nabcdefgFRAME Ip\nabcdefg' >"$2/two_frames.y4m"
        ;;
    fuzz_socketcand)
        printf '\364< open can0 >\364< rawmode >\375\100\364< send 123 8 1 2 3 4 5 6 7 8 >\364\375\100\374' >"$2/send"
        printf '< echo >< send 1FFFFFFF 0 >\364\365\1\2\0\0\2\11\12< open can1 >\377\100\376' >"$2/wrong"
        ;;
    fuzz_pose_text)
        head -n 20 sim/demo/walk.csv >"$2/walk.csv"
        printf -- '-1.5e3 0 -2000.000001 0.99 0.1 -.05 +0' >"$2/pose"
        ;;
    fuzz_warp)
        # Every method, through lenses of 20, 70 and 4300 pixels: footprints grow with them.
        for method in $(seq 0 20); do
            for lens in '\0' '\33\0\0\0\3' '\44\0\0\0\0\1'; do
                # shellcheck disable=SC2059 # the octal bytes are for printf to read
                {
                    printf "\\0\\167\\$(printf %o "$method")"
                    head -c 18 /dev/zero
                    printf "$lens\\0$lens"
                } >"$2/$method-${#lens}"
            done
        done
        # Every method on a panel of 3 x 3 tiles, gray or in colour: a picture turned by 45 degrees and twice as dense as
        # the panel, and one 5.5 times as dense. Tiles read across its edges, and more than is copied at once.
        dense='\53\0\0\0\0\200\4\0\0\0\53\0\0\0\0\200\4'
        for method in $(seq 0 20); do
            # shellcheck disable=SC2059
            {
                printf "\\$((14 + method % 2))\\167\\$(printf %o "$method")\\351\\351\\26\\351$turned" >"$2/$method-turned"
                printf "\\$((15 - method % 2))\\167\\$(printf %o "$method")\\351\\351\\26\\351$dense" >"$2/$method-dense"
            }
        done
        ;;
    fuzz_transform)
        cp sim/trackers/examples/*.yaml "$2"
        sed 's/^    body: 1/&\n    turn_deg: [1, -2.5, 90]/; $a unit: in\nlatency_ms: 5\ntracker: 3' \
            sim/trackers/examples/freed.yaml >"$2/all_keys.yaml"
        ;;
    fuzz_trackers)
        # A byte for the protocol, and 200 as the highest bit where a checksum is to be made; then the packet's length.
        zeros() { head -c "$1" /dev/zero; }
        body='[1 0 0 0 1 0 0 0 1]'
        sample='{"protocol":{"name":"OpenTrackIO","version":[1,0,1]},"sourceNumber":1,"timing":{"sampleTimestamp":'
        sample+='{"seconds":5,"nanoseconds":6}},"transforms":[{"translation":{"x":1,"y":2.5,"z":-3},"rotation":'
        sample+='{"pan":90,"tilt":30,"roll":0},"scale":{"x":1,"y":1,"z":1}}]}'
        { printf '\200\35\0\321\1\55\0\0\17\0\0\370\200\0\0\372\0\376\14\0\1'; zeros 11; } >"$2/freed"
        printf '\1\0\1fr 1\r\nts 5.5\r\n6d 1 [1 1.0][1 2 3 0 0 0]%s\r\n' "$body" >"$2/dtrack"
        printf '\1\0\1fr 1\n6di 2 [0 1 2.5][1 2 3]%s [1 0 0][0 0 0][0 0 0 0 0 0 0 0 0]\n' "$body" >"$2/dtrack_6di"
        {
            printf '\2\104\0\125\147\100\200\0\0\14\0'
            zeros 8
            printf '\2\0\1\1\1\0\54\200\1\0\50\200'
            printf '\0\0\14\0\0\0\200\77\0\0\0\100\0\0\100\300\2\0\14\0'
            zeros 12
            printf '\3\0\4\0\0\0\200\77'
        } >"$2/psn"
        printf '\203\377\377OTrk\0\1\0\1\0\0\0\0\200\0\0\0%s' "$sample" >"$2/json"
        printf '\203\74\0OTrk\0\1\0\1\0\0\0\0\0\0\0\0%s' "${sample:0:44}" >"$2/segments"
        printf 'OTrk\0\1\0\2\0\0\0\54\200\0\0\0%s' "${sample:44}" >>"$2/segments"
        {
            printf '\203\377\377OTrk\0\2\0\1\0\0\0\0\200\0\0\0'
            printf '\243\150protocol\242\144name\153OpenTrackIO'
            printf '\147version\203\1\0\1\154sourceNumber\1\152transforms\237\277\153translation\243\141x\371\76\0'
            printf '\141y\41\141z\0\150rotation\243\143pan\30\132\144tilt\0\144roll\372\0\0\0\0\377\377'
        } >"$2/cbor"
        { printf '\4\60\0/pose\0\0\0,fffffff'; zeros 16; printf '\77\200'; zeros 14; } >"$2/osc"
        {
            printf '\4\0\1#bundle\0\0\0\0\5\200\0\0\0\0\0\0\64/pose/1\0,fffffffi\0\0\0\0'
            zeros 11
            printf '\77\200'
            zeros 13
            printf '\2'
        } >"$2/osc_bundle"
        ;;
    fuzz_commands)
        # Each a whole request: 0, its length less 1, its bytes.
        printf '\0\0\1\0\6\6reboot\0\4\7\0\0\0\0\0\5\2area\0\1\3\1\0\1\4\1\0\4\5\1\2\0\0' >"$2/each"
        printf '\0\16\2kaiser+nearest\0\2\2ls\0\0\2' >"$2/methods"
        ;;
    fuzz_formats)
        # Every method, from every format to every format: of one colour and of many, as it comes and turned, and
        # on a panel of odd height.
        for method in $(seq 0 20); do
            for format in $(seq 0 6); do
                panel=$(((method + format) % 7))
                # shellcheck disable=SC2059
                {
                    name=$2/$method-$format
                    printf "\\0\\0\\$(printf %o "$method")\\$format\\0\\1\\5" >"$name-xrgb"
                    printf "\\0\\167\\$(printf %o "$method")\\$format\\6\\2\\3" >"$name-nv12"
                    printf "\\6\\167\\$(printf %o "$method")\\$format\\4\\3\\4\\351\\351\\26\\351$turned" >"$name-yuyv"
                    printf "\\16\\167\\$(printf %o "$method")\\$format\\$panel\\1\\2\\351\\351\\27\\351$turned" >"$name-odd"
                }
            done
        done
        ;;
    *) printf '\0' >"$2/zero" ;;
    esac
}

passed=0 failed=0
mkdir -p "$build/crashes" "$build/fuzz-logs"
for target in "$@"; do
    corpus=$build/corpus/$target seeds=$build/seeds/$target log=$build/fuzz-logs/$target.log
    mkdir -p "$corpus" "$seeds"
    seed "$target" "$seeds"
    printf '%-20s %4s s ... ' "$target" "$seconds"
    "$build/tests/fuzz/$target" -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=2500 -len_control=0 \
        -print_final_stats=1 -artifact_prefix="$build/crashes/$target-" "$corpus" "$seeds" >"$log" 2>&1
    status=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: //p' "$log")
    reached=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
    if [ "$status" = 0 ] && [ "${runs:-0}" -gt 0 ]; then
        passed=$((passed + 1))
        echo "$runs runs, $reached places reached"
    else
        failed=$((failed + 1))
        echo "FAILED, exit status $status"
        grep -E '^BROKEN|ERROR: |runtime error: |^SUMMARY|Test unit written' "$log" || tail -n 20 "$log"
        echo "--- $log"
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
