#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The Python of BUS.md, as it stands there, sends poses that the tools and boards of a simulated room take.
# Usage, from the tree's root: tests/firmware/test_bus_page_python.sh BUILD_FOLDER
set -u
build=${1:?usage: test_bus_page_python.sh BUILD_FOLDER}
. tests/sim/run/programs.sh

write_room true >"$scratch/room.yaml"
"$build/wallwarp-sim" run "$scratch/room.yaml" --video $picture --bus 0 --out "$scratch/out" >"$scratch/sim.out" \
    2>"$scratch/sim.err" &
room=$!
started="$started $room"
port=$(port_in "$scratch/sim.out")

# shellcheck disable=SC2016 # the page's quotes
sed -n '/^```python$/,/^```$/p' firmware/BUS.md | sed '/^```/d' >"$scratch/page.py"
sed "s/port=29536/port=$port/" "$scratch/page.py" >"$scratch/send.py"
! cmp -s "$scratch/page.py" "$scratch/send.py"
check "the page's port is replaced" $?

"$build/wallwarp-pose" monitor --bus "127.0.0.1:$port" >"$scratch/monitor" 2>&1 &
monitor=$!
started="$started $monitor"
timeout 60 /usr/bin/python3 "$scratch/send.py" 2>"$scratch/python.err"
check "the program ends well" $?
sleep 1
kill -INT "$room"
wait "$room"
check "the room ends well" $?
wait "$monitor"

# times_in_log PATTERN: frames whose identifier and data match.
times_in_log() {
    grep -c " can0 $1" "$scratch/out/bus.log"
}

[ "$(times_in_log '110#..1.40E201F067FD')" -eq 480 ] && [ "$(times_in_log '111#......8E26009A59')" -eq 480 ] &&
    [ "$(times_in_log '112#....33F3004000C0')" -eq 480 ]
check "the page's pose was on the bus 480 times" $?
[ "$(times_in_log '040#')" -eq 16 ] && [ "$(times_in_log '080#')" -eq 16 ]
check "and 16 pairs of Sync and FollowUp" $?
grep '^127.0.0.1:' "$scratch/monitor" | tail -n 1 | grep -q ' 0 damaged, '
check "of these none is damaged" $?
# Columns: viewer, message, rate, jitter, delay, worst, lost, crc. A busy machine may tear sets apart.
grep '^     0  set ' "$scratch/monitor" | tail -n 1 | awk '{ good = $8 == 0 } END { exit !good }'
check "and no pose" $?
[ "$failed" -eq 0 ] || tail -n 20 "$scratch/monitor" "$scratch/python.err" "$scratch/sim.err"
finish
