#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The service's files: systemd takes the unit, its commands are ones that the firmware takes, the bus has the bit rates of
# a room that states none. usage: test_service.sh BUILD, from the tree's root
set -u
wallwarp=$(realpath "$1")/wallwarp
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
passed=0
failed=0

# ok STATUS WHAT
ok() {
    if [ "$1" = 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $2"
    fi
}

# As it is installed, but with the program that was built.
sed "s|/usr/local/bin/wallwarp|$wallwarp|; s|/etc/wallwarp/|$folder/|" board/service/wallwarp.service >"$folder/wallwarp.service"
sed "s|/etc/wallwarp/room.yaml|sim/demo/room.yaml|" board/service/board.conf >"$folder/board.conf"
SYSTEMD_LOG_LEVEL=warning systemd-analyze verify --man=no "$folder/wallwarp.service" >"$folder/said" 2>&1 &&
    [ ! -s "$folder/said" ]
ok $? "systemd-analyze verify: $(cat "$folder/said")"

# A command of the unit, with the variables of board.conf.
command_of() {
    # shellcheck disable=SC1091 # made above
    . "$folder/board.conf"
    eval "echo $(sed -n "s/^$1=//p" "$folder/wallwarp.service")"
}
sh -c "$(command_of ExecStart) --check" >"$folder/said" 2>&1
ok $? "ExecStart, with --check: $(cat "$folder/said")"
grep -q 'found    room: sim/demo/room.yaml, node 1' "$folder/said"
ok $? "ExecStart names no room: $(cat "$folder/said")"
sh -c "$(command_of ExecStopPost)" >"$folder/said" 2>&1
ok $? "ExecStopPost: $(cat "$folder/said")"

for line in 'Type=notify' 'Restart=always' 'WatchdogSec=' 'LimitRTPRIO=' 'LimitMEMLOCK=infinity' 'User=wallwarp'; do
    grep -q "^$line" board/service/wallwarp.service
    ok $? "the unit has no $line"
done
for line in 'BitRate=500K' 'DataBitRate=2M' 'FDMode=yes' 'RestartSec='; do
    grep -q "^$line" board/service/80-wallwarp-can.network
    ok $? "the network file has no $line"
done
for file in board/service/*; do
    case $file in *README.md) continue ;; esac
    grep -q "install .*$(basename "$file")" board/service/README.md
    ok $? "the page does not install $file"
done

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
