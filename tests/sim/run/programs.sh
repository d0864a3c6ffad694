# SPDX-License-Identifier: Apache-2.0
# For the scripts that run the simulator's programs: rooms, pose lists, and how results are noted. Sourced after $build
# is set; makes the folder $scratch, and deletes it at the end with the processes of $started.
# shellcheck shell=sh disable=SC2034,SC2154 # variables from and for the script that sources it
picture=tests/images/studio_480x270.png
scratch=$(mktemp -d "${TMPDIR:-/tmp}/wallwarp-programs.XXXXXX") || exit 1
started=
trap 'for id in $started; do kill -KILL "$id" 2>/dev/null; done; rm -rf "$scratch"' EXIT
passed=0
failed=0

# check NAME STATUS: note a result; STATUS 0 is good.
check() {
    if [ "$2" -eq 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAIL $1"
    fi
}

# refuses STATUS TEXT COMMAND ...: the command must end with STATUS and say TEXT on stderr.
refuses() {
    status=$1
    text=$2
    shift 2
    timeout 60 "$@" >"$scratch/stdout" 2>"$scratch/stderr" </dev/null
    found=$?
    [ "$found" -eq "$status" ] && grep -qF -- "$text" "$scratch/stderr"
    good=$?
    [ "$good" -eq 0 ] || { echo "status $found, said:"; cat "$scratch/stderr"; }
    check "refuses: $* ($status, $text)" "$good"
}

write_room() {
    cat <<END
camera: {width: 480, height: 270, focal_px: [300, 300], principal_px: [240, 135]}
boards:
  - name: front
    node: 1
    projector: {width: 160, height: 90}
    wall: {corners_mm: [[-2000, -1125, 2000], [2000, -1125, 2000], [2000, 1125, 2000], [-2000, 1125, 2000]]}
  - name: left
    node: 2
    projector: {width: 160, height: 90}
    border: [20, 40, 60]
    wall: {corners_mm: [[-2000, -1125, -2000], [-2000, -1125, 2000], [-2000, 1125, 2000], [-2000, 1125, -2000]]}
can: {bitrate: 500000, data_bitrate: 2000000, fd: $1}
END
}

# write_poses COUNT: COUNT poses at 30 Hz; they only move, so that rounding on the bus does not change them.
write_poses() {
    echo time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz
    awk -v count="$1" 'BEGIN { for (n = 0; n < count; n++)
        printf "%.6f,%.2f,%.2f,%.2f,1,0,0,0\n", 10 + n / 30, -900 + 37.25 * n, -100 + 11.5 * n, -700 + 20.75 * n }'
}

run() {
    timeout 120 "$build/wallwarp-sim" run "$@" >"$scratch/stdout" 2>"$scratch/stderr"
}

# Wait until a file has a line that matches; print what is between "127.0.0.1:" and the next space.
port_in() {
    tries=0
    while [ $tries -lt 200 ]; do
        port=$(sed -n 's/.*bus on 127\.0\.0\.1:\([0-9]*\) .*/\1/p' "$1" 2>/dev/null)
        [ -n "$port" ] && echo "$port" && return 0
        sleep 0.1
        tries=$((tries + 1))
    done
    return 1
}

# start_room NAME OPTION ...: a room in real time; its bus is then $bus, its process $room.
start_room() {
    room_name=$1
    shift
    "$build/wallwarp-sim" run "$scratch/classic.yaml" --video $picture --bus 0 --out "$scratch/$room_name" "$@" \
        >"$scratch/$room_name.out" 2>/dev/null &
    room=$!
    started="$started $room"
    bus=127.0.0.1:$(port_in "$scratch/$room_name.out")
}

end_room() {
    kill -INT "$room"
    wait "$room"
    check "the room ends well" $?
}

pose_tool() {
    timeout 60 "$build/wallwarp-pose" "$@" >"$scratch/stdout" 2>"$scratch/stderr" </dev/null
}

write_room true >"$scratch/fd.yaml"
write_room false >"$scratch/classic.yaml"
write_poses 10 >"$scratch/ten.csv"
write_poses 1 >"$scratch/one.csv"

# Print the results; the status is 0 when nothing has failed.
finish() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}
