#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The service's files: systemd takes the unit, its commands are ones that the firmware takes, the bus has the bit rates of
# a room that states none. usage: test_service.sh BUILD, from the tree's root
set -u
wallwarp=$(realpath "$1")/wallwarp
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

fail() {
    echo "FAILED: $*"
    failed=$((failed + 1))
}

# As it is installed, but with the program that was built.
sed "s|/usr/local/bin/wallwarp|$wallwarp|; s|/etc/wallwarp/|$folder/|" board/service/wallwarp.service >"$folder/wallwarp.service"
sed "s|/etc/wallwarp/room.yaml|sim/demo/room.yaml|" board/service/board.conf >"$folder/board.conf"
SYSTEMD_LOG_LEVEL=warning systemd-analyze verify --man=no "$folder/wallwarp.service" >"$folder/said" 2>&1 ||
    fail "systemd-analyze verify: $(cat "$folder/said")"
[ -s "$folder/said" ] && fail "systemd-analyze verify said: $(cat "$folder/said")"

# A command of the unit, with the variables of board.conf.
command_of() {
    # shellcheck disable=SC1091 # made above
    . "$folder/board.conf"
    eval "echo $(sed -n "s/^$1=//p" "$folder/wallwarp.service")"
}
sh -c "$(command_of ExecStart) --check" >"$folder/said" 2>&1 || fail "ExecStart, with --check: $(cat "$folder/said")"
grep -q 'found    room: sim/demo/room.yaml, node 1' "$folder/said" || fail "ExecStart names no room: $(cat "$folder/said")"
sh -c "$(command_of ExecStopPost)" >"$folder/said" 2>&1 || fail "ExecStopPost: $(cat "$folder/said")"

for line in 'Type=notify' 'Restart=always' 'WatchdogSec=' 'LimitRTPRIO=' 'LimitMEMLOCK=infinity' 'User=wallwarp'; do
    grep -q "^$line" board/service/wallwarp.service || fail "the unit has no $line"
done
for line in 'BitRate=500K' 'DataBitRate=2M' 'FDMode=yes' 'RestartSec='; do
    grep -q "^$line" board/service/80-wallwarp-can.network || fail "the network file has no $line"
done
for file in board/service/*; do
    case $file in *README.md) continue ;; esac
    grep -q "install .*$(basename "$file")" board/service/README.md || fail "the page does not install $file"
done

[ $failed = 0 ] && echo "test_service: all passed"
exit $((failed > 0))
