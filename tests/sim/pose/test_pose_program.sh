#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# wallwarp-pose from end to end: its motions and its bridge into a running simulation, and every bad command line.
# Usage, from the tree's root: tests/sim/pose/test_pose_program.sh BUILD_FOLDER
set -u
build=${1:?usage: test_pose_program.sh BUILD_FOLDER}
. tests/sim/run/programs.sh
pose=$build/wallwarp-pose
examples=sim/trackers/examples

# Start a live simulation that writes into $scratch/$1; its port is in $port.
start_room() {
    "$build/wallwarp-sim" run "$scratch/classic.yaml" --video pattern --bus 0 --out "$scratch/$1" >"$scratch/$1.out" \
        2>"$scratch/$1.err" &
    room=$!
    started="$started $room"
    port=$(port_in "$scratch/$1.out")
}

# The newest pose that the boards have used.
last_pose() { awk -F, '$4 ~ /running|holding/ { pose = $5 } END { print pose }' "$scratch/$1/frames.csv"; }

test_motions() {
    start_room motion
    timeout 60 "$pose" send --bus "127.0.0.1:$port" walk --rate 100 --seconds 0.5 --at "-100 0 -500 1 0 0 0" \
        >"$scratch/stdout"
    check "a motion is sent" $?
    grep -q '^50 poses sent' "$scratch/stdout"
    check "it is as long as asked for" $?
    timeout 60 "$pose" send --bus "127.0.0.1:$port" noise --seed 3 --seconds 0.1 --viewer 1 >"$scratch/stdout" &&
        grep -q '^24 poses sent' "$scratch/stdout"
    check "poses of another viewer are sent" $?
    sleep 0.2
    kill -INT $room
    wait $room
    # after 0.49 s of the walk: 1 m x sin(0.686) to the right
    case $(last_pose motion) in
    533.*) true ;;
    *) false ;;
    esac
    check "the boards have used the walk's last pose, and none of the other viewer" $?
}

# Bridge a packet's bytes, as printf writes them, into a new room; the pose then used begins with the text.
bridges() {
    start_room "$1"
    "$pose" bridge "$1" --bus "127.0.0.1:$port" --transform $examples/"$1".yaml --listen 127.0.0.1:0 \
        >"$scratch/$1.bridged" 2>"$scratch/$1.listens" &
    bridge=$!
    started="$started $bridge"
    tries=0
    until grep -qs ' on 127.0.0.1:' "$scratch/$1.listens" || [ $((tries += 1)) -gt 200 ]; do sleep 0.05; done
    udp=$(sed -n 's/.*:\([0-9]*\)$/\1/p' "$scratch/$1.listens")
    # shellcheck disable=SC2059 # the octal bytes are for printf to read; cat makes one packet of them
    printf "$2" >"$scratch/packet"
    cat "$scratch/packet" >"/dev/udp/127.0.0.1/$udp" && printf 'damaged' >"/dev/udp/127.0.0.1/$udp"
    sleep 0.5
    kill -INT $bridge
    wait $bridge
    check "$1: the bridge ends well on SIGINT" $?
    grep -q '^2 packets, 1 poses sent to 127.0.0.1:' "$scratch/$1.bridged"
    check "$1: it has sent the pose" $?
    [ "$(wc -l <"$scratch/$1.bridged")" -eq 2 ]
    check "$1: it says what was wrong with the other packet" $?
    kill -INT $room
    wait $room
    case $(last_pose "$1") in
    "$3"*) true ;;
    *) echo "$1: the pose is $(last_pose "$1")" && false ;;
    esac
    check "$1: the boards have used it" $?
}

test_bridges() {
    sample='{"protocol":{"name":"OpenTrackIO","version":[1,0,1]},"sourceNumber":14,"transforms":[{"translation":'
    sample+='{"x":1,"y":0.5,"z":1.5},"rotation":{"pan":0,"tilt":-10,"roll":0}}]}'
    zeros='\0\0\0\0\0\0\0\0\0\0\0\0'
    # camera 1 looks straight; x 1000 mm (00FA00), y -500 (FF8300), height 200 (003200)
    bridges freed "\\321\\1\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\372\\0\\377\\203\\0\\0\\62\\0\\0\\0\\0\\0\\0\\0\\0\\0\\300" \
        "1000.000000 -80.000000 -920.000000 "
    bridges dtrack 'fr 1\r\nts 5.5\r\n6d 1 [0 1.0][326.85 -187.22 109.5 0 0 0][1 0 0 0 1 0 0 0 1]\r\n' \
        "326.850000 187.220000 -109.500000 "
    # tracker 7 at 1, 2, -3 m; the eye is 100 mm below it and 50 ahead
    psn="\\125\\147\\70\\200\\0\\0\\14\\0\\0\\0\\0\\0\\0\\0\\0\\0\\2\\0\\1\\1\\1\\0\\44\\200\\7\\0\\40\\200"
    psn+="\\0\\0\\14\\0\\0\\0\\200\\77\\0\\0\\0\\100\\0\\0\\100\\300\\2\\0\\14\\0$zeros"
    bridges psn "$psn" "1000.000000 -1900.000000 -2950.000000 "
    # source 14 at 1, 0.5, 1.5 m, looking 10 degrees down
    bridges opentrackio "OTrk\\0\\1\\0\\1\\0\\0\\0\\0\\200\\247\\351\\120$sample" "1000.000000 -1500.000000 500.000000 "
    # at 100, 0, 0 cm
    bridges osc "/pose\\0\\0\\0,fffffff\\0\\0\\0\\0\\102\\310\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\77\\200\\0\\0$zeros" \
        "1000.000000 0.000000 0.000000 "
}

test_bad_sends() {
    refuses 2 "a command is missing" "$pose"
    refuses 2 "no such command: 'bring', expected send, bridge, " "$pose" bring
    set -- "$pose" send --bus 127.0.0.1:1
    refuses 2 "--bus is missing" "$pose" send walk
    refuses 2 "the pose list or the motion is missing" "$@"
    refuses 2 "one pose list expected" "$@" walk orbit
    refuses 2 "0.1 to 2000" "$@" walk --rate 0
    refuses 2 "0.1 to 2000" "$@" walk --rate nan
    refuses 2 "0 to 3600" "$@" walk --seconds 3601
    refuses 2 "0 to 3" "$@" walk --viewer 4
    refuses 2 "0 to 15" "$@" walk --tracker 16
    refuses 2 "expected --fd" "$@" walk --tracker 1
    refuses 2 "--fd" "$@" walk --fd
    refuses 2 "--seed" "$@" noise --seed x
    refuses 2 "7 numbers" "$@" still --at "1 2 3"
    refuses 2 "--rate: a pose list has its own" "$@" "$scratch/ten.csv" --rate 5
    refuses 2 "--at: a pose list has its own" "$@" "$scratch/ten.csv" --at "0 0 0 1 0 0 0"
    refuses 1 "missing.csv" "$@" "$scratch/missing.csv"
    refuses 1 "expected a pose list, or still, walk, orbit or noise; jump: cannot read" "$@" jump
    refuses 1 "farther than 83.886 m" "$@" still --at "90000 0 0 1 0 0 0"
}

test_bad_bridges() {
    set -- "$pose" bridge freed --bus 127.0.0.1:1 --transform $examples/freed.yaml
    refuses 2 "the protocol is missing: freed, " "$pose" bridge --bus 127.0.0.1:1 --transform $examples/freed.yaml
    refuses 2 "no such protocol: 'vrpn'" "$pose" bridge vrpn --bus 127.0.0.1:1 --transform $examples/freed.yaml
    refuses 2 "one protocol expected" "$@" psn
    refuses 2 "--bus is missing" "$pose" bridge freed --transform $examples/freed.yaml
    refuses 2 "--transform is missing: a file" "$pose" bridge freed --bus 127.0.0.1:1
    refuses 2 "expected ADDR:PORT" "$@" --listen 5000
    refuses 2 "not a multicast group" "$@" --interface 127.0.0.1
    refuses 2 "--seconds" "$@" --seconds 0
    refuses 2 "classic frames only" "$@" --fd
    refuses 1 "missing.yaml:1: file: cannot be opened" "$pose" bridge freed --bus 127.0.0.1:1 \
        --transform "$scratch/missing.yaml"
    refuses 1 "not this machine's address" "$@" --listen 192.0.2.1:5000
    refuses 1 "nocan0" "$pose" bridge freed --bus nocan0 --transform $examples/freed.yaml --listen 127.0.0.1:0
    for program in "" send bridge; do
        # shellcheck disable=SC2086 # no command is no word
        "$pose" $program --help >"$scratch/stdout" && grep -q Usage "$scratch/stdout"
        check "wallwarp-pose $program --help" $?
    done
}

test_motions
test_bridges
test_bad_sends
test_bad_bridges
finish
